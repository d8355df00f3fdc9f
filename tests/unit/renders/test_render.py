"""Cycles and the ray caster see the same object; equal jobs give equal pixels."""

import dataclasses
import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from artgen.core.jsonio import plain
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.dataset.sample import BACKGROUND
from artgen.export import Bundle
from artgen.imaging import display, read_exr
from artgen.render_job import RenderJob, Shot
from artgen.worker import BlenderWorker
from renders.collect import cast
from renders.plan import RenderPlan, plan_render
from renders.settings import Settings

pytestmark = pytest.mark.blender

SMALL = Settings(views=2, states=2, size=64, accuracy="8spp")
WHOLE = (0, 0, 64, 64)


def planned(bundle: Bundle, folder: Path, settings: Settings = SMALL) -> RenderPlan:
    folder.mkdir(exist_ok=True)
    return plan_render(bundle, Stream(11), settings=settings, folder=folder)


def shot(file: str, *, part: str | None, state: int = 0, samples: int = 8) -> Shot:
    return Shot(file=file, camera=0, state=state, part=part, box=WHOLE, samples=samples)


def rendered(blender: BlenderWorker, job: RenderJob) -> list[Floats]:
    blender.run(plain(job), timeout_s=120)
    return [read_exr(Path(job.folder) / one.file) for one in job.shots]


def with_shots(plan: RenderPlan, shots: Sequence[Shot], folder: Path) -> RenderJob:
    folder.mkdir(exist_ok=True)
    return dataclasses.replace(
        plan.job, shots=tuple(shots), denoise=False, folder=str(folder.resolve())
    )


@pytest.fixture(scope="module")
def plan(bundle: Bundle, tmp_path_factory: pytest.TempPathFactory) -> RenderPlan:
    return planned(bundle, tmp_path_factory.mktemp("plan"))


@pytest.fixture(scope="module")
def images(plan: RenderPlan, blender: BlenderWorker) -> list[Floats]:
    return rendered(blender, plan.job)


def test_the_job_survives_json(plan: RenderPlan) -> None:
    stated = plain(plan.job)
    assert plain(RenderJob.from_plain(json.loads(json.dumps(stated)))) == stated


def test_opaque_parts_cover_the_pixels_that_rays_hit(
    plan: RenderPlan, images: list[Floats]
) -> None:
    """Alpha is coverage within the pixel filter, the label is the center: they may differ on the
    outline alone, so wherever a label and its eight neighbors agree, alpha is 1 or 0."""
    labels = cast(plan)
    checked = 0
    for t, v in np.ndindex(2, 2):
        for p, part in enumerate(plan.bundle.parts):
            number = plan.passes.alone[t][v][p]
            if part.name == "lid" or number is None:
                continue
            left, top, right, bottom = plan.passes.shots[number].box
            alpha = images[number][..., 3]
            mask = labels.part_depth[t, v, p, top:bottom, left:right] > 0
            around = np.stack(
                [np.roll(mask, (i, j), axis=(0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)]
            )
            inner = (slice(1, -1), slice(1, -1))
            # The tip of a corner, or of a notch, may pass between pixel centers.
            assert np.count_nonzero(alpha[inner][around.all(axis=0)[inner]] < 0.999) <= 2
            assert np.count_nonzero(alpha[inner][~around.any(axis=0)[inner]]) <= 2
            checked += int(around.all(axis=0)[inner].sum())
    assert checked > 2000


def test_no_part_reaches_beyond_its_window(
    plan: RenderPlan, blender: BlenderWorker, tmp_path: Path
) -> None:
    parts = plan.bundle.parts
    shots = [shot(f"{p}.exr", part=part.name, samples=4) for p, part in enumerate(parts)]
    for p, image in enumerate(rendered(blender, with_shots(plan, shots, tmp_path))):
        left, top, right, bottom = plan.passes.boxes[0][0][p]
        outside = image.copy()
        outside[top:bottom, left:right] = 0
        assert image.any()
        assert not outside.any()


def test_a_blurred_part_stays_inside_its_window(
    bundle: Bundle, blender: BlenderWorker, tmp_path: Path
) -> None:
    """The window holds all that the part sweeps while the shutter is open, and no less is seen than
    the still part covers for a moment."""
    moving = Settings(
        views=1, states=2, size=64, accuracy="8spp", motion="trajectory", motion_blur=1.0
    )
    plan = planned(bundle, tmp_path / "plan", moving)
    door = [part.name for part in bundle.parts].index("door")
    assert plan.states[1]["door_hinge"] > 0.1
    blurred = with_shots(plan, [shot("a.exr", part="door", samples=16)], tmp_path / "a")
    still = dataclasses.replace(
        blurred,
        exposures=(),
        transport=dataclasses.replace(plan.job.transport, motion_blur=False),
        folder=str(tmp_path / "plan"),
    )
    (image,), (sharp,) = rendered(blender, blurred), rendered(blender, still)
    left, top, right, bottom = plan.passes.boxes[0][0][door]
    inside = image[top:bottom, left:right, 3].sum()
    assert image[..., 3].sum() == inside
    assert np.count_nonzero(image[..., 3]) > 1.2 * np.count_nonzero(sharp[..., 3])
    assert image[..., 3].min() >= 0.0


def test_a_window_shows_what_the_whole_image_shows_there(
    plan: RenderPlan, blender: BlenderWorker, tmp_path: Path
) -> None:
    box = plan.passes.boxes[0][0][1]
    window = dataclasses.replace(shot("window.exr", part="door"), box=box)
    job = with_shots(plan, [shot("whole.exr", part="door"), window], tmp_path)
    whole, cut = rendered(blender, job)
    left, top, right, bottom = box
    assert np.array_equal(whole[top:bottom, left:right], cut)


def test_part_ids_agree_with_the_nearest_alpha(plan: RenderPlan, images: list[Floats]) -> None:
    """In the composite, alpha is 1 where an opaque part is nearest, away from outlines."""
    labels = cast(plan)
    lid = [part.name for part in plan.bundle.parts].index("lid")
    steps = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    for t, v in np.ndindex(2, 2):
        alpha = images[plan.passes.composite[t][v]][..., 3]
        ids = labels.part_id[t, v]
        same = np.stack([np.roll(ids, step, axis=(0, 1)) == ids for step in steps])
        inside = same.all(axis=0) & (ids != BACKGROUND) & (ids != lid)
        assert np.count_nonzero(alpha[inside] < 0.999) <= 2


def test_equal_jobs_give_equal_pixels_in_any_order_and_process(
    plan: RenderPlan, blender: BlenderWorker, tmp_path: Path
) -> None:
    """Order of shots, threads, and what the process did before must not show."""
    shots = [
        shot("0.exr", part=None),
        shot("1.exr", part=None, state=1),
        shot("2.exr", part="door", state=1),
    ]
    first = rendered(blender, with_shots(plan, shots, tmp_path / "a"))
    again = rendered(blender, with_shots(plan, shots[::-1], tmp_path / "b"))[::-1]
    with BlenderWorker(tmp_path / "log", threads=2) as other:
        elsewhere = rendered(other, with_shots(plan, shots, tmp_path / "c"))
    for a, b, c in zip(first, again, elsewhere, strict=True):
        assert np.array_equal(a, b)
        assert np.array_equal(a, c)
    assert not np.array_equal(first[0], first[1])


def test_a_denoised_image_is_the_same_in_another_process(
    plan: RenderPlan, images: list[Floats], tmp_path: Path
) -> None:
    job = dataclasses.replace(plan.job, folder=str(tmp_path), shots=plan.job.shots[:3])
    with BlenderWorker(tmp_path / "log", threads=2) as other:
        for one, two in zip(images, rendered(other, job), strict=False):
            assert np.array_equal(one, two)


def test_the_only_part_alone_is_the_composite(
    plan: RenderPlan, blender: BlenderWorker, tmp_path: Path
) -> None:
    """With every other part far behind the camera's back, nothing can shade or hide the drawer; the
    lights that the others still mirror are none, as they are gone from the path too."""
    far = np.eye(4)
    far[2, 3] = -1e3
    poses = {part.name: far for part in plan.bundle.parts} | {"drawer": np.eye(4)}
    shots = [shot("all.exr", part=None, samples=64), shot("alone.exr", part="drawer", samples=64)]
    job = dataclasses.replace(with_shots(plan, shots, tmp_path), states=(poses, poses))
    together, alone = rendered(blender, job)
    assert np.array_equal(together[..., 3], alone[..., 3])
    # Hits at 1 km change which random numbers later bounces see, not what they average to.
    difference = np.abs(display(together).astype(int) - display(alone))
    assert difference.mean() < 0.5


def test_a_still_part_is_rendered_once_for_both_states(plan: RenderPlan) -> None:
    assert plan.passes.alone[0][0][0] == plan.passes.alone[1][0][0]
    moved = [p for p, part in enumerate(plan.bundle.parts) if part.name == "drawer"]
    assert plan.states[1]["slide"] > 0
    assert plan.passes.alone[0][0][moved[0]] != plan.passes.alone[1][0][moved[0]]


def test_a_plan_depends_on_its_stream_alone(bundle: Bundle, tmp_path: Path) -> None:
    one, two = planned(bundle, tmp_path), planned(bundle, tmp_path)
    other = plan_render(bundle, Stream(12), settings=SMALL, folder=tmp_path)
    assert plain(one.job) == plain(two.job)
    assert plain(one.job)["cameras"] != plain(other.job)["cameras"]
