"""Layouts that the tests share."""

from dataclasses import replace

import numpy as np

from artgen.articulation.targets import FIXED, PRISMATIC, REVOLUTE
from artgen.geometry.solid import slab
from model.evaluation.layout import Layout

BASE = ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
DOOR = ((0.0, -0.1, 0.5), (1.0, 0.0, 1.0))
DRAWER = ((0.1, -0.1, 0.0), (0.9, 0.8, 0.4))


def cabinet(name: str = "cabinet", **changes: object) -> Layout:
    """A base, a drawer that comes out by 0.5, a door that turns about its left edge."""
    values: dict[str, object] = {
        "name": name,
        "category": "cabinet",
        "labels": ("base", "drawer", "door"),
        "boxes": np.array([BASE, DRAWER, DOOR]),
        "types": np.array([FIXED, PRISMATIC, REVOLUTE]),
        "axes": np.array([(0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)]),
        "origins": np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]),
        "limits": np.array([(0.0, 0.0), (0.0, 0.5), (0.0, 1.5)]),
        "parents": np.array([-1, 0, 0]),
        "states": np.array([(0.0, 0.0, 0.0), (0.0, 0.25, 1.0)]),
    }
    return Layout(**{**values, **changes})  # type: ignore[arg-type]


def with_box_meshes(layout: Layout) -> Layout:
    """The layout with every box as a part's surface."""
    meshes = tuple(slab(box[0], box[1]).trimesh() for box in layout.boxes)
    return replace(layout, meshes=meshes)
