"""Palette entries of `_surfaces*.toml` to SurfaceSpec."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from artgen.core.errors import RuleError
from artgen.core.surface import SurfaceSpec, linear_color

NUMBERS = (
    *("roughness", "metallic", "transmission", "ior", "emission"),
    *("subsurface", "attenuation", "relief", "relief_size"),
)
KEYS = ("recipe", "color", "tile", "detail", *NUMBERS)


def load_palette(folder: Path) -> dict[str, dict[str, Any]]:
    """Name to raw entry of all `<folder>/_surfaces*.toml`, every key checked.

    Raises:
        RuleError: an entry has an unknown key, no recipe, a color that is not `#rrggbb`, or two
            files define it.
    """
    palette: dict[str, dict[str, Any]] = {}
    paths = sorted(folder.glob("_surfaces*.toml"))
    if not paths:
        raise RuleError(f"{folder.name}: there is no _surfaces.toml; the palettes are missing")
    for path in paths:
        where = f"{folder.name}/{path.name}"
        try:
            entries = tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
            raise RuleError(f"{where}: cannot be read: {error}") from error
        for name, entry in entries.items():
            if name in palette:
                raise RuleError(f"{where}: [{name}] is defined twice; rename one of the twins")
            _check(f"{where}: [{name}]", entry)
            palette[name] = entry
    return palette


def _check(where: str, entry: Any) -> None:
    if not isinstance(entry, dict) or not isinstance(entry.get("recipe"), str):
        raise RuleError(f"{where} needs a recipe, found {entry!r}")
    if unknown := sorted(set(entry) - set(KEYS)):
        raise RuleError(f"{where} unknown keys {unknown}; expected {', '.join(KEYS)}")
    color = str(entry.get("color", "#cccccc"))
    if len(color) != 7 or color[0] != "#" or not set(color[1:].lower()) <= set("0123456789abcdef"):
        raise RuleError(f"{where} color = {color!r} is not #rrggbb")
    for key in ("roughness", "metallic", "transmission"):
        if not 0.0 <= float(entry.get(key, 0.0)) <= 1.0:
            raise RuleError(f"{where} {key} = {entry[key]} lies outside [0, 1]")


def surface_spec(role: str, entry: Mapping[str, Any]) -> SurfaceSpec:
    """The palette entry as the surface that plays `role` in an object."""
    numbers = {key: float(entry[key]) for key in NUMBERS if key in entry}
    width, height = entry.get("tile", (0.5, 0.5))
    return SurfaceSpec(
        name=role,
        recipe=entry["recipe"],
        color=linear_color(entry.get("color", "#cccccc")),
        tile=(float(width), float(height)),
        detail=dict(entry.get("detail", {})),
        **numbers,
    )
