"""A GLB holds what the job says: tree, places, triangles, normals, materials, images."""

import dataclasses
import hashlib
import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from artgen.core.jsonio import plain
from artgen.core.mesh import TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.finish_jobs import (
    GltfArrays,
    GltfImages,
    GltfJob,
    GltfPart,
    GltfSurface,
    OcclusionBake,
    write_gltf_arrays,
)
from artgen.geometry.normals import corner_normals
from artgen.geometry.solid import box, cylinder
from artgen.worker import BlenderWorker

pytestmark = pytest.mark.blender

HINGE = (-0.31, -0.17, 0.05)
KNOB = (0.1, -0.21, 0.3)
SURFACES = (
    SurfaceSpec(name="wood", recipe="plain", roughness=0.6),
    SurfaceSpec(name="glass", recipe="plain", transmission=1.0, roughness=0.0, ior=1.45),
    SurfaceSpec(name="lamp", recipe="plain", color=(0.1, 0.5, 0.9), emission=3.0),
    SurfaceSpec(name="unused", recipe="plain"),
)


def arrays(mesh: TriMesh, slots: list[int]) -> GltfArrays:
    rng = np.random.default_rng(len(mesh.faces))
    return GltfArrays(
        vertices=mesh.vertices,
        faces=mesh.faces,
        normals=corner_normals(mesh),
        uv=rng.uniform(-2, 3, (len(mesh.faces), 3, 2)),
        atlas=rng.uniform(0, 1, (len(mesh.faces), 3, 2)),
        slot=np.resize(np.array(slots, np.int16), len(mesh.faces)),
    )


PARTS = (
    arrays(box((0.6, 0.4, 0.5)).trimesh(), [0]),
    arrays(box((0.6, 0.02, 0.5)).at(0, -0.21).trimesh(), [1, 0]),
    arrays(cylinder(0.01, 0.02, axis="y", segments=12).at(*KNOB).trimesh(), [2]),
)


def job(folder: Path) -> GltfJob:
    picture = np.random.default_rng(7).integers(0, 255, (8, 8, 3), np.uint8)
    for name in ("color", "orm"):
        Image.fromarray(picture).save(folder / f"wood_{name}.png")
    write_gltf_arrays(
        folder / "arrays.npz", dict(zip(("knob", "door", "base"), PARTS[::-1], strict=True))
    )
    images = {
        "wood": GltfImages(color=str(folder / "wood_color.png"), orm=str(folder / "wood_orm.png"))
    }
    return GltfJob(
        parts=(
            GltfPart(name="base", parent=None, origin=(0.0, 0.0, 0.0), extras={"label": "body"}),
            GltfPart(
                name="door",
                parent="base",
                origin=HINGE,
                extras={"joint": {"axis": [0.0, 1.0, 0.0], "limit": None}, "mass": 1.0 / 3.0},
            ),
            GltfPart(name="knob", parent="door", origin=KNOB),
        ),
        surfaces=tuple(GltfSurface.of(s, images.get(s.name, GltfImages())) for s in SURFACES),
        extras={"asset_id": "thing_000001"},
        arrays=str(folder / "arrays.npz"),
        output=str(folder / "asset.glb"),
    )


@pytest.fixture(scope="module")
def glb(blender: BlenderWorker, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("gltf")
    blender.run(plain(job(folder)), timeout_s=60)
    return folder / "asset.glb"


def chunks(path: Path) -> tuple[dict[str, Any], bytes]:
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def test_the_job_survives_json(tmp_path: Path) -> None:
    task = job(tmp_path)
    assert GltfJob.from_plain(json.loads(json.dumps(plain(task)))) == task


def test_nodes_nest_as_joints_do_at_exact_places(glb: Path) -> None:
    """Translations are ours in float64, y up, relative to the parent's origin."""
    document, _ = chunks(glb)
    nodes = {node["name"]: node for node in document["nodes"]}
    names = [node["name"] for node in document["nodes"]]
    assert [names[k] for k in document["scenes"][0]["nodes"]] == ["base"]
    assert [names[k] for k in nodes["base"]["children"]] == ["door"]
    assert [names[k] for k in nodes["door"]["children"]] == ["knob"]
    assert "translation" not in nodes["base"]
    x, y, z = HINGE
    assert nodes["door"]["translation"] == [x, z, -y]
    x, y, z = np.subtract(KNOB, HINGE)
    assert nodes["knob"]["translation"] == [x, z, -y]


def test_extras_come_through_exactly(glb: Path) -> None:
    document, _ = chunks(glb)
    nodes = {node["name"]: node for node in document["nodes"]}
    assert document["scenes"][0]["extras"] == {"asset_id": "thing_000001"}
    assert nodes["base"]["extras"] == {"label": "body"}
    assert nodes["door"]["extras"]["mass"] == 1.0 / 3.0
    assert nodes["door"]["extras"]["joint"] == {"axis": [0.0, 1.0, 0.0], "limit": None}


def test_triangles_and_normals_are_where_they_were(glb: Path) -> None:
    """Vertices are float32 about the node's origin: 0.6 m / 2^24 = 4e-8, twice for the sum. Normals
    go through Blender's 16-bit encoding: 1e-4 rad, then four decimals."""
    scene = trimesh.load(glb)
    document, binary = chunks(glb)
    for name, part in zip(("base", "door", "knob"), PARTS, strict=True):
        pose, _ = scene.graph.get(name)
        node = next(n for n in document["nodes"] if n["name"] == name)
        corners, normals = [], []
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            index = accessor(document, binary, primitive["indices"]).reshape(-1)
            corners.append(accessor(document, binary, primitive["attributes"]["POSITION"])[index])
            normals.append(accessor(document, binary, primitive["attributes"]["NORMAL"])[index])
        world = np.concatenate(corners) @ pose[:3, :3].T + pose[:3, 3]
        got = np.stack([world[:, 0], -world[:, 2], world[:, 1]], axis=1)
        bent = np.concatenate(normals)[:, [0, 2, 1]] * (1, -1, 1)
        order = np.argsort(part.slot, kind="stable")
        want = part.vertices[part.faces[order]].reshape(-1, 3)
        np.testing.assert_allclose(got, want, rtol=0, atol=1e-7)
        cosine = np.einsum("ij,ij->i", bent, part.normals[order].reshape(-1, 3))
        assert cosine.min() > np.cos(1e-3)


def accessor(document: dict[str, Any], binary: bytes, index: int) -> np.ndarray:
    kind = document["accessors"][index]
    view = document["bufferViews"][kind["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[kind["type"]]
    dtype = {5126: np.float32, 5123: np.uint16, 5125: np.uint32}[kind["componentType"]]
    start = view.get("byteOffset", 0)
    return np.frombuffer(binary, dtype, kind["count"] * width, start).reshape(-1, width)


def test_both_uv_sets_come_through_with_v_up(glb: Path) -> None:
    """glTF counts v from the top of the image: v' = 1 - v, in float32."""
    document, binary = chunks(glb)
    (primitive,) = document["meshes"][
        next(n for n in document["nodes"] if n["name"] == "base")["mesh"]
    ]["primitives"]
    index = accessor(document, binary, primitive["indices"]).reshape(-1)
    for attribute, want in (("TEXCOORD_0", PARTS[0].uv), ("TEXCOORD_1", PARTS[0].atlas)):
        got = accessor(document, binary, primitive["attributes"][attribute])[index]
        flipped = np.stack([got[:, 0], 1.0 - got[:, 1]], axis=1)
        np.testing.assert_allclose(flipped, want.reshape(-1, 2), rtol=0, atol=4e-7)


def test_materials_say_what_the_surfaces_say(glb: Path) -> None:
    document, _ = chunks(glb)
    materials = {material["name"]: material for material in document["materials"]}
    assert set(materials) == {"wood", "glass", "lamp"}
    assert not any(material.get("doubleSided") for material in materials.values())
    assert "baseColorTexture" in materials["wood"]["pbrMetallicRoughness"]
    assert "metallicRoughnessTexture" in materials["wood"]["pbrMetallicRoughness"]
    glass = materials["glass"]["extensions"]
    assert glass["KHR_materials_transmission"]["transmissionFactor"] == 1
    assert glass["KHR_materials_ior"]["ior"] == pytest.approx(1.45, abs=1e-6)  # float32
    lamp = materials["lamp"]
    glow = np.multiply(
        lamp["emissiveFactor"],
        lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"],
    )
    np.testing.assert_allclose(glow, np.multiply(3.0, SURFACES[2].color), rtol=1e-6)


def test_images_are_the_files_byte_for_byte(glb: Path) -> None:
    document, binary = chunks(glb)
    for image in document["images"]:
        view = document["bufferViews"][image["bufferView"]]
        data = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        assert data == (glb.parent / f"{image['name']}.png").read_bytes()
        assert Image.open(io.BytesIO(data)).size == (8, 8)


def test_another_process_writes_the_same_bytes(glb: Path, tmp_path: Path) -> None:
    before = hashlib.sha256(glb.read_bytes()).hexdigest()
    task = job(tmp_path)
    with BlenderWorker(tmp_path / "log") as other:
        other.run(plain(task), timeout_s=60)
        assert hashlib.sha256(Path(task.output).read_bytes()).hexdigest() == before
        other.run(plain(task), timeout_s=60)
    assert hashlib.sha256(Path(task.output).read_bytes()).hexdigest() == before


def test_occlusion_is_baked_on_the_atlas_and_worn_by_every_material(
    blender: BlenderWorker, tmp_path: Path
) -> None:
    """Convex bodies that stand apart shade nothing: white wherever a chart lies. A slot in a block
    is darker at its bottom than at its rim."""
    slotted = (box((0.4, 0.4, 0.3)) - box((0.1, 0.5, 0.25), at=(0.0, 0.0, 0.06))).trimesh()
    unit = np.array([[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]])
    side = int(np.ceil(np.sqrt(len(slotted.faces) + 12)))
    cells = np.array([(k % side, k // side) for k in range(len(slotted.faces) + 12)])
    atlas = (cells[:, None] + 0.1 + 0.8 * unit) / side
    arrays_of = {"base": slotted, "door": box((0.3, 0.02, 0.3)).at(0, -0.3).trimesh()}
    parts, start = {}, 0
    for name, mesh in arrays_of.items():
        own = arrays(mesh, [0])
        window = atlas[start : start + len(mesh.faces)]
        parts[name] = dataclasses.replace(own, atlas=window)
        start += len(mesh.faces)
    task = job(tmp_path)
    write_gltf_arrays(tmp_path / "arrays.npz", parts)
    bake = OcclusionBake(output=str(tmp_path / "ao.png"), size=256, samples=16)
    task = dataclasses.replace(task, parts=task.parts[:2], occlusion=bake)
    blender.run(plain(task), timeout_s=60)
    image = np.asarray(Image.open(tmp_path / "ao.png")).astype(float) / 255.0
    assert image.shape == (256, 256)
    middle = (atlas.mean(axis=1) * 256).astype(int)
    shown = image[255 - middle[:, 1], middle[:, 0]]
    corners = slotted.vertices[slotted.faces]
    bottom = (np.ptp(corners[..., 2], axis=1) < 1e-9) & (np.abs(corners[:, 0, 2] - 0.06) < 1e-6)
    assert bottom.sum() == 2
    assert shown[len(slotted.faces) :].min() > 0.99
    assert shown[: len(slotted.faces)][bottom].max() < 0.7
    document, _ = chunks(Path(task.output))
    assert all(m["occlusionTexture"]["texCoord"] == 1 for m in document["materials"])
