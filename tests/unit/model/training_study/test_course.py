"""What an arm changes of the usual run, and nothing else."""

from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.core.jsonio import plain
from model.evaluation.metrics import METRICS
from model.training.run_state import differences
from model.training_study.ablations import arms
from model.training_study.claims import ARMS, CLAIMS, NAMES
from model.training_study.course import Course, curve_points

COURSE = Course(size="nano", steps=400, batch=8, scenes=2)
LIBRARY = Path("library.npz")


@pytest.mark.parametrize("name", ARMS)
def test_an_arm_changes_what_it_names_alone(name: str) -> None:
    arm = ARMS[name]
    own = COURSE.cell(arm, LIBRARY, seed=3).stages[-1]
    usual = COURSE.cell(ARMS[arm.kind], LIBRARY, seed=3).stages[-1]
    changed = {line.split(" ")[0] for line in differences(plain(usual), plain(own))}
    named = {word.partition("=")[0] for word in arm.settings}
    lengths = {"train.steps", "train.warmup_steps", "train.ema_decay"} if arm.static else set()
    assert changed <= named | lengths
    assert own.train.seed == own.data.seed == 3
    assert (own.model.planes is None) == (arm.kind == "boxes")


def test_pretraining_takes_its_share_of_the_updates() -> None:
    cell = COURSE.cell(ARMS["pretrained"], LIBRARY, seed=0)
    assert [stage.recipe for stage in cell.stages] == ["static_pretrain", "multiview"]
    assert [stage.train.steps for stage in cell.stages] == [100, 300]
    assert cell.stages[0].train.forced == 1.0  # Nothing teaches joints while parts rest.
    assert cell.steps == 400


def test_seeds_change_the_seed_alone() -> None:
    one, other = (COURSE.cell(ARMS["boxes"], LIBRARY, seed=seed) for seed in (0, 1))
    changed = differences(plain(one.stages[0]), plain(other.stages[0]))
    assert changed == ["data.seed 0, now 1", "train.seed 0, now 1"]


def test_settings_of_the_course_reach_every_arm() -> None:
    course = Course(size="nano", steps=10, batch=8, scenes=None, settings=("train.clip_norm=3",))
    for arm in ARMS.values():
        for stage in course.cell(arm, LIBRARY, seed=0).stages:
            assert stage.train.clip_norm == 3.0


def test_points_of_a_curve_are_where_checkpoints_are() -> None:
    cell = COURSE.cell(ARMS["boxes"], LIBRARY, seed=0, curve=4)
    assert cell.curve == (100, 200, 300, 400)
    train = cell.stages[-1].train
    assert (train.save_every, train.keep) == (100, 4)
    assert curve_points(400, 0) == ()
    with pytest.raises(UsageError, match="do not divide into 3"):
        curve_points(400, 3)


def test_courses_that_cannot_be_are_refused() -> None:
    with pytest.raises(UsageError, match="must be at least 1"):
        Course(size="nano", steps=0, batch=8, scenes=2)


def test_claims_name_arms_of_one_kind_and_metrics_that_exist() -> None:
    for claim in CLAIMS:
        for own in claim.comparisons:
            assert ARMS[own.arm].kind == ARMS[own.against].kind
            assert own.against in ("boxes", "shapes")
        assert set(claim.metrics) <= set(NAMES)
    assert set(NAMES) <= set(METRICS)
    assert all(METRICS[name].better for name in NAMES)


def test_arms_of_claims() -> None:
    assert arms(("order", "images")) == ["boxes", "blind", "shuffled"]
    assert set(arms(())) == set(ARMS)
    assert arms(())[:2] == ["boxes", "shapes"]
