"""Depth maps of a draft at rest and open: a picture of its shape alone, without noise."""

import math

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import open_state
from artgen.articulation.types import Draft, State
from artgen.core.camera import orbit_direction
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.rules.schema import CategoryRule

PIXELS = 48
"""Along each side of a map."""
DIRECTIONS = (
    orbit_direction(0.0, 0.0),
    orbit_direction(math.radians(35.0), math.radians(25.0)),
    orbit_direction(math.radians(-145.0), math.radians(25.0)),
    orbit_direction(0.0, math.radians(89.0)),
)
"""From the object to the eye: front, front right, rear left, top."""
ROOM = 1.6
"""Side of a map over the diagonal of the largest object that the rule's bands allow: open doors
reach beyond."""
MISS = np.float32(-1.0)


def extent_of(rule: CategoryRule) -> float:
    """Side of the square that every map of a category shows, m."""
    return ROOM * math.hypot(*(rule.bands[side].upper for side in ("width", "depth", "height")))


def views_of(draft: Draft, *, extent: float) -> NDArray[np.float32]:
    """(2, V, PIXELS, PIXELS) parallel projections at rest and open; depth in units of `extent`,
    `MISS` where nothing is met.

    Args:
        extent: side of the maps, m; the object stands in their middle.
    """
    joints = draft.joints
    states: tuple[State, State] = ({}, open_state(joints, draft.preconditions))
    return np.stack([_maps(draft, state, extent) for state in states])


def _maps(draft: Draft, state: State, extent: float) -> NDArray[np.float32]:
    poses = forward_kinematics(draft.parts[0].name, draft.joints, state)
    corners = []
    for part in draft.parts:
        for mesh in (body.solid.trimesh() for body in part.bodies):
            corners.append(apply(poses[part.name], mesh.vertices)[mesh.faces])
    soup = np.concatenate(corners)
    scene = EmbreeScene(robust=True)
    faces = np.arange(3 * len(soup), dtype=np.int32).reshape(-1, 3)
    TriangleMesh(scene, soup.reshape(-1, 3).astype(np.float32), faces)
    middle = np.array([0.0, 0.0, float(soup[..., 2].min()) + 0.25 * extent])
    return np.stack([_map(scene, direction, middle, extent) for direction in DIRECTIONS])


def _map(
    scene: EmbreeScene, direction: Floats, middle: Floats, extent: float
) -> NDArray[np.float32]:
    """(PIXELS, PIXELS) depth behind a plane that lies before the object."""
    right = np.cross((0.0, 0.0, 1.0), direction)
    right /= np.linalg.norm(right)
    up = np.cross(direction, right)
    steps = extent * ((np.arange(PIXELS) + 0.5) / PIXELS - 0.5)
    plane = middle + extent * direction
    origins = plane + steps[:, None, None] * up + steps[None, :, None] * right
    rays = np.broadcast_to(-direction, (PIXELS * PIXELS, 3)).astype(np.float32)
    distance = scene.run(
        origins.reshape(-1, 3).astype(np.float32), np.ascontiguousarray(rays), query="DISTANCE"
    )
    depth = np.where(distance < 4.0 * extent, distance / extent, MISS)
    return np.asarray(depth, np.float32).reshape(PIXELS, PIXELS)
