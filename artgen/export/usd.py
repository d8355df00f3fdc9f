"""USD: a UsdPhysics articulation with UsdPreviewSurface materials, read by usd-core and its kin."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdSemantics, UsdShade, Vt

from artgen.articulation.grips import grip_frame
from artgen.articulation.types import ArticulatedObject, Grip, Part
from artgen.core.conventions import NORMAL_DECIMALS
from artgen.core.mesh import Floats, TriMesh
from artgen.export.layout import BoxPiece, HullPiece, collision_pieces, pivots
from artgen.export.obj import distinct
from artgen.export.principal import principal_axes, quaternion_from_matrix
from artgen.export.surface_images import SurfaceImages
from artgen.export.usd_joints import GRIPS, add_base_joint, add_joint
from artgen.export.usd_materials import add_contact_material, add_material
from artgen.geometry.normals import corner_normals

JOINTS, MATERIALS, VISUAL, COLLISION = "joints", "materials", "visual", "collision"


def write_usd(obj: ArticulatedObject, path: Path, images: Mapping[str, SurfaceImages]) -> None:
    """The whole asset as one layer, fixed to the world.

    Args:
        obj: the finished object.
        path: ends in .usdc (binary) or .usda (text).
        images: surface name to image paths relative to `path`'s folder; missing names have none.
    """
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, f"/{obj.asset_id}").GetPrim()
    stage.SetDefaultPrim(root)
    Usd.ModelAPI(root).SetKind("component")
    UsdPhysics.ArticulationRootAPI.Apply(root)
    _label(root, "category", obj.category)
    top = root.GetPath()
    materials = UsdGeom.Scope.Define(stage, top.AppendChild(MATERIALS)).GetPath()
    looks = [
        add_material(stage, materials, surface, images.get(surface.name, SurfaceImages()))
        for surface in obj.surfaces
    ]
    contact = add_contact_material(stage, materials)
    frames = pivots(obj)
    for part in obj.parts:
        _add_part(stage, obj, part, frames[part.name], looks, contact)
    scope = UsdGeom.Scope.Define(stage, top.AppendChild(JOINTS)).GetPath()
    add_base_joint(stage, scope, top.AppendChild(obj.base.name))
    for joint in obj.joints:
        add_joint(stage, scope, top, joint, frames, obj.preconditions)
    stage.GetRootLayer().Export(str(path))


def _label(prim: Usd.Prim, taxonomy: str, word: str) -> None:
    UsdSemantics.LabelsAPI.Apply(prim, taxonomy).CreateLabelsAttr([word])


def _add_part(
    stage: Usd.Stage,
    obj: ArticulatedObject,
    part: Part,
    pivot: Floats,
    looks: list[UsdShade.Material],
    contact: UsdShade.Material,
) -> None:
    """A rigid body whose frame lies at the joint's origin, parallel to the object frame."""
    body = UsdGeom.Xform.Define(stage, f"/{obj.asset_id}/{part.name}")
    body.AddTranslateOp().Set(Gf.Vec3d(*pivot.tolist()))
    prim = body.GetPrim()
    UsdPhysics.RigidBodyAPI.Apply(prim)
    _label(prim, "part", part.label)
    _state_mass(prim, part, pivot)
    mesh = _add_mesh(stage, prim.GetPath().AppendChild(VISUAL), part.mesh, pivot)
    _add_texture_coordinates(mesh, part.mesh, obj)
    _bind(mesh, part.mesh, looks)
    scope = UsdGeom.Scope.Define(stage, prim.GetPath().AppendChild(COLLISION))
    scope.CreatePurposeAttr(UsdGeom.Tokens.guide)
    bound = UsdShade.MaterialBindingAPI.Apply(scope.GetPrim())
    bound.Bind(contact, materialPurpose="physics")
    for piece in collision_pieces(obj.asset_id, part):
        _add_collision(stage, scope.GetPath(), piece, pivot)
    for grip in part.grips:
        _add_grip(stage, prim.GetPath().AppendChild(GRIPS), grip, pivot)


def _add_grip(stage: Usd.Stage, scope: Sdf.Path, grip: Grip, pivot: Floats) -> None:
    """An empty frame; what it is and both directions, in the part's frame, are attributes."""
    UsdGeom.Scope.Define(stage, scope)
    held = UsdGeom.Xform.Define(stage, scope.AppendChild(grip.name))
    frame = grip_frame(grip)
    w, x, y, z = quaternion_from_matrix(frame[:3, :3]).tolist()
    held.AddTranslateOp().Set(Gf.Vec3d(*(frame[:3, 3] - pivot).tolist()))
    held.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Quatd(w, x, y, z))
    prim, types = held.GetPrim(), Sdf.ValueTypeNames
    prim.CreateAttribute("artgen:grip:kind", types.Token).Set(grip.kind)
    prim.CreateAttribute("artgen:grip:outward", types.Vector3d).Set(Gf.Vec3d(*grip.outward))
    prim.CreateAttribute("artgen:grip:pull", types.Vector3d).Set(Gf.Vec3d(*grip.pull))


def _state_mass(prim: Usd.Prim, part: Part, pivot: Floats) -> None:
    moments, rotation = principal_axes(part.mass.inertia)
    w, x, y, z = quaternion_from_matrix(rotation).tolist()
    mass = UsdPhysics.MassAPI.Apply(prim)
    mass.CreateMassAttr(part.mass.mass)
    mass.CreateCenterOfMassAttr(Gf.Vec3f(*(part.mass.center - pivot).tolist()))
    mass.CreateDiagonalInertiaAttr(Gf.Vec3f(*moments.tolist()))
    mass.CreatePrincipalAxesAttr(Gf.Quatf(w, x, y, z))


def _add_mesh(stage: Usd.Stage, path: Sdf.Path, mesh: TriMesh, pivot: Floats) -> UsdGeom.Mesh:
    """Triangles as a polygon mesh in the body's frame, without subdivision."""
    points = (mesh.vertices - pivot).astype(np.float32)
    prim = UsdGeom.Mesh.Define(stage, path)
    prim.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    prim.CreateFaceVertexCountsAttr(Vt.IntArray(len(mesh.faces), 3))
    prim.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(mesh.faces.reshape(-1)))
    prim.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    extent = np.stack([points.min(axis=0), points.max(axis=0)])
    prim.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(extent))
    return prim


def _add_texture_coordinates(prim: UsdGeom.Mesh, mesh: TriMesh, obj: ArticulatedObject) -> None:
    """Corner normals, `st` in tile repeats for the materials and `st1` on the atlas."""
    api, types = UsdGeom.PrimvarsAPI(prim), Sdf.ValueTypeNames
    tiles = np.array([surface.tile for surface in obj.surfaces])
    sets = {"st": np.asarray(mesh.uv) / tiles[np.asarray(mesh.slot)][:, None, :], "st1": mesh.atlas}
    for name, values in sets.items():
        unique, index = distinct(np.asarray(values).reshape(-1, 2))
        primvar = api.CreatePrimvar(name, types.TexCoord2fArray, UsdGeom.Tokens.faceVarying)
        primvar.Set(Vt.Vec2fArray.FromNumpy(unique.astype(np.float32)))
        primvar.SetIndices(Vt.IntArray.FromNumpy(index))
    normals = np.round(corner_normals(mesh), NORMAL_DECIMALS)
    unique, index = distinct(normals.reshape(-1, 3))
    primvar = api.CreatePrimvar("normals", types.Normal3fArray, UsdGeom.Tokens.faceVarying)
    primvar.Set(Vt.Vec3fArray.FromNumpy(unique.astype(np.float32)))
    primvar.SetIndices(Vt.IntArray.FromNumpy(index))


def _bind(prim: UsdGeom.Mesh, mesh: TriMesh, looks: list[UsdShade.Material]) -> None:
    """The material of a part of one surface, else one face subset a surface."""
    slots = np.asarray(mesh.slot)
    used = np.unique(slots).tolist()
    binding = UsdShade.MaterialBindingAPI.Apply(prim.GetPrim())
    if len(used) == 1:
        binding.Bind(looks[used[0]])
        return
    for slot in used:
        faces = np.flatnonzero(slots == slot).astype(np.int32)
        name = looks[slot].GetPath().name
        subset = binding.CreateMaterialBindSubset(name, Vt.IntArray.FromNumpy(faces))
        UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(looks[slot])
    binding.SetMaterialBindSubsetsFamilyType(UsdGeom.Tokens.partition)


def _add_collision(
    stage: Usd.Stage, scope: Sdf.Path, piece: BoxPiece | HullPiece, pivot: Floats
) -> None:
    if isinstance(piece, HullPiece):
        mesh = _add_mesh(stage, scope.AppendChild(f"hull_{piece.index}"), piece.mesh, pivot)
        UsdPhysics.CollisionAPI.Apply(mesh.GetPrim())
        api = UsdPhysics.MeshCollisionAPI.Apply(mesh.GetPrim())
        api.CreateApproximationAttr(UsdPhysics.Tokens.convexHull)
        return
    cube = UsdGeom.Cube.Define(stage, scope.AppendChild(f"box_{piece.index}"))
    cube.CreateSizeAttr(1.0)
    cube.CreateExtentAttr(Vt.Vec3fArray([Gf.Vec3f(-0.5), Gf.Vec3f(0.5)]))
    cube.AddTranslateOp().Set(Gf.Vec3d(*(piece.center - pivot).tolist()))
    cube.AddScaleOp().Set(Gf.Vec3f(*piece.size.tolist()))
    UsdPhysics.CollisionAPI.Apply(cube.GetPrim())
