"""What a golden file says of a finished object."""

import hashlib
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from artgen.articulation.types import ArticulatedObject, Part
from artgen.core.jsonio import plain

FOLDER = Path(__file__).parent


def summary(obj: ArticulatedObject) -> Mapping[str, object]:
    """Counts, joints with every digit, masses, bounds, and a hash of the vertices."""
    return {
        "parts": [_part(part) for part in obj.parts],
        "joints": [plain(joint) for joint in obj.joints],
        "preconditions": plain(obj.preconditions),
        "surfaces": [f"{s.name}: {s.recipe}" for s in obj.surfaces],
    }


def _part(part: Part) -> Mapping[str, object]:
    return {
        "name": part.name,
        "label": part.label,
        "bodies": int(part.mesh.body.max()) + 1,
        "triangles": len(part.mesh.faces),
        "collision": len(part.collision),
        "mass": float(f"{part.mass.mass:.9g}"),
        "bounds": plain(part.mesh.bounds),
        "grips": plain(part.grips),
        "vertices": hashlib.sha256(np.ascontiguousarray(part.mesh.vertices).tobytes()).hexdigest(),
    }
