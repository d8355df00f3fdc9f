"""Mass and inertia that MuJoCo infers from a mesh in each mode, against the exact integral."""

from collections.abc import Iterator, Mapping
from functools import partial

import mujoco
import numpy as np

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.measure import inertia, moments
from artgen.geometry.solid import revolve, slab, union
from artgen.simulation_study.collision import drawer
from artgen.simulation_study.measured import Measured, timed

MODES: Mapping[str, int] = {
    "exact": mujoco.mjtMeshInertia.mjMESH_INERTIA_EXACT,
    "legacy (MuJoCo's default)": mujoco.mjtMeshInertia.mjMESH_INERTIA_LEGACY,
    "convex": mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX,
    "shell": mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
}
DENSITY = 1000.0
"""kg/m3."""


def shapes() -> Mapping[str, TriMesh]:
    """A solid box, a sheet of 1 mm, two shapes of panels, and a bucket with a wall of 3 mm."""
    scene = drawer()
    wall = [(0.0, 0.0), (0.12, 0.0), (0.15, 0.3), (0.147, 0.3), (0.1172, 0.003), (0.0, 0.003)]
    return {
        "box": slab((0, 0, 0), (0.3, 0.2, 0.1)).trimesh(),
        "sheet of 1 mm": slab((0, 0, 0), (0.5, 0.4, 0.001)).trimesh(),
        "carcass": union(scene.still).trimesh(),
        "drawer": union(scene.moving).trimesh(),
        "bucket": revolve(wall).trimesh(),
    }


def inertia_rows() -> Iterator[Measured]:
    """Relative error of the mass, which that of the inertia follows, in every mode."""
    for name, mesh in shapes().items():
        (mass, tensor), exact_ms = timed(partial(exact, mesh))
        yield _row(name, "float64 integral (ours)", 0.0, exact_ms)
        for mode, number in MODES.items():
            (found, found_tensor), cpu_ms = timed(partial(by_mujoco, mesh, number))
            wrong = max(
                abs(found - mass) / mass,
                float(np.abs(found_tensor - tensor).max() / np.linalg.norm(tensor, 2)),
            )
            yield _row(name, mode, wrong, cpu_ms)


def exact(mesh: TriMesh) -> tuple[float, Floats]:
    """kg, and (3,) ascending principal moments, kg m2."""
    found = moments(mesh.triangles)
    central = inertia(found.second)
    return DENSITY * found.volume, DENSITY * np.linalg.eigvalsh(central)


def by_mujoco(mesh: TriMesh, mode: int) -> tuple[float, Floats]:
    """The same as MuJoCo infers them from the mesh."""
    spec = mujoco.MjSpec()
    spec.add_mesh(
        name="shape",
        uservert=np.asarray(mesh.vertices, np.float32).ravel(),
        userface=np.asarray(mesh.faces).ravel(),
        inertia=mode,
    )
    body = spec.worldbody.add_body(name="body")
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="shape", density=DENSITY)
    model = spec.compile()
    return float(model.body_mass[1]), np.sort(np.array(model.body_inertia[1]))


def _row(scene: str, setting: str, error: float, cpu_ms: float) -> Measured:
    return Measured(
        scene=scene, setting=setting, step=0.0, error=error, unit="relative", cpu_ms=cpu_ms
    )
