"""Albedo, roughness and flow at cast hits: exact where the answer is known, and as Cycles sees
them."""

import dataclasses
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.articulation.types import Body, Draft, DraftPart
from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.errors import RenderError
from artgen.core.jsonio import plain
from artgen.core.mesh import Floats, TriMesh
from artgen.core.rotation import axis_angle_matrix
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec, linear_from_srgb, srgb_hex
from artgen.core.transform import apply, rigid
from artgen.dataset.sample import BACKGROUND
from artgen.export import Bundle
from artgen.export.glb_content import Skin
from artgen.geometry.solid import box
from artgen.render_job import RenderJob
from artgen.worker import BlenderWorker
from renders.collect import cast
from renders.glb import Appearance, Look
from renders.labels import Labels, cast_labels
from renders.paint import Paint, sampled
from renders.plan import plan_render
from renders.raycast import PartCaster
from renders.settings import Settings
from tests.unit.renders.conftest import written

SIZE = (48, 40)
FULL = (0, 0, *SIZE)
LINEAR = np.array([linear_from_srgb(k / 255.0) for k in range(256)])


def view(points: Floats, azimuth: float = 0.4) -> Camera:
    return framed(points, direction=orbit_direction(azimuth, 0.35), fov=0.5, size=SIZE, fill=0.9)


def moved(mesh: TriMesh, poses: list[Floats], camera: Camera) -> Labels:
    return cast_labels(
        [PartCaster(mesh)],
        [[pose] for pose in poses],
        [camera],
        [[[FULL]]] * len(poses),
        moving=True,
    )


@given(st.floats(-1.5, 1.5), st.floats(-3, 3))
def test_flow_of_a_turning_part_is_the_closed_form(angle: float, azimuth: float) -> None:
    """A pixel sees x = eye + depth * ray; turned about z it projects to P(R x). Depth is stored in
    float32, 1e-7 of 2 m, which moves the projection by under 1e-4 px."""
    mesh = box((0.5, 0.3, 0.4)).trimesh()
    pose = rigid(axis_angle_matrix((0.0, 0.0, 1.0), angle), (0.0, 0.0, 0.0))
    camera = view(np.concatenate([mesh.vertices, apply(pose, mesh.vertices)]), azimuth)
    labels = moved(mesh, [np.eye(4), pose], camera)
    assert labels.flow is not None
    seen = labels.part_id[0, 0] == 0
    eye, rays = camera.rays()
    points = eye + labels.depth[0, 0][seen][:, None].astype(np.float64) * rays[seen]
    rows, columns = np.nonzero(seen)
    centers = np.stack([columns + 0.5, rows + 0.5], axis=1)
    expected = camera.project(apply(pose, points))[:, :2] - centers
    np.testing.assert_allclose(labels.flow[0, 0][seen], expected, atol=1e-3)
    assert not labels.flow[0, 0][~seen].any()
    assert not labels.flow[1].any()


def test_flow_finds_the_same_point_in_the_next_state() -> None:
    """Where a surface point goes, the next state's depth shows it again, unless it turned away."""
    mesh = box((0.5, 0.05, 0.4)).trimesh()
    pose = rigid(axis_angle_matrix((0.0, 0.0, 1.0), 0.3), (0.02, 0.0, 0.03))
    camera = view(np.concatenate([mesh.vertices, apply(pose, mesh.vertices)]), 0.1)
    labels = moved(mesh, [np.eye(4), pose], camera)
    assert labels.flow is not None
    rows, columns = np.nonzero(labels.part_id[0, 0] == 0)
    target = np.stack([columns, rows], axis=1) + 0.5 + labels.flow[0, 0][rows, columns]
    column, row = np.floor(target).astype(int).T
    assert (labels.part_id[1, 0][row, column] == 0).mean() > 0.95


def test_a_still_part_does_not_flow() -> None:
    mesh = box((0.5, 0.3, 0.4)).trimesh()
    labels = moved(mesh, [np.eye(4)] * 3, view(mesh.vertices))
    assert labels.flow is not None
    assert not labels.flow.any()


def painted(look: Look, uv: Floats, spec: SurfaceSpec, camera_of: Floats) -> Labels:
    mesh = box((0.5, 0.3, 0.4)).trimesh()
    skin = Skin(
        part="block",
        surface=spec.name,
        vertices=mesh.triangles.reshape(-1, 3),
        normals=np.zeros((3 * len(mesh.faces), 3)),
        uv=uv[mesh.faces.ravel()] if len(uv) else np.zeros((3 * len(mesh.faces), 2)),
        faces=np.arange(3 * len(mesh.faces), dtype=np.int32).reshape(-1, 3)[::-1],  # other order
    )
    paint = Paint(
        "block",
        mesh,
        Appearance(skins=(skin,), looks={spec.name: look}),
        {spec.name: spec},
    )
    return cast_labels(
        [PartCaster(mesh)], [[np.eye(4)]], [view(camera_of)], [[[FULL]]], paint=[paint]
    )


def test_albedo_of_a_plain_surface_is_its_color() -> None:
    spec = SurfaceSpec(name="paint", recipe="plain", color=(0.7, 0.2, 0.01), roughness=0.3)
    mesh = box((0.5, 0.3, 0.4)).trimesh()
    labels = painted(Look(), np.zeros((0, 2)), spec, mesh.vertices)
    assert labels.albedo is not None
    assert labels.roughness is not None
    seen = labels.part_id == 0
    expected = [int(srgb_hex(spec.color)[k : k + 2], 16) for k in (1, 3, 5)]
    assert (labels.albedo[seen] == expected).all()
    assert (labels.roughness[seen] == round(0.3 * 255)).all()
    assert not labels.albedo[~seen].any()
    assert not labels.roughness[~seen].any()


def test_albedo_reads_the_image_where_the_surface_is_hit() -> None:
    """Texture coordinates x and z in meters, an image that is a ramp in both: the code tells the
    point, to half a code, and the point is where the ray ends."""
    mesh = box((0.5, 0.3, 0.4)).trimesh()
    ramp = np.zeros((256, 256, 3), np.uint8)
    ramp[..., 0], ramp[..., 1] = np.arange(256)[None, :], np.arange(256)[:, None]
    uv = np.asarray(mesh.vertices)[:, (0, 2)] + (0.4, 0.2)
    spec = SurfaceSpec(name="ramp", recipe="plain")
    labels = painted(Look(color=ramp), uv, spec, mesh.vertices)
    assert labels.albedo is not None
    seen = labels.part_id[0, 0] == 0
    eye, rays = view(mesh.vertices).rays()
    points = eye + labels.depth[0, 0][seen][:, None] * rays[seen]
    expected = (points[:, (0, 2)] + (0.4, 0.2)) * 256 - 0.5
    np.testing.assert_allclose(labels.albedo[0, 0][seen][:, :2], expected, atol=0.51)


def test_lookups_are_bilinear_and_repeat() -> None:
    image = np.array([[[0], [100]], [[200], [60]]], np.uint8)
    at = np.array([[0.25, 0.25], [0.75, 0.25], [0.5, 0.25], [0.5, 0.5], [1.25, -0.75], [0.0, 0.25]])
    assert sampled(image, at)[:, 0].tolist() == [0, 100, 50, 90, 0, 50]


def test_a_glb_of_another_mesh_is_told() -> None:
    mesh, other = box((0.5, 0.3, 0.4)).trimesh(), box((0.5, 0.3, 0.5)).trimesh()
    skin = Skin(
        part="block",
        surface="paint",
        vertices=np.asarray(other.vertices),
        normals=np.asarray(other.vertices),
        uv=np.zeros((len(other.vertices), 2)),
        faces=np.asarray(other.faces),
    )
    spec = SurfaceSpec(name="paint", recipe="plain")
    looks = Appearance(skins=(skin,), looks={"paint": Look()})
    with pytest.raises(RenderError, match="part block has 12 triangles.*m apart; generate"):
        Paint("block", mesh, looks, {"paint": spec})
    with pytest.raises(RenderError, match="no part lid"):
        Paint("lid", mesh, looks, {"paint": spec})


def test_a_part_of_no_size_is_seen_nowhere() -> None:
    """Three corners on a line, and three in one place; beside them a body that is seen as ever."""
    line = TriMesh(vertices=np.array([[0.0, 0, 0], [0.1, 0, 0], [0.2, 0, 0]]), faces=[[0, 1, 2]])
    point = TriMesh(vertices=np.zeros((3, 3)), faces=[[0, 1, 2]])
    block = box((0.5, 0.3, 0.4)).trimesh()
    labels = cast_labels(
        [PartCaster(line), PartCaster(point), PartCaster(block)],
        [[np.eye(4)] * 3],
        [view(block.vertices)],
        [[[FULL] * 3]],
    )
    assert set(np.unique(labels.part_id)) == {2, BACKGROUND}
    assert not labels.part_depth[:, :, :2].any()
    assert np.isfinite(labels.part_normal).all()


def cycles_passes(blender: BlenderWorker, job: RenderJob) -> list[dict[str, Floats]]:
    """Channel name to (H, W), for each shot; depth and index are those of the pixel's first ray."""
    blender.run(plain(job), timeout_s=120)
    found = []
    for shot in job.shots:
        image = oiio.ImageBuf(str(Path(job.folder) / shot.file))
        pixels = image.get_pixels(oiio.FLOAT)
        names = [name.split(".", 1)[1] for name in image.spec().channelnames]
        found.append({name: pixels[..., k] for k, name in enumerate(names)})
    return found


def board() -> Draft:
    """A wooden block under a block of one color."""
    wood = SurfaceSpec(
        name="wood", recipe="wood", roughness=0.6, tile=(0.6, 0.3), detail={"species": "oak"}
    )
    paint = SurfaceSpec(name="paint", recipe="plain", color=(0.7, 0.2, 0.1), roughness=0.9)
    pieces = (
        (box((0.4, 0.3, 0.1)), "wood"),
        (box((0.3, 0.2, 0.15), at=(0.0, 0.0, 0.101)), "paint"),
    )
    bodies = tuple(
        Body(solid=solid, surface=surface, density=600.0, collision=(solid,))
        for solid, surface in pieces
    )
    base = DraftPart(name="base", label="base", bodies=bodies)
    return Draft(category="board", parts=(base,), joints=(), surfaces=(wood, paint))


def compared(
    bundle: Bundle, blender: BlenderWorker, folder: Path
) -> list[tuple[dict[str, Floats], dict[str, Floats]]]:
    """What Cycles and the caster say of each composite of two views and states, at 96 px."""
    settings = Settings(views=2, states=2, size=96, accuracy="1spp", extras=("albedo",))
    plan = plan_render(bundle, Stream(3), settings=settings, folder=folder)
    shots = tuple(shot for shot in plan.passes.shots if shot.part is None)
    asked = ("depth", "part", "albedo")
    # Rays that cross a thin pane label what is behind it; a refracting body is labeled itself.
    bodies = dataclasses.replace(plan.job.transport, panes=())
    job = dataclasses.replace(plan.job, shots=shots, denoise=False, passes=asked, transport=bodies)
    labels = cast(plan)
    assert labels.albedo is not None
    # Blender numbers parts from 1 by name, we from 0 in canonical order.
    order = sorted(part.name for part in bundle.parts)
    number = [order.index(part.name) + 1 for part in bundle.parts]
    pairs = []
    for shot, theirs in zip(shots, cycles_passes(blender, job), strict=True):
        at = (shot.state, shot.camera)
        ids = labels.part_id[at]
        ours = {
            "part": np.where(ids == BACKGROUND, 0, np.array([*number, *[0] * 256])[ids]),
            "depth": labels.depth[at],
            "albedo": LINEAR[labels.albedo[at]],
        }
        pairs.append((theirs, ours))
    return pairs


@pytest.mark.blender
def test_ids_and_depth_agree_with_cycles(
    bundle: Bundle, blender: BlenderWorker, tmp_path: Path
) -> None:
    """Cycles works in float32, whose rounding is 1e-7 of 1.5 m at right angles and grows with the
    slope of the surface; a pixel whose center lies on an outline may go either way."""
    for theirs, ours in compared(bundle, blender, tmp_path):
        same = theirs["IndexOB.X"] == ours["part"]
        assert same.mean() >= 0.999
        shown = same & (ours["part"] > 0)
        gap = np.abs(theirs["Depth.Z"] - ours["depth"])[shown]
        assert np.median(gap) < 2e-5
        assert (gap < 1e-4).mean() >= 0.99


@pytest.mark.blender
def test_albedo_agrees_with_cycles(blender: BlenderWorker, tmp_path: Path) -> None:
    """Cycles' diffuse color is the base color less what the coat of Fresnel's law mirrors, 3 to 8 %
    by angle. It reads between texels as we do; a map that is shifted by a texel of 1 mm or turned
    over is off by a fifth on the grain."""
    bundle = written(board(), tmp_path / "000004", blender)
    for theirs, ours in compared(bundle, blender, tmp_path):
        shown = ours["part"] > 0
        diffuse = np.stack([theirs[f"DiffCol.{c}"] for c in "RGB"], axis=-1)[shown]
        ratio = diffuse[:, 0] / ours["albedo"][shown][:, 0]
        assert 0.9 < np.median(ratio) < 1.0
        assert (np.abs(ratio / np.median(ratio) - 1.0) < 0.06).mean() > 0.9
