"""USD: materials with images, scene metadata, collision shapes."""

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image
from pxr import Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdValidation

from artgen.core.surface import SurfaceSpec
from artgen.export.surface_images import SurfaceImages
from artgen.export.usd import write_usd
from artgen.export.usd_materials import add_material
from tests.strategies import chest, drawer_unit

KINDS = ("color", "orm", "normal", "emission")


@pytest.fixture
def textured(tmp_path: Path) -> Usd.Stage:
    """An object whose wood has every kind of image."""
    (tmp_path / "textures").mkdir()
    for kind in KINDS:
        Image.new("RGB", (4, 4)).save(tmp_path / f"textures/{kind}.png")
    images = SurfaceImages(**{kind: f"textures/{kind}.png" for kind in KINDS})
    write_usd(drawer_unit(), tmp_path / "asset.usdc", {"wood": images})
    return Usd.Stage.Open(str(tmp_path / "asset.usdc"))


def surface_shader(stage: Usd.Stage, name: str) -> UsdShade.Shader:
    return UsdShade.Shader(stage.GetPrimAtPath(f"/unit_000002/materials/{name}/surface"))


def test_images_resolve_beside_the_file_and_repeat(textured: Usd.Stage) -> None:
    nodes = [
        UsdShade.Shader(prim)
        for prim in textured.Traverse()
        if UsdShade.Shader(prim) and UsdShade.Shader(prim).GetIdAttr().Get() == "UsdUVTexture"
    ]
    assert len(nodes) == len(KINDS)
    for node in nodes:
        asset = node.GetInput("file").Get()
        assert asset.path.startswith("./textures/")
        assert Path(asset.resolvedPath).is_file()
        assert [node.GetInput(side).Get() for side in ("wrapS", "wrapT")] == ["repeat"] * 2


def test_images_replace_numbers(textured: Usd.Stage) -> None:
    sources = {"diffuseColor": "color", "roughness": "orm", "metallic": "orm",
               "normal": "normal", "emissiveColor": "emission"}  # fmt: skip
    for name, node in sources.items():
        found = surface_shader(textured, "wood").GetInput(name)
        (source,) = found.GetConnectedSources()[0]
        assert source.source.GetPrim().GetName() == node
        assert found.GetAttr().Get() is None
    channels = {name: surface_shader(textured, "wood").GetInput(name).GetConnectedSources()[0][0]
                .sourceName for name in ("roughness", "metallic")}  # fmt: skip
    assert channels == {"roughness": "g", "metallic": "b"}


def test_without_images_the_numbers_stand(textured: Usd.Stage) -> None:
    shader = surface_shader(textured, "steel")
    assert_allclose(shader.GetInput("roughness").Get(), 0.3, rtol=2.0**-23)
    assert shader.GetInput("metallic").Get() == 1.0


def test_textured_materials_pass_every_validator(textured: Usd.Stage) -> None:
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    errors = UsdValidation.ValidationContext(validators).Validate(textured)
    assert [error.GetErrorAsString() for error in errors] == []


def test_panes_are_nearly_clear() -> None:
    stage = Usd.Stage.CreateInMemory()
    pane = SurfaceSpec(name="pane", recipe="plain", transmission=1.0, ior=1.52)
    add_material(stage, Sdf.Path("/"), pane, SurfaceImages())
    shader = UsdShade.Shader(stage.GetPrimAtPath("/pane/surface"))
    assert 0.0 < shader.GetInput("opacity").Get() < 0.2
    assert_allclose(shader.GetInput("ior").Get(), 1.52, rtol=2.0**-23)


def test_units_and_axes_are_stated(textured: Usd.Stage) -> None:
    assert UsdGeom.GetStageUpAxis(textured) == "Z"
    assert UsdGeom.GetStageMetersPerUnit(textured) == 1.0
    assert UsdPhysics.GetStageKilogramsPerUnit(textured) == 1.0
    assert textured.GetDefaultPrim().GetName() == "unit_000002"
    assert textured.GetDefaultPrim().HasAPI(UsdPhysics.ArticulationRootAPI)


def test_texture_coordinates_count_tiles(textured: Usd.Stage) -> None:
    """`st` is meters over the tile of the triangle's surface, within one rounding to float32."""
    obj = drawer_unit()
    mesh = obj.parts[3].mesh  # The knob, of steel alone.
    prim = UsdGeom.PrimvarsAPI(textured.GetPrimAtPath("/unit_000002/door/visual"))
    st = np.array(prim.GetPrimvar("st").ComputeFlattened()).reshape(-1, 3, 2)
    assert_allclose(st, obj.parts[2].mesh.uv / obj.surfaces[0].tile, rtol=2.0**-23, atol=1e-30)
    knob = UsdGeom.PrimvarsAPI(textured.GetPrimAtPath("/unit_000002/knob/visual"))
    st1 = np.array(knob.GetPrimvar("st1").ComputeFlattened()).reshape(-1, 3, 2)
    assert_allclose(st1, mesh.atlas, rtol=2.0**-23)


def test_subsets_split_a_part_of_two_surfaces(tmp_path: Path) -> None:
    write_usd(chest(), tmp_path / "asset.usda", {})
    stage = Usd.Stage.Open(str(tmp_path / "asset.usda"))
    lid = UsdGeom.Imageable(stage.GetPrimAtPath("/chest_000001/lid/visual"))
    faces = {}
    for subset in UsdGeom.Subset.GetAllGeomSubsets(lid):
        material = UsdShade.MaterialBindingAPI(subset).ComputeBoundMaterial()[0]
        faces[material.GetPath().name] = list(subset.GetIndicesAttr().Get())
    assert faces == {"wood": list(range(12)), "steel": list(range(12, 24))}


def test_a_part_of_one_surface_is_bound_whole(textured: Usd.Stage) -> None:
    base = textured.GetPrimAtPath("/unit_000002/base/visual")
    assert UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(base)) == []
    assert UsdShade.MaterialBindingAPI(base).ComputeBoundMaterial()[0].GetPath().name == "wood"


def test_angular_drives_and_limits_count_degrees(textured: Usd.Stage) -> None:
    """The door: 1.9 rad, 0.05 N m s/rad, a spring of 2 N m/rad about -0.25 rad."""
    prim = textured.GetPrimAtPath("/unit_000002/joints/swing")
    drive, joint = UsdPhysics.DriveAPI(prim, "angular"), UsdPhysics.RevoluteJoint(prim)
    found = [drive.GetDampingAttr(), drive.GetStiffnessAttr(), drive.GetTargetPositionAttr(),
             joint.GetUpperLimitAttr()]  # fmt: skip
    expected = [0.05 / 57.29577951308232, 2.0 / 57.29577951308232, -14.32394487827058,
                108.86198107485642]  # fmt: skip
    assert_allclose([attribute.Get() for attribute in found], expected, rtol=2.0**-22)


def test_linear_drives_and_limits_count_metres(textured: Usd.Stage) -> None:
    prim = textured.GetPrimAtPath("/unit_000002/joints/slide")
    drive, joint = UsdPhysics.DriveAPI(prim, "linear"), UsdPhysics.PrismaticJoint(prim)
    found = [drive.GetDampingAttr().Get(), joint.GetUpperLimitAttr().Get()]
    assert_allclose(found, [0.05, 0.3], rtol=2.0**-23)


def test_the_physics_parser_finds_every_body_joint_and_shape(textured: Usd.Stage) -> None:
    found = UsdPhysics.UsdPhysicsLoadStageFromPrimRange(textured, ["/"])
    assert all(desc.isValid for _, descs in found.values() for desc in descs)
    types = UsdPhysics.ObjectType
    counts = {types.RigidBody: 4, types.Articulation: 1, types.RevoluteJoint: 2,
              types.PrismaticJoint: 1, types.FixedJoint: 1, types.CubeShape: 4,
              types.MeshShape: 1}  # fmt: skip
    assert {kind: len(found[kind][0]) for kind in counts} == counts


def test_collision_is_boxes_and_convex_hulls(textured: Usd.Stage) -> None:
    kinds = {}
    for prim in textured.Traverse():
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            kinds.setdefault(prim.GetTypeName(), []).append(prim)
    assert {kind: len(prims) for kind, prims in kinds.items()} == {"Cube": 4, "Mesh": 1}
    approximation = UsdPhysics.MeshCollisionAPI(kinds["Mesh"][0]).GetApproximationAttr().Get()
    assert approximation == "convexHull"


def test_collision_boxes_stand_where_they_were_authored(textured: Usd.Stage) -> None:
    """Sizes are float32, places float64."""
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.guide])
    prim = textured.GetPrimAtPath("/unit_000002/door/collision/box_0")
    box = cache.ComputeWorldBound(prim).ComputeAlignedRange()
    found = np.array([box.GetMin(), box.GetMax()])
    assert_allclose(found, drawer_unit().parts[2].collision[0].bounds, rtol=0, atol=2.0**-24)
