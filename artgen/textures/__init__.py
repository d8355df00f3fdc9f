"""Image sets for surfaces, synthesised in numpy; equal specs give equal images on every machine.

A recipe is a function of the same name, in the table below or in a module `<recipe>.py` beside it.
"""

import importlib
from collections.abc import Callable, Mapping

from artgen.core.errors import UsageError
from artgen.core.surface import SurfaceSpec
from artgen.textures.appliance_panel import appliance_display, appliance_panel
from artgen.textures.coat import enamel, paint
from artgen.textures.grain import plastic, rubber
from artgen.textures.images import TextureSet
from artgen.textures.keyboard import keyboard
from artgen.textures.metal import anodized, brushed
from artgen.textures.plain import plain
from artgen.textures.screen import screen
from artgen.textures.wood import wood

__all__ = ["RECIPES", "VERSION", "TextureSet", "texture_set"]

VERSION = 1
"""Raised when a recipe gives other images for the same spec."""

Recipe = Callable[[SurfaceSpec], TextureSet]

RECIPES: Mapping[str, Recipe] = {
    "anodized": anodized,
    "appliance_display": appliance_display,
    "appliance_panel": appliance_panel,
    "brushed": brushed,
    "enamel": enamel,
    "keyboard": keyboard,
    "paint": paint,
    "plain": plain,
    "plastic": plastic,
    "rubber": rubber,
    "screen": screen,
    "wood": wood,
}


def texture_set(spec: SurfaceSpec) -> TextureSet:
    """The images of a surface.

    Raises:
        UsageError: the recipe is unknown.
    """
    return _recipe(spec)(spec)


def _recipe(spec: SurfaceSpec) -> Recipe:
    if spec.recipe in RECIPES:
        return RECIPES[spec.recipe]
    try:
        module = importlib.import_module(f"{__name__}.{spec.recipe}")
        made: Recipe = getattr(module, spec.recipe)
    except (ImportError, AttributeError) as error:
        raise UsageError(
            f"surface {spec.name}: there is no texture recipe {spec.recipe!r}; "
            f"known: {', '.join(sorted(RECIPES))} and artgen/textures/<recipe>.py"
        ) from error
    return made
