"""L5: hollows stay open to hands, and moving parts can be got at."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import open_state, required_state
from artgen.articulation.types import State
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply
from artgen.validate.report import Finding
from artgen.validate.subject import Subject

GRID = 12
"""Points a side in a part's box."""
ENCLOSED = (4, 5)
"""How many of six directions along the axes meet the part: an open box shows five, a shelf four; a
cavity that shows six is of no use to hands."""
WAYS = np.concatenate([np.eye(3), -np.eye(3)])
WINDOW = 64
"""Rays a side of the object, from the front, the back, both sides and above."""


def interiors(subject: Subject) -> Iterator[Finding]:
    """Contact pieces leave open what the visual mesh leaves open."""
    bounds = subject.bounds
    for part, pieces in subject.collision.items():
        if part not in subject.meshes:
            continue
        hollow = hollow_points(subject.meshes[part])
        if len(hollow) < bounds.hollow_least.value * GRID**3:
            continue
        share = float(inside_any(hollow, pieces, bounds.gap_slack.value).mean())
        if share > bounds.open_interior.value:
            yield Finding(
                check="semantics.interior",
                part=part,
                value=share,
                bound=bounds.open_interior.at_most(),
                cause="contact pieces fill the hollow that is seen",
                remedy="author a piece for each wall instead of one hull around all",
            )


def hollow_points(mesh: TriMesh) -> Floats:
    """(N, 3) points of a grid in the mesh's box that lie in the open, but with the mesh around."""
    lower, upper = mesh.bounds
    steps = (np.arange(GRID) + 0.5) / GRID
    grid = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    points = lower + grid * (upper - lower)
    hit = _first_hits(mesh.triangles, np.repeat(points, 6, axis=0), np.tile(WAYS, (len(points), 1)))
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    facing = np.cross(b - a, c - a)[hit]
    met = (hit >= 0).reshape(-1, 6)
    from_within = (np.einsum("ij,ij->i", facing, np.tile(WAYS, (len(points), 1))) > 0.0).reshape(
        -1, 6
    )
    solid = (met & from_within).sum(axis=1) > 3
    return np.asarray(points[np.isin(met.sum(axis=1), ENCLOSED) & ~solid])


def _first_hits(triangles: Floats, origins: Floats, ways: Floats) -> NDArray[np.intp]:
    """(N,) the triangle that each ray meets first, or -1."""
    scene = EmbreeScene()
    TriangleMesh(scene, np.asarray(triangles, np.float32))
    return np.asarray(scene.run(origins.astype(np.float32), ways.astype(np.float32)), np.intp)


def inside_any(points: Floats, pieces: Sequence[TriMesh], margin: float) -> NDArray[np.bool_]:
    """(N,) whether each point lies inside one of some convex pieces, by more than `margin` m."""
    found = np.zeros(len(points), bool)
    for piece in pieces:
        a, b, c = piece.triangles.transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True).clip(min=1e-300)
        reach = np.einsum("ij,ij->i", normal, a)
        found |= (points @ normal.T <= reach - margin).all(axis=1)
    return found


def within_reach(subject: Subject) -> Iterator[Finding]:
    """Every moving part shows itself from outside: at rest, or when what bars it stands open."""
    joints, rules = subject.joints, subject.passages
    states: list[State] = [{}, open_state(joints, rules)]
    states += [required_state(joint.name, rules) for joint in joints]
    seen: set[str] = set()
    for state in {tuple(sorted(state.items())): state for state in states}.values():
        seen |= seen_from_outside(subject.meshes, subject, state)
    for joint in joints:
        if joint.child in subject.meshes and joint.child not in seen:
            yield Finding(
                check="semantics.reach",
                part=joint.child,
                joint=joint.name,
                value="not seen from any side",
                bound="seen at rest, or with the joints that bar it open",
                cause="a hand cannot get at it",
                remedy="leave an opening before it, or state what has to be opened first",
            )


def seen_from_outside(meshes: Mapping[str, TriMesh], subject: Subject, state: State) -> set[str]:
    """Parts that parallel rays from five sides meet first."""
    poses = forward_kinematics(subject.parts[0].name, subject.joints, state)
    placed = [apply(poses[name], mesh.triangles) for name, mesh in meshes.items()]
    owner = np.repeat(np.arange(len(placed)), [len(t) for t in placed])
    triangles = np.concatenate(placed)
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    origins, ways = [], []
    for way in WAYS[[0, 1, 3, 4, 5]]:  # Not from below, where it stands.
        axis = int(np.argmax(np.abs(way)))
        steps = (np.arange(WINDOW) + 0.5) / WINDOW
        u, v = (k for k in range(3) if k != axis)
        start = np.zeros((WINDOW, WINDOW, 3))
        start[..., u] = low[u] + steps[:, None] * (high[u] - low[u])
        start[..., v] = low[v] + steps[None, :] * (high[v] - low[v])
        start[..., axis] = (low[axis] - 1.0) if way[axis] > 0.0 else (high[axis] + 1.0)
        origins.append(start.reshape(-1, 3))
        ways.append(np.tile(way, (WINDOW * WINDOW, 1)))
    hit = _first_hits(triangles, np.concatenate(origins), np.concatenate(ways))
    return {list(meshes)[k] for k in np.unique(owner[hit[hit >= 0]]).tolist()}
