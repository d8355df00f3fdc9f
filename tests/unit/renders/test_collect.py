"""From bundle to staged sample: complete, consistent, the same every time; bad input is told."""

from pathlib import Path

import pytest

from artgen.core.errors import RenderError
from artgen.core.jsonio import plain
from artgen.core.stream import Stream
from artgen.dataset import open_shard
from artgen.dataset.image_checks import check_images
from artgen.export import Bundle
from artgen.worker import BlenderWorker
from renders.asset import render_asset
from renders.backends import CyclesBackend, ExrImages
from renders.collect import collected
from renders.contact_sheet import write_contact_sheet
from renders.plan import plan_render
from renders.settings import Settings

SETTINGS = Settings(views=2, states=2, size=32, accuracy="2spp")


@pytest.fixture(scope="module")
def sample_path(
    bundle: Bundle, blender: BlenderWorker, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    folder = tmp_path_factory.mktemp("staged")
    path = folder / "samples" / "chest" / "000001.tar"
    account = render_asset(
        bundle,
        path,
        settings=SETTINGS,
        seed=4,
        scratch=folder / "work",
        backend=CyclesBackend(blender),
    )
    assert set(account.seconds) == {"plan", "render", "collect"}
    assert set(account.cpu) == {"import", "composite", "alone"}
    assert account.composites == 4
    assert account.effects["thin_glass"]["on"]
    assert not account.effects["motion_blur"]["on"]
    assert not any((folder / "work").iterdir())
    return path


@pytest.mark.blender
def test_the_sample_says_what_the_bundle_says(bundle: Bundle, sample_path: Path) -> None:
    sample = open_shard(sample_path).read("chest_000001")
    check_images(sample)
    assert sample.shape == (2, 2, 4, 32, 32)
    assert [part.name for part in sample.meta.parts] == [part.name for part in bundle.parts]
    assert sample.meta.joints == bundle.joints
    assert sample.meta.rendering["settings"] == plain(SETTINGS)
    assert sample.meta.rendering["quality"]["samples"] == 2
    assert sample.meta.rendering["transport"]["thin_glass"]["on"]
    assert not sample.q[0].any()
    assert (sample.meta.seed, sample.meta.index) == (3, 1)
    assert sample.rgba[..., 3].any(axis=(2, 3)).all()
    assert sample.part_mask.any(axis=(0, 1, 3, 4)).all()


@pytest.mark.blender
def test_a_part_in_front_of_all_others_looks_the_same_alone(sample_path: Path) -> None:
    """Where the door is nearest and opaque, its own image has the same alpha as the composite."""
    sample = open_shard(sample_path).read("chest_000001")
    names = [part.name for part in sample.meta.parts]
    door = names.index("door")
    shown = sample.part_id == door
    own = sample.part_rgba[:, :, door, ..., 3]
    full = shown & (own == 255)
    assert full.sum() > 20
    assert (sample.rgba[..., 3][full] == 255).mean() > 0.98


@pytest.mark.blender
def test_rendering_again_in_another_process_gives_the_same_bytes(
    bundle: Bundle, sample_path: Path, tmp_path: Path
) -> None:
    with BlenderWorker(tmp_path / "log", threads=2) as other:
        render_asset(
            bundle,
            tmp_path / "again.tar",
            settings=SETTINGS,
            seed=4,
            scratch=tmp_path / "work",
            backend=CyclesBackend(other),
        )
    assert (tmp_path / "again.tar").read_bytes() == sample_path.read_bytes()


@pytest.mark.blender
def test_the_contact_sheet_repeats(sample_path: Path, tmp_path: Path) -> None:
    for name in ("a.png", "b.png"):
        write_contact_sheet(tmp_path / name, [sample_path] * 5)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


@pytest.mark.blender
def test_a_missing_image_is_told(bundle: Bundle, tmp_path: Path) -> None:
    plan = plan_render(bundle, Stream(1), settings=SETTINGS, folder=tmp_path)
    with pytest.raises(RenderError, match=r"000000\.exr cannot be read"):
        collected(plan, ExrImages(plan, tmp_path), shading="cycles")
