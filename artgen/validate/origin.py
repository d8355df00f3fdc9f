"""Origin: what a bundle's manifest says of the foreign source that it was made from."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

OURS = "artgen"


@dataclass(frozen=True, kw_only=True)
class Origin:
    """Where a bundle comes from, and which of its bodies cannot be asked to be closed.

    Attributes:
        foreign: whether its meshes and joints are a stranger's; no rule of ours bounds its size,
            its number of files, or where in its range a joint rests.
        shells: part name to the numbers of bodies that are open surfaces.
        thickness: m that those weigh as.
    """

    foreign: bool = False
    shells: Mapping[str, frozenset[int]] = field(default_factory=dict)
    thickness: float = 0.0


def origin_of(manifest: Mapping[str, Any]) -> Origin:
    """Of a manifest as it stands, whatever it holds; one that names no source is ours, and
    nothing of ours is excused from being closed."""
    source, shells = manifest.get("source"), manifest.get("shells")
    dataset = source.get("dataset") if isinstance(source, Mapping) else OURS
    if dataset == OURS:
        return Origin()
    if not isinstance(shells, Mapping):
        return Origin(foreign=True)
    bodies, thickness = shells.get("bodies"), shells.get("thickness")
    listed = bodies.items() if isinstance(bodies, Mapping) else ()
    return Origin(
        foreign=True,
        shells={
            str(part): frozenset(number for number in own if isinstance(number, int))
            for part, own in listed
            if isinstance(own, list)
        },
        thickness=float(thickness) if isinstance(thickness, int | float) else 0.0,
    )
