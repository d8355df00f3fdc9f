"""Rigs are as bright as they say, and the seed alone sets them up."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from artgen.core.camera import framed, orbit_direction
from artgen.core.jsonio import plain
from artgen.core.stream import Stream
from artgen.export import Bundle
from artgen.imaging import read_exr
from artgen.render_job import LightRig, RenderJob, Shot, Sky, Transport
from artgen.studio import Softbox, portrait_rig, softbox_light
from artgen.worker import BlenderWorker
from renders.lights import studio_rig

DARK = Sky(nadir=(0.0,) * 3, horizon=(0.0,) * 3, zenith=(0.0,) * 3)
DIRECT = Transport(diffuse=0, glossy=0, transmission=0, transparent=8, clamp_indirect=0, panes=())


def test_the_seed_alone_sets_up_the_rig() -> None:
    rig = studio_rig(Stream(3, "lights"), center=np.zeros(3), radius=0.5)
    assert rig == studio_rig(Stream(3, "lights"), center=np.zeros(3), radius=0.5)
    assert rig != studio_rig(Stream(4, "lights"), center=np.zeros(3), radius=0.5)


@pytest.mark.parametrize("radius", [0.2, 1.5])
def test_brightness_does_not_depend_on_the_size_of_the_object(radius: float) -> None:
    small = portrait_rig(center=np.zeros(3), radius=1.0)
    large = portrait_rig(center=np.zeros(3), radius=radius)
    for one, two in zip(small.lights, large.lights, strict=True):
        assert one.radiance == two.radiance
        np.testing.assert_allclose(np.multiply(one.position, radius), two.position, atol=1e-12)


@pytest.mark.blender
def test_a_wall_that_faces_a_softbox_is_as_bright_as_stated(
    bundle: Bundle, blender: BlenderWorker, tmp_path: Path
) -> None:
    """The drawer's white front (albedo 0.8 and a coat that mirrors 4 %) faces the light head on.

    The stated law is that of a small source: one of side 1 at distance 6 shines 2 % less at the
    middle, and light at an angle to the coat adds as much; 6 % covers both and the noise of 64
    paths over 64 px (1 %).
    """
    front = np.array([0.0, -0.135, 0.08])
    light = softbox_light(
        Softbox(azimuth=0.0, elevation=0.0, distance=6.0, side=1.0, white=0.5),
        center=front,
        radius=1.0,
    )
    camera = framed(
        front + np.array([[-0.1, 0, -0.02], [0.1, 0, 0.02]]),
        direction=orbit_direction(math.radians(30), 0.0),
        fov=0.3,
        size=(32, 32),
        fill=1.0,
    )
    job = RenderJob(
        glb=str(bundle.folder / "asset.glb"),
        folder=str(tmp_path),
        cameras=(camera.stated,),
        states=({part.name: np.eye(4) for part in bundle.parts},),
        rig=LightRig(name="one", lights=(light,), sky=DARK),
        transport=DIRECT,
        shots=(
            Shot(file="a.exr", camera=0, state=0, part="drawer", box=(8, 14, 24, 18), samples=64),
        ),
        seed=1,
        denoise=False,
    )
    blender.run(plain(job), timeout_s=60)
    shown = read_exr(tmp_path / "a.exr")[..., :3].mean()
    assert shown == pytest.approx(0.8 * 0.5, rel=0.06)
    twice = dataclasses.replace(light, radiance=tuple(2 * v for v in light.radiance))
    brighter = dataclasses.replace(job, rig=LightRig(name="two", lights=(twice,), sky=DARK))
    blender.run(plain(brighter), timeout_s=60)
    # Same paths, twice the light: half floats keep 11 bits.
    assert read_exr(tmp_path / "a.exr")[..., :3].mean() == pytest.approx(2 * shown, rel=1e-3)
