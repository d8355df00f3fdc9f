"""Errors of known images, presets of made-up rows, the shipped table, kept pictures."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import WorkerError
from artgen.export import Bundle
from artgen.render_job import Shot
from artgen.studies.table import read_table, write_table
from artgen.worker import BlenderWorker
from renders.accuracy import SHIPPED, Measured
from renders.study.measures import decibels, pooled_error, shown, without_noise
from renders.study.page import page
from renders.study.pictures import PLAIN, SEED, rendered, target
from renders.study.rows import Row, rows, truth
from renders.study.settings import Setting, study_series
from renders.study.shipped import LEVELS, PRESET_SIZE, presets, shipped_rows, worst_of_scenes

DOCS = Path(__file__).parents[4] / "docs/studies"
WHOLE = Shot(file="a.exr", camera=0, state=0, part=None, box=(0, 0, 8, 8), samples=1)
PART = replace(WHOLE, part="lid", box=(2, 0, 6, 4))


def gray(value: float, side: int, alpha: float = 1.0) -> np.ndarray:
    image = np.zeros((side, side, 4), np.float32)
    image[..., :3], image[..., 3] = value * alpha, alpha
    return image


def test_the_error_of_a_step_is_its_square() -> None:
    """Black against white, all covered: squared error 1, 0 dB. Code 0 is sRGB 0 exactly."""
    off = pooled_error([gray(0.0, 8)], [gray(1e9, 8)], [WHOLE], 8)
    assert off.square == off.foreground == 1.0
    assert decibels(off.square) == 0.0
    assert off.flip > 0.5


def test_a_part_counts_in_the_whole_image_and_alone_in_its_foreground() -> None:
    off = pooled_error([gray(0.0, 4)], [gray(1e9, 4)], [PART], 8)
    assert off.square == 16 / 64
    assert off.foreground == 1.0


def test_what_shows_nothing_is_white_paper() -> None:
    assert (shown(gray(0.0, 4, alpha=0.0), PART, 8) == 1.0).all()


def test_equal_images_have_no_error() -> None:
    off = pooled_error([gray(0.3, 8)], [gray(0.3, 8)], [WHOLE], 8)
    assert (off.square, off.flip) == (0.0, 0.0)
    assert decibels(off.square) == math.inf


def test_noise_of_the_reference_is_taken_off_but_never_undercut() -> None:
    assert without_noise(0.3, 0.1) == pytest.approx(0.2, rel=1e-15)
    assert without_noise(0.11, 0.1) == 0.1


def made_up(samples: int, psnr: float, cpu: float, scene: str = "a") -> Row:
    return Row(
        scene=scene, kind="composite", size_px=PRESET_SIZE, samples=samples, denoise=True,
        prefilter="fast", denoise_quality="high", adaptive=0.0, bounces=None, psnr_db=psnr,
        foreground_psnr_db=psnr, flip=0.1, cpu_s=cpu, wall_s=cpu, reference_psnr_db=60.0,
    )  # fmt: skip


def test_a_preset_is_the_cheapest_that_the_worst_scene_lets_pass() -> None:
    levels = list(LEVELS.values())
    found = [made_up(k, db + 1.0, float(k)) for k, db in enumerate(levels, start=1)]
    found += [made_up(k, db, float(k), "b") for k, db in enumerate(levels, start=1)]
    found += [made_up(9, levels[-1] + 5.0, 9.0, scene) for scene in ("a", "b")]
    named = presets(worst_of_scenes(found)["composite", PRESET_SIZE])
    assert {name: one.samples for name, one in named.items()} == {
        **{name: k for k, name in enumerate(LEVELS, start=1)},
        "reference": 9,
    }


def test_the_shipped_table_and_the_page_follow_from_the_published_rows(tmp_path: Path) -> None:
    published = read_table(DOCS / "render.csv", Row)
    shipped = shipped_rows(published)
    write_table(tmp_path / "again.csv", shipped)
    assert SHIPPED.read_bytes() == (tmp_path / "again.csv").read_bytes()
    assert (DOCS / "render.md").read_text(encoding="utf-8") == page(
        published, read_table(SHIPPED, Measured)
    )


def test_series_differ_in_samples_alone() -> None:
    for series in study_series(128):
        assert len({replace(setting, samples=1) for setting in series}) == 1


@pytest.mark.blender
def test_pictures_are_rendered_once(bundle: Bundle, blender: BlenderWorker, tmp_path: Path) -> None:
    seen = target("chest", bundle, size=24, folder=tmp_path)
    assert [shot.part for shot in seen.shots[:3]] == [None, None, "base"]
    series = (Setting(samples=1), Setting(samples=4))
    kept = tmp_path / "kept"
    first = rendered(seen, series, seed=SEED, worker=blender, kept=kept)

    class Refuses(BlenderWorker):
        def run(self, job: object, *, timeout_s: float) -> dict[str, object]:
            raise WorkerError("nothing is left to render")

    with Refuses(tmp_path / "log") as nobody:
        again = rendered(seen, series, seed=SEED, worker=nobody, kept=kept)
        with pytest.raises(WorkerError, match="nothing is left"):
            rendered(seen, series, seed=SEED + 1, worker=nobody, kept=kept)
    for setting in series:
        for one, two in zip(first[setting].images, again[setting].images, strict=True):
            np.testing.assert_allclose(one, two, rtol=2**-10, atol=1e-6)  # kept as float16
    raw = replace(PLAIN, samples=16)
    halves = [rendered(seen, [raw], seed=SEED + k, worker=blender, kept=kept)[raw] for k in (1, 2)]
    one, four = (rows(seen, setting, again[setting], truth(seen, halves))[0] for setting in series)
    assert one.psnr_db < four.psnr_db
    assert one.cpu_s > 0.0
