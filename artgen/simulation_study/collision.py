"""What a collision representation says about a clearance that is known exactly.

Two scenes with 3 mm of air everywhere: a drawer in its carcass, a door in its frame. A joint goes
through its range; at each pose the least distance between the two parts by MuJoCo's
`mj_geomDistance` is held against the exact gap by manifold3d.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import mujoco
import numpy as np

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.decompose import decomposed
from artgen.geometry.solid import Solid, hull, rotation_about, slab, union
from artgen.simulation_study.measured import Measured, timed

GAP = 0.003
"""m, all around."""
WALL = 0.018
"""m, chipboard."""
POSES = 9
REACH = 1.0
"""m; distances beyond are not looked for."""
PIECES = (4, 16, 64)


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """A fixed part, a moving part, each as convex pieces, and (K, 4, 4) poses of the moving one."""

    name: str
    still: tuple[Solid, ...]
    moving: tuple[Solid, ...]
    poses: Floats

    @property
    def parts(self) -> tuple[tuple[Solid, ...], tuple[Solid, ...]]:
        """Pieces of the fixed and of the moving part."""
        return self.still, self.moving


def drawer() -> Scene:
    """An open box of five panels that slides out of a carcass of five panels towards -y."""
    wide, deep, high = 0.45, 0.5, 0.2
    carcass = (
        slab((0, 0, 0), (wide, deep, WALL)),
        slab((0, 0, high - WALL), (wide, deep, high)),
        slab((0, 0, WALL), (WALL, deep, high - WALL)),
        slab((wide - WALL, 0, WALL), (wide, deep, high - WALL)),
        slab((WALL, deep - WALL, WALL), (wide - WALL, deep, high - WALL)),
    )
    low, top = WALL + GAP, high - WALL - GAP
    left, right, back = WALL + GAP, wide - WALL - GAP, deep - WALL - GAP
    box = (
        slab((left, 0, low), (right, back, low + 0.01)),
        slab((left, 0, low + 0.01), (left + 0.012, back, top)),
        slab((right - 0.012, 0, low + 0.01), (right, back, top)),
        slab((left + 0.012, back - 0.012, low + 0.01), (right - 0.012, back, top)),
        slab((left + 0.012, 0, low + 0.01), (right - 0.012, 0.012, top)),
    )
    shift = np.zeros((POSES, 3))
    shift[:, 1] = -np.linspace(0.0, 0.35, POSES)
    poses = np.repeat(np.eye(4)[None], POSES, axis=0)
    poses[:, :3, 3] = shift
    return Scene(name="drawer in carcass", still=carcass, moving=box, poses=poses)


def door() -> Scene:
    """A leaf with a rounded hinge edge that turns about its own post within a frame."""
    wide, high, thick = 0.9, 2.0, 0.04
    frame = (
        slab((-0.06 - GAP - thick / 2, 0, 0), (-GAP - thick / 2, thick, high)),
        slab((wide + GAP, 0, 0), (wide + 0.06 + GAP, thick, high)),
        slab((-0.06, 0, high + GAP), (wide + 0.06, thick, high + 0.06)),
    )
    turned = np.linspace(math.pi / 2, 3 * math.pi / 2, 13)
    rim = thick / 2 * np.stack([np.cos(turned), np.sin(turned)], axis=-1) + (0.0, thick / 2)
    corners = [(*point, z) for point in rim.tolist() for z in (0.0, high)]
    corners += [(wide, y, z) for y in (0.0, thick) for z in (0.0, high)]
    leaf = (hull(corners),)
    about = (0.0, thick / 2, 0.0)
    angles = np.linspace(0.0, -math.pi / 2, POSES)
    poses = np.stack([rotation_about("z", angle, about) for angle in angles.tolist()])
    return Scene(name="door in frame", still=frame, moving=leaf, poses=poses)


def fidelity_rows(pieces: Sequence[int] = PIECES) -> Iterator[Measured]:
    """Every representation of every scene."""
    for scene in (drawer(), door()):
        truth, exact_ms = timed(partial(exact_gaps, scene), repeats=1)
        yield Measured(
            scene=scene.name,
            setting="exact (manifold3d)",
            step=1.0,
            error=0.0,
            unit="m",
            cpu_ms=exact_ms / POSES,
        )
        for setting, represent in _representations(pieces):
            parts = [represent(part) for part in scene.parts]
            model = collision_model(parts)
            found, cpu_ms = timed(partial(distances, model, scene.poses))
            yield Measured(
                scene=scene.name,
                setting=setting,
                step=float(sum(len(part) for part in parts)),
                error=float(np.abs(found - truth).max()),
                unit="m",
                cpu_ms=cpu_ms / POSES,
            )


def exact_gaps(scene: Scene) -> Floats:
    """(K,) m of air between the parts at each pose."""
    still = union(scene.still).manifold
    moving = union(scene.moving).manifold
    return np.array([still.min_gap(moving.transform(pose[:3]), REACH) for pose in scene.poses])


def distances(model: mujoco.MjModel, poses: Floats) -> Floats:
    """(K,) m, negative inside, between the two bodies of a model at each pose of the second."""
    data = mujoco.MjData(model)
    found = np.full(len(poses), REACH)
    still, moving = (np.flatnonzero(model.geom_bodyid == body) for body in (1, 2))
    for k, pose in enumerate(poses):
        data.mocap_pos[0] = pose[:3, 3]
        mujoco.mju_mat2Quat(data.mocap_quat[0], np.ascontiguousarray(pose[:3, :3]).ravel())
        mujoco.mj_kinematics(model, data)
        for one in still.tolist():
            for other in moving.tolist():
                apart = mujoco.mj_geomDistance(model, data, one, other, found[k], None)
                found[k] = min(found[k], apart)
    return found


def collision_model(parts: Sequence[Sequence[TriMesh]]) -> mujoco.MjModel:
    """A fixed body and one that can be put anywhere, each of convex meshes."""
    spec = mujoco.MjSpec()
    for number, pieces in enumerate(parts):
        body = spec.worldbody.add_body(name=f"part_{number}", mocap=number == 1)
        for k, piece in enumerate(pieces):
            name = f"piece_{number}_{k}"
            spec.add_mesh(
                name=name,
                uservert=np.asarray(piece.vertices, np.float32).ravel(),
                userface=np.asarray(piece.faces).ravel(),
                inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX,
            )
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name)
    return spec.compile()


def _representations(
    pieces: Sequence[int],
) -> list[tuple[str, Callable[[Sequence[Solid]], tuple[TriMesh, ...]]]]:
    decompositions = [
        (f"CoACD {count}", lambda part, count=count: decomposed(_whole(part), pieces=count))
        for count in pieces
    ]
    return [
        ("bounding box", lambda part: (slab(*union(part).bounds).trimesh(),)),
        ("one hull", lambda part: (union(part).hull().trimesh(),)),
        *decompositions,
        ("authored pieces", lambda part: tuple(solid.trimesh() for solid in part)),
    ]


def _whole(part: Sequence[Solid]) -> TriMesh:
    return union(part).trimesh()
