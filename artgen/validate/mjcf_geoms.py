"""Geoms of a compiled model as triangles."""

import manifold3d as m3
import mujoco
import numpy as np

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.solid import Solid, box, cylinder
from artgen.validate.meshfile import as_bodies

ROUND = 32
"""Sides of a cylinder or meridians of a sphere; their volume is 0.6 % small."""


def turn_of(quaternion: Floats) -> Floats:
    """(3, 3) of a quaternion w, x, y, z."""
    flat = np.zeros(9)
    mujoco.mju_quat2Mat(flat, np.asarray(quaternion, np.float64))
    return flat.reshape(3, 3)


def geom_mesh(model: mujoco.MjModel, geom: int) -> TriMesh:
    """Triangles of a geom in its own frame.

    Raises:
        GeometryError: it is of a kind that has no surface here.
    """
    kind, size = mujoco.mjtGeom(int(model.geom_type[geom])), model.geom_size[geom]
    if kind in (mujoco.mjtGeom.mjGEOM_MESH, mujoco.mjtGeom.mjGEOM_SDF):
        return _mesh(model, int(model.geom_dataid[geom]))
    ball = m3.Manifold.sphere(1.0, ROUND)
    if kind == mujoco.mjtGeom.mjGEOM_BOX:
        return box(2.0 * size, at=(0.0, 0.0, -size[2])).trimesh()
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return cylinder(size[0], 2.0 * size[1], segments=ROUND).at(z=-size[1]).trimesh()
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        return Solid(ball.scale([size[0]] * 3)).trimesh()
    if kind == mujoco.mjtGeom.mjGEOM_ELLIPSOID:
        return Solid(ball.scale(size.tolist())).trimesh()
    if kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        end = ball.scale([size[0]] * 3)
        ends = [end.translate((0.0, 0.0, z)) for z in (-size[1], size[1])]
        return Solid(m3.Manifold.batch_hull(ends)).trimesh()
    raise GeometryError(f"a geom of kind {kind.name} has no surface here")


def _mesh(model: mujoco.MjModel, mesh: int) -> TriMesh:
    first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
    start, faces = model.mesh_faceadr[mesh], model.mesh_facenum[mesh]
    vertices = model.mesh_vert[first : first + count].astype(np.float64)
    return as_bodies(vertices, model.mesh_face[start : start + faces])
