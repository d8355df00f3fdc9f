"""The fast backend as a whole: repeatable, complete, near Cycles, and clear about what it lacks."""

import hashlib
import subprocess
import sys
from pathlib import Path

import moderngl
import numpy as np
import pytest

from artgen.core.errors import RenderError, UsageError
from artgen.core.stream import Stream
from artgen.dataset import open_shard
from artgen.dataset.image_checks import check_images
from artgen.export import Bundle
from artgen.worker import BlenderWorker
from renders.asset import render_asset
from renders.backends import CyclesBackend
from renders.fast.backend import SHADING, FastBackend
from renders.fast.context import open_context
from renders.fast.study import compared, difference, measured
from renders.glb import read_appearance
from renders.plan import RenderPlan, plan_render
from renders.settings import Settings, checked

SETTINGS = Settings(views=2, states=2, size=64, backend="fast", extras=("albedo", "flow", "linear"))

HASH_IN_A_PROCESS = """
import hashlib, sys
from pathlib import Path
from artgen.core.stream import Stream
from artgen.export import read_bundle
from renders.fast.backend import FastBackend
from renders.plan import plan_render
from renders.settings import Settings
plan = plan_render(read_bundle(Path(sys.argv[1])), Stream(5), settings=Settings(views=2, size=64),
    folder=Path(sys.argv[1]))
images = FastBackend(threads=int(sys.argv[2])).pictures(plan, Path()).images
print(hashlib.sha256(b"".join(image.tobytes() for image in images)).hexdigest())
assert "bpy" not in sys.modules
"""


def planned(bundle: Bundle, folder: Path, settings: Settings) -> RenderPlan:
    return plan_render(bundle, Stream(5), settings=settings, folder=folder)


@pytest.mark.blender
def test_pixels_depend_on_the_plan_alone(bundle: Bundle, tmp_path: Path) -> None:
    """Not on threads, processes, or what the context drew before."""
    plan = planned(bundle, tmp_path, Settings(views=2, size=64))
    backend = FastBackend(threads=1)
    backend.pictures(planned(bundle, tmp_path, Settings(views=1, size=48)), tmp_path)
    first, again = (
        hashlib.sha256(b"".join(i.tobytes() for i in backend.pictures(plan, tmp_path).images))
        for _ in range(2)
    )
    assert first.hexdigest() == again.hexdigest()
    for threads in ("1", "2"):
        run = subprocess.run(
            [sys.executable, "-c", HASH_IN_A_PROCESS, str(bundle.folder), threads],
            capture_output=True,
            text=True,
            check=True,
        )
        assert run.stdout.strip() == first.hexdigest()


@pytest.mark.blender
def test_a_sample_is_complete_and_says_what_shaded_it(bundle: Bundle, tmp_path: Path) -> None:
    tars = [tmp_path / name for name in ("a.tar", "b.tar")]
    for tar in tars:
        render_asset(
            bundle, tar, settings=SETTINGS, seed=4, scratch=tmp_path / "work", backend=FastBackend()
        )
    assert tars[0].read_bytes() == tars[1].read_bytes()
    sample = open_shard(tars[0]).read("chest_000001")
    check_images(sample)
    assert sample.meta.shading == SHADING
    assert sample.albedo is not None
    assert sample.roughness is None
    assert sample.flow is not None
    assert sample.linear is not None
    assert sample.rgba[..., 3].any(axis=(2, 3)).all()
    door = [part.name for part in sample.meta.parts].index("door")
    inside = sample.part_id == door
    assert np.median(sample.rgba[..., 3][inside]) == 255


@pytest.mark.blender
def test_pictures_are_near_those_of_cycles(
    bundle: Bundle, blender: BlenderWorker, tmp_path: Path
) -> None:
    """An open chest with a glass lid: 26 dB and 8 codes where it was written; a light that is
    missing or doubled is off by 30 codes or more. Of a window 6 px wide half is outline, where 8
    paths tell coverage to 0.1; what is shifted by a pixel is off by 0.2."""
    plan = planned(bundle, tmp_path, Settings(views=2, states=2, size=64))
    cycles = measured(CyclesBackend(blender), plan, tmp_path)
    fast = measured(FastBackend(), plan, tmp_path)
    whole, alone = compared(plan, cycles, fast, labels_cpu_s=0.0)
    assert whole.psnr_db > 25.0
    assert abs(whole.bias) < 10.0
    assert alone.psnr_db > 30.0
    for k, shot in enumerate(plan.passes.shots):
        if shot.part != "lid":
            cover = np.abs(cycles.images[k][..., 3] - fast.images[k][..., 3])
            assert cover.mean() < 0.05
    assert not difference(fast.images[0], fast.images[0]).any()


def test_a_machine_without_egl_is_told_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(**_: object) -> None:
        raise RuntimeError("libEGL.so.1: cannot open shared object file")

    monkeypatch.setattr(moderngl, "create_context", fails)
    with pytest.raises(UsageError, match=r"apt-get install -y libegl1 libgl1-mesa-dri.*libEGL"):
        open_context(threads=1)


@pytest.mark.blender
def test_a_glb_shows_the_triangles_of_the_meshes(bundle: Bundle) -> None:
    """Positions pass through float32: 6e-8 of 0.4 m."""
    appearance = read_appearance(bundle.folder / "asset.glb")
    for part in bundle.parts:
        own = [skin for skin in appearance.skins if skin.part == part.name]
        corners = np.concatenate([skin.vertices[skin.faces].reshape(-1, 3) for skin in own])
        mesh = bundle.load_mesh(part.name)
        assert sum(len(skin.faces) for skin in own) == len(mesh.faces)
        ours = mesh.triangles.reshape(-1, 3)
        for axis in range(3):
            a, b = np.sort(corners[:, axis]), np.sort(ours[:, axis])
            np.testing.assert_allclose(a, b, rtol=0, atol=1e-7)
        assert {skin.surface for skin in own} == set(part.surfaces)


@pytest.mark.blender
@pytest.mark.parametrize("keep", [0, 11, 200, -1])
def test_a_damaged_glb_is_told(bundle: Bundle, tmp_path: Path, keep: int) -> None:
    whole = (bundle.folder / "asset.glb").read_bytes()
    path = tmp_path / "cut.glb"
    path.write_bytes(whole[:keep])
    with pytest.raises(RenderError, match=r"cut\.glb cannot be read.*generate the asset anew"):
        read_appearance(path)


@pytest.mark.parametrize(
    ("option", "settings"),
    [
        ("ground", Settings(backend="fast", ground=True)),
        ("motion-blur", Settings(backend="fast", motion="trajectory", states=4, motion_blur=0.5)),
    ],
)
def test_what_the_fast_backend_leaves_out_is_refused(option: str, settings: Settings) -> None:
    with pytest.raises(UsageError, match=f"--{option} .*--backend cycles"):
        checked(settings)
