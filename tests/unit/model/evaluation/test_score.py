"""Records: which metrics an object brings, and what failure costs."""

import json
from dataclasses import replace

import pytest

from artgen.core.jsonio import plain
from model.evaluation.gates import Gates
from model.evaluation.images import image_scores
from model.evaluation.metrics import METRICS
from model.evaluation.reshape import placed, taken
from model.evaluation.score import Protocol, aligned, failed, in_radii, score, unread
from model.evaluation.summary import summary
from tests.unit.model.evaluation.layouts import cabinet, with_box_meshes
from tests.unit.model.evaluation.test_images import ALL, GRAY

QUICK = Protocol(points=500, part_points=500, mask_pixels=24)
ASKED_ELSEWHERE = ("gates.", "images.lpips", "images.new_state.lpips")


def test_the_truth_scores_best_in_everything() -> None:
    truth = with_box_meshes(cabinet())
    own = [image_scores(GRAY, GRAY, ALL, ALL)]
    images = {"images": own, "images.new_state": own}
    record = score(truth, truth, QUICK, images=images)
    assert {
        n for n in METRICS if n not in record.metrics if not n.startswith(ASKED_ELSEWHERE)
    } == set()
    assert set(record.metrics) <= set(METRICS)
    for name, values in record.metrics.items():
        if (
            "giou" in name
            or "dcdist" in name
            or name.endswith(("_deg", "line", "lever", "state_share"))
        ):
            best = 1.0 if name.startswith("particulate") else 0.0
            # Counting of turned boxes loses 3 of 10,000; booleans 1e-9.
            assert values == pytest.approx([best] * len(values), abs=3e-4), name
    json.dumps(plain(record), allow_nan=False)


def test_scores_do_not_depend_on_the_unit() -> None:
    truth = with_box_meshes(cabinet())
    guess = with_box_meshes(cabinet(boxes=truth.boxes * (1.0, 1.0, 0.9)))
    one = score(guess, truth, QUICK)
    other = score(placed(guess, scale=100.0), placed(truth, scale=100.0), QUICK)
    for name in one.metrics:
        if not name.startswith("paris"):
            # Sums of some hundred roundings; none of the samples lies at a border of a triangle.
            assert other.metrics[name] == pytest.approx(one.metrics[name], rel=1e-6, abs=1e-6), name


def test_alignment_brings_place_and_scale() -> None:
    truth = cabinet()
    wrong = placed(truth, scale=3.0, shift=(1.0, 2.0, 3.0))
    assert aligned(wrong, truth, "uniform").boxes == pytest.approx(truth.boxes, abs=1e-14)
    centered = aligned(wrong, truth, "center")
    assert centered.bounds.mean(axis=0) == pytest.approx(truth.bounds.mean(axis=0), abs=1e-14)
    assert centered.radius == pytest.approx(3.0 * truth.radius, rel=1e-14)
    assert aligned(wrong, truth, "none") is wrong


def test_singapo_as_published_aligns_in_its_own_way() -> None:
    """Its stretch leaves ranges as they are, so a scale that was brought before would change them:
    a drawer of 0.5 of an object thrice as large."""
    truth = cabinet()
    large = placed(truth, scale=3.0)
    guess = replace(large, limits=truth.limits)
    by_align = [
        score(guess, truth, replace(QUICK, align=align, mask_pixels=0)).metrics
        for align in ("none", "center", "uniform")
    ]
    for name in ("rs_dgiou", "as_dgiou", "rs_dcdist", "as_dcdist"):
        key = f"singapo.published.{name}"
        assert by_align[0][key] == by_align[1][key] == by_align[2][key], name
    assert by_align[0]["singapo.honest.order.as_dcdist"][0] > 0.1


def test_radii_are_half_diagonals() -> None:
    _, true = in_radii(cabinet(), cabinet())
    assert true.radius == pytest.approx(1.0, abs=1e-15)
    assert true.bounds.mean(axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=1e-15)


def test_failure_is_the_worst_and_nothing_is_better() -> None:
    truth = cabinet()
    record = failed(truth, "it crashed")
    for shift in (50.0, 0.9 * truth.radius):
        poor = score(placed(taken(truth, [0]), shift=(shift, 0.0, 0.0)), truth, QUICK)
        for name, values in record.metrics.items():
            if "dcdist" in name and shift > truth.radius:
                continue  # Farther off than a part that is not there.
            sign = 1.0 if METRICS[name].better == "more" else -1.0
            for value in poor.metrics.get(name, ()):
                assert sign * value >= sign * values[0], name
    assert len(record.metrics["joints.nearest.type_right"]) == 2
    assert "surfaces.rest.chamfer_l1" not in record.metrics


def test_no_prediction_counts_as_one_whose_parts_are_all_without_a_counterpart() -> None:
    """Found: a failed object was left out of the mean of dcDist, while each part that a prediction
    lacked cost one radius: who predicted nothing at all was better off. Of P parts the base alone
    is predicted right here: (P - 1) / P of what failure costs is left."""
    truth = cabinet()
    worst, found = (
        failed(truth, "it crashed").metrics,
        score(taken(truth, [0]), truth, QUICK).metrics,
    )
    for matching in ("order", "nearest"):
        for name in ("rs_dgiou", "as_dgiou", "rs_dcdist", "as_dcdist"):
            key = f"singapo.honest.{matching}.{name}"
            # Exact booleans of boxes lose 1e-9.
            assert found[key] == pytest.approx([worst[key][0] * 2.0 / 3.0], abs=1e-8), key


def test_without_handles_all_published_metrics_are_without_them() -> None:
    """The door as a handle far off its place: it counts, or it does not."""
    truth = with_box_meshes(cabinet(labels=("base", "drawer", "handle")))
    boxes = truth.boxes.copy()
    boxes[2] = boxes[1]
    guess = with_box_meshes(cabinet(labels=truth.labels, boxes=boxes))
    without, with_them = (
        score(guess, truth, replace(QUICK, handles=handles)).metrics for handles in (False, True)
    )
    for name in ("rs_dgiou", "rs_dcdist"):
        key = f"singapo.published.{name}"
        assert without[key] == pytest.approx([0.0], abs=1e-12), name
        assert with_them[key][0] > 0.05, name
    assert with_them["singapo.published.aor"][0] > 0.05
    assert "singapo.published.aor" not in without  # A drawer alone has no sibling.
    # Samples of the two parts that are left, as in test_singapo_surfaces, in radii squared.
    assert without["singapo.published.rs_dcd"][0] < 5e-3 < with_them["singapo.published.rs_dcd"][0]


def test_what_is_asked_of_no_object_costs_none_anything() -> None:
    record = failed(cabinet(), "it crashed", idle=("gates.", "images."))
    assert not any(name.startswith(("gates.", "images.")) for name in record.metrics)
    assert record.metrics["masks.order.composite"] == [0.0]


def test_an_object_without_a_truth_counts_nowhere() -> None:
    truth = cabinet()
    found = summary([score(truth, truth, QUICK), unread("other", "no mesh")])
    assert found.objects == 2
    assert found.failures == {"other": "the true object is damaged: no mesh"}
    assert all(own.objects <= 1 for own in found.overall.values())
    assert set(found.by_parts) == {"03"}


def test_a_summary_counts_failures_and_groups() -> None:
    truth = with_box_meshes(cabinet())
    records = [score(truth, truth, QUICK), failed(cabinet("other", category="oven"), "it crashed")]
    found = summary(records)
    assert found.failures == {"other": "it crashed"}
    assert found.overall["singapo.honest.order.rs_dgiou"].mean == 1.0
    assert found.overall["surfaces.rest.chamfer_l1"].objects == 1
    assert found.overall["images.lpips"].mean is None
    assert set(found.by_category) == {"cabinet", "oven"}
    assert set(found.by_parts) == {"03"}
    assert found.gaps["singapo.honest.rs_dgiou"] == 0.0


def test_confused_slots_make_a_gap() -> None:
    truth = cabinet()
    swapped = taken(truth, [0, 2, 1])
    found = summary([score(swapped, truth, QUICK)])
    assert found.gaps["singapo.honest.rs_dgiou"] > 0.5
    assert found.gaps["joints.type_right"] == -1.0


def test_joints_that_an_object_kept_are_counted() -> None:
    """Of two joints one; none is a gate that is not passed, and more are no merit."""
    truth = cabinet()
    held = Gates(loads=True, stable=True, settles=True, opens=True, clear=True, reasons={})
    found = {
        left: score(truth, truth, QUICK, gates=replace(held, joints=left)).metrics
        for left in (0, 1, 3)
    }
    assert [found[left]["gates.kept"] for left in (0, 1, 3)] == [[0.0], [0.5], [1.0]]
    assert [found[left]["gates.passed"] for left in (0, 1, 3)] == [[0.0], [1.0], [1.0]]
