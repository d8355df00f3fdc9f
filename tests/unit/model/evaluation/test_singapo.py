"""SINGAPO's metrics against closed forms, and against counting with another code."""

import math

import numpy as np
import pytest

from artgen.core.stream import Stream
from model.evaluation.matching import by_nearness, by_order
from model.evaluation.reshape import placed, stretched, taken
from model.evaluation.singapo import (
    STATES,
    compared_as_published,
    honest,
    overlap_ratio,
    overlap_ratio_published,
    published,
    published_poses,
)
from tests.unit.model.evaluation.layouts import DRAWER, cabinet

SHARES = np.linspace(0.0, 1.0, STATES)


def test_the_truth_is_perfect() -> None:
    truth = cabinet()
    for found in (published(truth, truth), honest(truth, truth, by_order(3, 3))):
        assert found.rs_dgiou == 0.0
        assert found.rs_dcdist == found.as_dcdist == 0.0
        # Points on a face may fall outside after a turn and its inverse: 3 of 10,000 at most.
        assert found.as_dgiou == pytest.approx(0.0, abs=3e-4)


def test_published_is_blind_to_stretch_and_place_and_honest_is_not() -> None:
    truth = cabinet()
    wrong = stretched(placed(truth, shift=(0.3, 0.2, 0.1)), (2.0, 1.0, 0.5))
    assert published(wrong, truth).rs_dgiou == pytest.approx(0.0, abs=1e-14)  # Roundings of sides.
    assert honest(wrong, truth, by_order(3, 3)).rs_dgiou > 0.5


def test_published_does_not_see_the_range_of_a_hinge_and_honest_does() -> None:
    truth = cabinet()
    half = cabinet(limits=np.array([(0.0, 0.0), (0.0, 0.5), (0.0, 0.4)]))
    assert published(half, truth).as_dcdist == pytest.approx(0.0, abs=1e-12)
    found = honest(half, truth, by_order(3, 3)).as_dcdist
    # The door's center at (0.5, -0.05) from its axis is carried along a chord of 2 a sin(d / 2).
    arm = math.hypot(0.5, 0.05)
    chords = [2.0 * arm * math.sin(share * (1.5 - 0.4) / 2.0) for share in SHARES]
    assert found == pytest.approx(np.mean(chords) / 3.0, abs=1e-14)


def test_a_drawer_that_comes_out_half_as_far_in_closed_form() -> None:
    """Overlap of two boxes of depth d shifted by s (r - r'); C around both, honest variant."""
    truth = cabinet()
    half = cabinet(limits=np.array([(0.0, 0.0), (0.0, 0.25), (0.0, 1.5)]))
    depth = DRAWER[1][1] - DRAWER[0][1]
    shifts = 0.25 * SHARES
    gious = (depth - shifts) / (depth + shifts)  # C is filled, as both boxes lie in one line.
    found = honest(half, truth, by_order(3, 3))
    assert found.as_dgiou == pytest.approx(np.mean(1.0 - gious) / 3.0, abs=1e-9)
    assert found.as_dcdist == pytest.approx(np.mean(shifts) / 3.0, abs=1e-15)


def test_published_keeps_the_enclosing_box_of_rest() -> None:
    """The same drawer: C stays the box at rest, so that the union may be larger than C."""
    truth = cabinet()
    half = cabinet(limits=np.array([(0.0, 0.0), (0.0, 0.25), (0.0, 1.5)]))
    depth = DRAWER[1][1] - DRAWER[0][1]
    shifts = 0.25 * SHARES
    iou = (depth - shifts) / (depth + shifts)
    gious = iou - (depth - (depth + shifts)) / depth
    # Each of two directions counts 10,000 points in two boxes: p (1 - p) / N under 0.2^2 / N; four
    # deviations of the IoU at each of five states, over three parts.
    bound = 6.0 * 2.0 * 0.5 / math.sqrt(40_000.0) / 3.0
    assert published(half, truth).as_dgiou == pytest.approx(np.mean(1.0 - gious) / 3.0, abs=bound)


def test_published_against_a_second_implementation() -> None:
    """An independent code: boxes as lists of corners, homogeneous points, its own counting."""
    truth = cabinet(limits=np.array([(0.0, 0.0), (0.0, 0.4), (0.0, 2.0)]))
    rng = Stream(3, "test").generator()
    guess = cabinet(
        boxes=truth.boxes + 0.03 * rng.standard_normal((3, 2, 3)),
        origins=truth.origins + np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.05, 0.02, 0.0)]),
    )
    found = published(guess, truth)
    expected = _second_implementation(guess, truth)
    # Three parts, each IoU with a deviation below 0.5 / sqrt(20,000) twice; six of them over three.
    assert found.as_dgiou == pytest.approx(expected["giou"], abs=6.0 * 0.5 / math.sqrt(20_000.0))
    assert found.as_dcdist == pytest.approx(expected["distance"], abs=1e-12)
    assert found.rs_dgiou == pytest.approx(expected["rest"], abs=1e-12)


def _second_implementation(guess: object, truth: object) -> dict[str, float]:
    rows = []
    for own in (guess, truth):
        boxes = np.array(own.boxes)  # type: ignore[attr-defined]
        middle = (boxes[:, 0].min(0) + boxes[:, 1].max(0)) / 2
        rows.append([boxes - middle, np.array(own.origins) - middle, own])  # type: ignore[attr-defined]
    sizes = [r[0][:, 1].max(0) - r[0][:, 0].min(0) for r in rows]
    rows[0][0], rows[0][1] = rows[0][0] * (sizes[1] / sizes[0]), rows[0][1] * (sizes[1] / sizes[0])

    def moved(row: list, part: int, share: float, points: np.ndarray, back: bool) -> np.ndarray:  # type: ignore[type-arg]
        kind, axis = row[2].types[part], row[2].axes[part]
        if kind == 0:
            return points
        if kind == 2:
            return points + (-1 if back else 1) * axis * row[2].limits[part, 1] * share
        angle = math.radians(90.0) * share * (-1 if back else 1)
        local = points - row[1][part]
        along = np.outer(local @ axis, axis)
        across = np.cross(axis, local)
        turned = along + (local - along) * math.cos(angle) + across * math.sin(angle)
        return turned + row[1][part]

    rng = np.random.Generator(np.random.PCG64(5))
    giou, distance, rest = [], [], []
    for share in SHARES:
        for part in range(3):
            (a, b), (c, d) = rows[0][0][part], rows[1][0][part]
            va, vb = np.prod(b - a), np.prod(d - c)
            around = np.prod(np.maximum(b, d) - np.minimum(a, c))
            mine = moved(rows[0], part, share, a + rng.random((20_000, 3)) * (b - a), False)
            theirs = moved(rows[1], part, share, c + rng.random((20_000, 3)) * (d - c), False)
            mine, theirs = (
                moved(rows[1], part, share, mine, True),
                moved(rows[0], part, share, theirs, True),
            )
            hits = ((mine > c) & (mine < d)).all(1).mean() * va + ((theirs > a) & (theirs < b)).all(
                1
            ).mean() * vb
            shared = hits / 2
            if share == 0:
                shared = np.prod(np.clip(np.minimum(b, d) - np.maximum(a, c), 0, None))
            union = va + vb - shared
            giou.append(shared / union - (around - union) / around)
            ends = [
                moved(rows[k], part, share, rows[k][0][part].mean(0)[None], False) for k in (0, 1)
            ]
            distance.append(np.linalg.norm(ends[0] - ends[1]))
            rest += [giou[-1]] if share == 0 else []
    return {
        "giou": 1 - float(np.mean(giou)),
        "distance": float(np.mean(distance)),
        "rest": 1 - float(np.mean(rest)),
    }


def test_loose_parts_are_punished_by_honest_alone() -> None:
    truth = cabinet()
    fewer = taken(truth, [0, 1])
    matching = by_nearness(fewer.centers, truth.centers)
    found = honest(fewer, truth, matching)
    assert found.rs_dgiou == pytest.approx(1.0 - (1.0 + 1.0 - 1.0) / 3.0, abs=1e-15)
    assert found.rs_dcdist == pytest.approx(truth.radius / 3.0, abs=1e-15)


def test_published_moves_direct_children_alone() -> None:
    chain = cabinet(parents=np.array([-1, 0, 1]))
    grand = cabinet(
        labels=("a", "b", "c", "d"),
        boxes=np.array([*chain.boxes, DRAWER]),
        types=np.array([0, 2, 2, 2]),
        axes=np.array([(0.0, 0.0, 0.0), *[(0.0, -1.0, 0.0)] * 3]),
        origins=np.zeros((4, 3)),
        limits=np.array([(0.0, 0.0), *[(0.0, 0.5)] * 3]),
        parents=np.array([-1, 0, 1, 2]),
        states=None,
    )
    assert published_poses(grand, 1.0)[:, 1, 3].tolist() == [0.0, -0.5, -1.0, -1.0]
    assert grand.poses(grand.opened(1.0))[:, 1, 3].tolist() == [0.0, -0.5, -1.0, -1.5]


def test_overlap_ratio_of_two_drawers_that_cross() -> None:
    """Two equal drawers, one over the other by half: IoU 1/3 in every state."""
    boxes = np.array([[(0.0, 0.0, 0.0), (1.0, 1.0, 1.0)], DRAWER, DRAWER])
    boxes[2] += (0.4, 0.0, 0.0)
    twins = cabinet(
        boxes=boxes,
        types=np.array([0, 2, 2]),
        axes=np.array([(0.0, 0.0, 0.0), *[(0.0, -1.0, 0.0)] * 2]),
        origins=np.zeros((3, 3)),
        limits=np.array([(0.0, 0.0), *[(0.0, 0.5)] * 2]),
    )
    assert overlap_ratio(twins) == pytest.approx(1.0 / 3.0, abs=1e-12)
    # Half the points of each box are inside: deviation of the shared volume V / 2 sqrt(2 N), of the
    # IoU below that over V; the mean over ten states; six of them.
    assert overlap_ratio_published(twins) == pytest.approx(
        1.0 / 3.0, abs=6.0 * 0.5 / math.sqrt(2e5)
    )
    assert overlap_ratio(cabinet()) == pytest.approx(0.0, abs=1e-12)


def test_where_no_two_parts_are_siblings_there_is_no_overlap_ratio() -> None:
    """The original gives -1 and leaves it out of means; a 0 would pass for a perfect score."""
    pair = taken(cabinet(), [0, 1])
    chain = cabinet(parents=np.array([-1, 0, 1]))
    for layout in (pair, chain):
        assert overlap_ratio(layout) is None
        assert overlap_ratio_published(layout) is None


def test_what_has_no_thickness_is_not_stretched_to_one() -> None:
    """A height of 1e-13 is a rounding: by its factor, the pivot of the door would fly away."""
    truth = cabinet()
    flat = cabinet(boxes=truth.boxes * (1.0, 1.0, 1e-13), origins=np.full((3, 3), 0.25))
    mine, _ = compared_as_published(flat, truth)
    assert np.abs(mine.origins).max() < 1.0
    assert np.ptp(mine.boxes[..., 2]) < 1e-12
