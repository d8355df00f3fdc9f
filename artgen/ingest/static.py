"""A mesh file of an object that does not move: its nodes are its parts, ordered and capped."""

from functools import partial
from pathlib import Path
from typing import Literal

import numpy as np

from artgen.articulation.canonical import canonical_order
from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.jsonio import file_hash
from artgen.core.mesh import Floats
from artgen.ingest.foreign import ForeignObject, ForeignPart, ForeignShape
from artgen.ingest.meshes.objfile import read_obj_soup
from artgen.ingest.meshes.scenes import Instance, read_scene
from artgen.ingest.meshes.soup import Soup, joined_soups

Up = Literal["y", "z"]
OBJECT_FROM = {"y": Y_UP_FROM_Z_UP[:3, :3].T, "z": np.eye(3)}
"""Turn of a file whose up is y (and front +z, as glTF has it) or z (and front -y)."""


def read_static(path: Path, *, up: Up, most: int) -> ForeignObject:
    """One fixed part whose shapes are the file's parts: the largest first, then low to high, front
    to back, left to right; the smallest beyond `most` are joined to the largest.

    Raises:
        ArtgenError: it cannot be read. OSError: it cannot be opened.
    """
    turn = np.array(OBJECT_FROM[up])
    instances = _instances(path)
    sizes = [float(np.linalg.norm(np.diff(_box(one.soup, turn), axis=0))) for one in instances]
    ranked = sorted(range(len(instances)), key=lambda k: (-sizes[k], k))
    kept, small = ranked[:most], ranked[most:]
    largest = joined_soups([instances[k].soup for k in (kept[0], *sorted(small))])
    listed = [Instance(name=instances[kept[0]].name, soup=largest)]
    listed += [instances[k] for k in sorted(kept[1:])]
    order = canonical_order([_box(one.soup, turn) for one in listed])
    shapes = tuple(
        ForeignShape(
            leaf=f"{place}_{listed[k].name}",
            label=f"{path.name}, {listed[k].name}",
            read=partial(_given, listed[k].soup),
        )
        for place, k in enumerate(order)
    )
    joined = f"{len(small)} of {len(instances)} parts, the smallest, are joined to the largest"
    return ForeignObject(
        dataset="static",
        id=path.stem,
        category="static",
        digest=file_hash(path),
        parts=(ForeignPart(name="base", word="base", shapes=shapes),),
        joints=(),
        object_from_source=turn,
        doubts=(f"{joined}: at most {most} are kept",) if small else (),
    )


def _instances(path: Path) -> list[Instance]:
    if path.suffix.lower() == ".obj":
        return [Instance(name=path.stem, soup=read_obj_soup(path, path.parent))]
    return read_scene(path)


def _box(soup: Soup, turn: Floats) -> Floats:
    """(2, 3) in axes of ours."""
    points = soup.vertices[np.unique(soup.faces)] @ turn.T
    return np.stack([points.min(axis=0), points.max(axis=0)])


def _given(soup: Soup) -> Soup:
    return soup
