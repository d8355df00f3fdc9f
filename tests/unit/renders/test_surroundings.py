"""Environments, grounds and moving shutters against closed forms."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.mesh import Floats
from artgen.imaging import Singles, read_exr
from artgen.render_job import Environment, Ground, LightRig, RenderJob, Shot
from artgen.studio import Softbox, softbox_light
from artgen.worker import BlenderWorker
from renders.effects.scenes import DARK, EFFECTS, PLAIN, scene_job, write_scene
from renders.effects.study import rendered

pytestmark = pytest.mark.blender

ROWS = 32
"""Height of the environments, px; a pixel is 5.6 degrees wide."""


@pytest.fixture(scope="module")
def glb(blender: BlenderWorker, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_scene(PLAIN, tmp_path_factory.mktemp("plain"), blender)


def environment_file(path: Path, pixels: Floats) -> Environment:
    file = oiio.ImageOutput.create(str(path))
    file.open(str(path), oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, "float"))
    file.write_image(np.asarray(pixels, np.float32))
    file.close()
    return Environment(file=str(path))


def sun(azimuth: float, elevation: float, strength: float) -> tuple[Floats, Floats]:
    """An image that is dark but for the pixel in a direction, and the middle of that pixel."""
    row = int((math.pi / 2 - elevation) / math.pi * ROWS)
    column = int((azimuth + math.pi) / (2 * math.pi) * 2 * ROWS) % (2 * ROWS)
    pixels = np.zeros((ROWS, 2 * ROWS, 3))
    pixels[row, column] = strength
    high = math.pi / 2 - math.pi * (row + 0.5) / ROWS
    turn = 2 * math.pi * (column + 0.5) / (2 * ROWS) - math.pi
    return pixels, orbit_direction(turn, high)


def lit(job: RenderJob, environment: Environment, part: str | None = "subject") -> RenderJob:
    rig = LightRig(name="sun", lights=(), sky=DARK, environment=environment)
    shot = replace(job.shots[0], part=part)
    return replace(job, rig=rig, shots=(shot,))


def camera_of(job: RenderJob) -> Camera:
    stated = job.cameras[0]
    return Camera(
        focal=stated.focal,
        size=stated.size,
        camera_from_world=np.array(stated.camera_from_world),
        principal=stated.principal,
    )


def seen_at(image: Singles, camera: Camera, point: Floats, half: int = 1) -> Floats:
    x, y = (int(v) for v in camera.project(np.asarray(point, float))[:2])
    return image[y - half : y + half + 1, x - half : x + half + 1].mean(axis=(0, 1))


@pytest.mark.parametrize(
    ("azimuth", "elevation"), [(0.0, 0.3), (1.3, 0.2), (-0.9, 0.9), (2.6, 0.5)]
)
def test_a_sun_of_one_pixel_lights_the_walls_that_face_it(
    azimuth: float, elevation: float, glb: Path, blender: BlenderWorker, tmp_path: Path
) -> None:
    """A wall of albedo a shows a L W cos / pi under a sun of radiance L and solid angle W; beside
    it the coat scatters 5 to 12 % of what comes in, and noise is 2 %."""
    pixels, toward = sun(azimuth, elevation, 200.0)
    job = scene_job(PLAIN, glb, tmp_path, size=48, samples=64)
    job = lit(job, environment_file(tmp_path / "sun.exr", pixels))
    image, _ = rendered(blender, job)
    solid_angle = (math.pi / ROWS) ** 2 * math.sqrt(1.0 - toward[2] ** 2)
    camera = camera_of(job)
    walls = {
        (0.0, -1.0, 0.0): (0.0, -0.12, 0.12),
        (1.0, 0.0, 0.0): (0.07, -0.05, 0.12),
        (0.0, 0.0, 1.0): (0.0, -0.05, 0.22),
    }
    for normal, point in walls.items():
        cosine = float(np.dot(normal, toward))
        green = seen_at(image, camera, np.array(point))[1]
        expected = 0.75 * 200.0 * solid_angle * max(cosine, 0.0) / math.pi
        # The pixel is interpolated over two, so that a wall may see 5.6 degrees past its edge.
        assert green == pytest.approx(expected, rel=0.15, abs=0.03)


def test_a_pane_mirrors_the_environment(blender: BlenderWorker, tmp_path: Path) -> None:
    """By Fresnel's law: at 4 % head on, more at an angle, on both faces; nothing where it is
    dark."""
    effect = EFFECTS["thin_glass"]
    own = write_scene(effect.scene, tmp_path, blender)
    job = scene_job(effect.scene, own, tmp_path, size=48, samples=8)
    camera = camera_of(job)
    middle = np.array([0.02, -0.103, 0.14])
    ray = middle - camera.position
    mirrored = ray * np.array([1.0, -1.0, 1.0]) / np.linalg.norm(ray)
    azimuth, elevation = math.atan2(mirrored[0], -mirrored[1]), math.asin(mirrored[2])
    shown = []
    for turn in (azimuth, azimuth + math.pi / 2):
        pixels = np.zeros((ROWS, 2 * ROWS, 3))
        row = int((math.pi / 2 - elevation) / math.pi * ROWS)
        column = int((turn + math.pi) / (2 * math.pi) * 2 * ROWS) % (2 * ROWS)
        pixels[row - 3 : row + 4, column - 3 : column + 4] = 10.0
        image, _ = rendered(blender, lit(job, environment_file(tmp_path / f"{turn}.exr", pixels)))
        shown.append(float(seen_at(image, camera, middle)[1]))
    assert 0.4 < shown[0] < 1.2
    assert shown[1] == 0.0


def grounded(job: RenderJob, part: str | None) -> RenderJob:
    """One small lamp high in front, seen from behind, where the wall's shadow falls."""
    corners = np.array([[x, y, z] for x in (-0.6, 0.6) for y in (-0.6, 0.9) for z in (0.0, 0.3)])
    view = framed(
        corners,
        direction=orbit_direction(math.pi, math.radians(50)),
        fov=0.6,
        size=(64, 64),
        fill=1.0,
    )
    lamp = softbox_light(
        Softbox(azimuth=0.0, elevation=math.pi / 4, distance=2.83, side=0.02, white=0.8),
        center=(0.0, 0.0, 0.0),
        radius=1.0,
    )
    ground = Ground(height=0.0, center=(0.0, 0.0), radius=3.0)
    whole = Shot(file="view.exr", camera=0, state=0, part=part, box=(0, 0, 64, 64), samples=16)
    rig = LightRig(name="lamp", lights=(lamp,), sky=DARK, ground=ground)
    return replace(job, cameras=(view.stated,), rig=rig, shots=(whole,))


def test_the_ground_shows_the_shadow_and_nothing_else(
    glb: Path, blender: BlenderWorker, tmp_path: Path
) -> None:
    """The lamp stands at (0, -2, 2), the wall's upper edge at y = 0.2, z = 0.3: its shadow ends at
    y = 0.588. In the dark all light comes from the lamp, so a shadow is black: alpha is 1 there,
    but for what the objects around throw into it, and 0 where the lamp is seen."""
    job = grounded(scene_job(PLAIN, glb, tmp_path, size=64, samples=8), None)
    image, _ = rendered(blender, job)
    camera = camera_of(job)
    for y, dark in ((0.35, True), (0.5, True), (0.7, False), (0.85, False)):
        color = seen_at(image, camera, np.array([0.0, y, 0.0]), half=0)
        assert color[3] > 0.9 if dark else color[3] < 0.02
        assert color[:3].max() < 0.02
    for x in (-0.5, 0.5):
        assert seen_at(image, camera, np.array([x, 0.4, 0.0]))[3] < 0.02


def test_a_part_alone_has_no_ground(glb: Path, blender: BlenderWorker, tmp_path: Path) -> None:
    job = grounded(scene_job(PLAIN, glb, tmp_path, size=64, samples=8), "subject")
    with_it, _ = rendered(blender, job)
    without, _ = rendered(blender, replace(job, rig=replace(job.rig, ground=None)))
    assert with_it.any()
    assert np.array_equal(with_it, without)


def test_a_moving_part_is_smeared_over_its_way(blender: BlenderWorker, tmp_path: Path) -> None:
    """At even speed the middle of the blur lies half way, and the middle of a block as wide as its
    way is never left for more than a part of the time: closed form of a box against its motion."""
    scene = EFFECTS["motion_blur"].scene
    own = write_scene(scene, tmp_path, blender)
    job = scene_job(scene, own, tmp_path, size=64, samples=64)
    front = framed(
        np.array([[-0.2, -0.12, 0.0], [0.2, -0.12, 0.3]]),
        direction=orbit_direction(0.0, 0.0),
        fov=0.1,  # So narrow that no side of the block is seen.
        size=(64, 64),
        fill=1.0,
    )
    alone = replace(job.shots[0], part="subject")
    job = replace(job, cameras=(front.stated,), shots=(alone,))
    image, _ = rendered(blender, job)
    row = image[int(front.project(np.array([0.0, -0.12, 0.12]))[1]), :, 3]
    scale = front.focal / (front.project(np.array([0.0, -0.12, 0.12]))[2])
    x = (np.arange(64) + 0.5 - 32.0) / scale
    # At share s the block covers [-0.07, 0.07] - 0.12 s: the share of time that x is covered.
    covered = np.clip((0.07 - x) / 0.12, 0, 1) - np.clip((-0.07 - x) / 0.12, 0, 1)
    # A pixel is 0.006 m, a twentieth of the way; noise of 64 paths adds 0.06 at worst.
    np.testing.assert_allclose(row, covered, atol=0.2)
    assert np.abs(row - covered).mean() < 0.02


def test_shots_with_environment_ground_and_motion_do_not_depend_on_each_other(
    blender: BlenderWorker, tmp_path: Path
) -> None:
    scene = EFFECTS["motion_blur"].scene
    own = write_scene(scene, tmp_path, blender)
    pixels, _ = sun(0.5, 0.6, 300.0)
    surrounding = environment_file(tmp_path / "sun.exr", pixels + 0.2)
    ground = Ground(height=0.0, center=(0.0, 0.0), radius=2.0)
    rig = replace(scene.rig, environment=surrounding, ground=ground)
    job = replace(scene_job(scene, own, tmp_path, size=32, samples=8), rig=rig)
    still = {"stage": np.eye(4), "subject": np.eye(4)}
    job = replace(
        job, states=(*job.states, still), exposures=(*job.exposures, (still,) * 5), denoise=True
    )
    shots = [
        replace(job.shots[0], file=f"{part}{state}.exr", part=part, state=state)
        for part in (None, "subject")
        for state in (0, 1)
    ]
    alone = {shot.file: rendered(blender, replace(job, shots=(shot,)))[0] for shot in shots}
    for order in (shots, shots[::-1]):
        rendered(blender, replace(job, shots=tuple(order)))
        for shot in shots:
            again = read_exr(tmp_path / shot.file)
            assert np.array_equal(again, alone[shot.file])
