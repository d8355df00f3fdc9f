"""What surfaces are for, and the looks that an assembled object is given anew."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Literal

import numpy as np

from artgen.assembly.source import PRINTS, Source
from artgen.assembly.uv_fix import areas
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.rules.load import rules_folder
from artgen.rules.surfaces import load_palette, surface_spec

Stuff = Literal["wood", "paint", "metal", "glass", "mirror", "print", "other"]
FRONTS: Mapping[str, tuple[str, ...]] = {
    "wood": ("oak_natural", "walnut", "ash", "cherry", "oak_whitewashed", "wenge", "birch_ply"),
    "paint": (
        *("mdf_white", "mdf_gray", "mdf_sage", "mdf_navy", "mdf_black", "mdf_cream"),
        *("melamine_white", "laminate_gray"),
    ),
}
"""Palette entries that fronts and bodies of furniture are made of."""
METALS = ("brass_brushed", "nickel_brushed", "black_metal", "copper_brushed")
"""Of handles."""
BODY_LIKE_FRONTS = 0.4
"""Chance that a body has the wood or paint of its fronts."""
WOODEN = 0.7
"""Chance of wood, for fronts and for bodies alike."""
PANEL_RECIPES = frozenset({"wood", "paint", "enamel", "plain", "plastic", "brushed", "picture"})
"""Recipes whose front panels are given a new look; others are part of what a panel is. Pictures are
what foreign objects are covered with."""
BODY_RECIPES = frozenset({"wood", "paint", "picture"})
"""The same for what bodies of furniture are mainly made of."""

MAIN = 0.1
"""Least share of a base's surface that a wood or paint covers to be its main one."""


@dataclass(frozen=True, kw_only=True)
class Looks:
    """One wood or paint for all fronts, one for the body, one metal for all handles."""

    front: SurfaceSpec
    body: SurfaceSpec
    metal: SurfaceSpec


def stuff_of(surface: SurfaceSpec) -> Stuff:
    """What a surface is, by its numbers and its recipe."""
    if surface.recipe in PRINTS:
        return "print"
    if surface.transmission > 0.0:
        return "glass"
    if surface.metallic > 0.5:
        return "mirror" if surface.roughness < 0.1 else "metal"
    if surface.recipe == "wood":
        return "wood"
    return "paint" if surface.recipe in ("paint", "enamel") else "other"


def drawn_looks(stream: Stream) -> Looks:
    """Drawn from the palettes that come with the rules."""
    rng = stream.generator()
    front, other = (
        palette_surface(str(rng.choice(FRONTS["wood" if rng.random() < WOODEN else "paint"])), name)
        for name in ("front", "body")
    )
    same = rng.random() < BODY_LIKE_FRONTS
    metal = palette_surface(str(rng.choice(METALS)), "handle")
    return Looks(front=front, body=replace(front, name="body") if same else other, metal=metal)


@cache
def palette_surface(entry: str, name: str) -> SurfaceSpec:
    """A palette entry as the surface of that name; entries never change while a process runs."""
    return surface_spec(name, load_palette(rules_folder())[entry])


def front_surface(surface: SurfaceSpec, looks: Looks) -> SurfaceSpec:
    """What a surface on a front's panel becomes: panes, mirrors, prints and hardware are kept."""
    return looks.front if is_panel(surface) else surface


def is_panel(surface: SurfaceSpec) -> bool:
    """Whether a front's panel of this surface is given a new look."""
    stuff = stuff_of(surface)
    return stuff in ("wood", "paint") or (stuff == "other" and surface.recipe in PANEL_RECIPES)


def body_surface(surface: SurfaceSpec, main: Sequence[str], looks: Looks) -> SurfaceSpec:
    """What a surface of the base becomes: its main wood or paint is changed, all else is kept."""
    return (
        looks.body if surface.name in main and stuff_of(surface) in ("wood", "paint") else surface
    )


def handle_surface(surface: SurfaceSpec, looks: Looks) -> SurfaceSpec:
    """What a surface of a handle becomes: any metal, lacquered or not, the object's metal."""
    lacquered = stuff_of(surface) in ("metal", "paint") or surface.recipe == "picture"
    return looks.metal if lacquered else surface


def main_surfaces(source: Source) -> tuple[str, ...]:
    """Names of the woods, paints and pictures that make up a base."""
    mesh = source.base.mesh
    covered = np.bincount(
        np.asarray(mesh.slot), weights=areas(mesh.triangles), minlength=len(source.surfaces)
    )
    return tuple(
        surface.name
        for surface, area in zip(source.surfaces, covered, strict=True)
        if surface.recipe in BODY_RECIPES and area >= MAIN * covered.sum()
    )
