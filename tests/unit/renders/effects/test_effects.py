"""What a scene does not call for changes no bit when it is on; what it calls for is missed when it
is off."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from artgen.core.camera import framed, orbit_direction
from artgen.core.surface import SurfaceSpec
from artgen.worker import BlenderWorker
from renders.effects.scenes import EFFECTS, PLAIN, Scene, scene_job, write_scene
from renders.effects.study import difference, idle_jobs, rendered

pytestmark = pytest.mark.blender

SIZE, SAMPLES = 48, 64
IMAGES = [name for name in EFFECTS if name != "light_tree"]
"""A light tree decides how lamps are chosen, so it changes noise and no expectation."""


@pytest.fixture(scope="module")
def calm(blender: BlenderWorker, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_scene(PLAIN, tmp_path_factory.mktemp("plain"), blender)


@pytest.mark.parametrize("name", IMAGES)
def test_an_effect_that_a_scene_does_not_call_for_changes_no_bit(
    name: str, calm: Path, blender: BlenderWorker, tmp_path: Path
) -> None:
    without, with_it = idle_jobs(EFFECTS[name], calm, tmp_path, size=SIZE, samples=8)
    one, _ = rendered(blender, without)
    two, _ = rendered(blender, with_it)
    assert one[..., 3].max() == 1
    assert np.array_equal(one, two)


@pytest.mark.parametrize("name", IMAGES)
def test_an_effect_that_a_scene_calls_for_is_missed(
    name: str, blender: BlenderWorker, tmp_path: Path
) -> None:
    """Over two codes, root mean square over the whole image of means over 4 x 4 px, and twice what
    another seed changes."""
    effect = EFFECTS[name]
    glb = write_scene(effect.scene, tmp_path, blender)
    job = scene_job(effect.scene, glb, tmp_path, size=SIZE, samples=SAMPLES)
    on, _ = rendered(blender, job)
    again, _ = rendered(blender, replace(job, seed=1))
    off, _ = rendered(blender, replace(job, transport=effect.without))
    assert difference(on, off) > max(2.0, 2.0 * difference(on, again))


def test_a_light_tree_lowers_the_noise_of_many_lamps(
    blender: BlenderWorker, tmp_path: Path
) -> None:
    """By a fourth at least, against sixteen times the paths; measured were 0.7."""
    effect = EFFECTS["light_tree"]
    glb = write_scene(effect.scene, tmp_path, blender)
    job = scene_job(effect.scene, glb, tmp_path, size=SIZE, samples=SAMPLES)
    on, _ = rendered(blender, job)
    off, _ = rendered(blender, replace(job, transport=effect.without))
    shot = replace(job.shots[0], samples=16 * SAMPLES)
    truth, _ = rendered(blender, replace(job, seed=1, shots=(shot,)))
    assert difference(on, truth, 1) < 0.75 * difference(off, truth, 1)


@pytest.mark.parametrize("name", EFFECTS)
def test_every_scene_calls_for_its_effect_and_says_why(name: str) -> None:
    scene = EFFECTS[name].scene
    told = scene.transport.described()[name]
    assert told["on"]
    assert len(str(told["why"])) > 5
    assert not EFFECTS[name].without.described()[name]["on"] or name == "glossy"
    calm = PLAIN.transport.described()
    assert set(calm) == set(EFFECTS)
    assert not calm[name]["on"] or name == "glossy"  # Coats mirror once in any scene.


def test_an_absorbing_body_lets_through_what_beer_and_fresnel_leave(
    blender: BlenderWorker, tmp_path: Path
) -> None:
    """Head on, two faces of index 1.5 let through 0.96 each, and half of the light is left after
    the 0.14 m of the block: alpha is the rest. Light mirrored twice inside adds 0.0004; noise of
    256 paths over 9 px is 1 %."""
    gray = SurfaceSpec(
        name="subject",
        recipe="plain",
        color=(0.5, 0.5, 0.5),
        transmission=1.0,
        roughness=0.0,
        attenuation=0.14,
    )
    scene = Scene(subject=EFFECTS["volume"].scene.subject, surface=gray)
    job = scene_job(scene, write_scene(scene, tmp_path, blender), tmp_path, size=16, samples=256)
    front = framed(
        np.array([[-0.03, -0.12, 0.1], [0.03, 0.02, 0.14]]),
        direction=orbit_direction(0.0, 0.0),
        fov=0.05,
        size=(16, 16),
        fill=0.9,
    )
    shot = replace(job.shots[0], part="subject")
    image, _ = rendered(blender, replace(job, cameras=(front.stated,), shots=(shot,)))
    through = 0.96**2 * 0.5
    assert image[7:10, 7:10, 3].mean() == pytest.approx(1.0 - through, abs=0.03)
