"""What is asked of a joint follows from the role of what it moves; of strangers, from the shape."""

import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path

import pytest

from artgen.articulation.types import ArticulatedObject, Joint, Limit
from artgen.export.layout import URDF
from artgen.validate import validate_bundle
from tests.strategies import Corners
from tests.unit.validate.cabinet import board_part, cupboard, write_quick_bundle
from tests.unit.validate.test_foreign import verdict

KNOB: tuple[Corners, ...] = (((0.07, -0.24, 0.58), (0.11, -0.205, 0.62)),)
"""A square knob before the drawer's front, which ends at y = -0.2."""
LEVER: tuple[Corners, ...] = (((0.305, -0.06, 0.62), (0.33, 0.0, 0.64)),)
"""Beside the cabinet, whose side ends at x = 0.3."""
TURN = Joint(
    name="turn", type="revolute", parent="drawer", child="knob", axis=(0.0, -1.0, 0.0),
    origin=(0.09, 0.0, 0.6), limit=Limit(lower=0.0, upper=4.5), friction=0.02, damping=0.001,
    effort=0.5, velocity=6.0,
)  # fmt: skip
PRESS = Joint(
    name="press", type="prismatic", parent="base", child="lever", axis=(0.0, 0.0, -1.0),
    limit=Limit(lower=0.0, upper=0.1), friction=2.0, damping=1.0, effort=20.0,
)  # fmt: skip


TILTED = (math.sin(0.05), -math.cos(0.05), 0.0)


def gadget(
    *,
    knob: str = "knob",
    lever: str = "lever",
    turn: Joint = TURN,
    press: Joint = PRESS,
    knob_boards: Sequence[Corners] = KNOB,
) -> ArticulatedObject:
    """The cabinet with a knob on its drawer and a lever beside it."""
    cabinet = cupboard()
    added = (
        dataclasses.replace(board_part("knob", knob_boards), label=knob),
        dataclasses.replace(board_part("lever", LEVER), label=lever),
    )
    parts = (*cabinet.parts[:2], *added, cabinet.parts[2])
    parts = (parts[0], parts[1], parts[4], parts[2], parts[3])
    return dataclasses.replace(
        cabinet, parts=parts, joints=(*cabinet.joints, turn, press), asset_id="gadget_000000"
    )


def findings(obj: ArticulatedObject, folder: Path) -> set[tuple[str, str]]:
    report = validate_bundle(write_quick_bundle(obj, folder / "bundle"))
    # The cabinet's frame is centered without the lever.
    return {(f.check, f.part) for f in report.findings} - {
        ("semantics.ground", "object"),
        ("semantics.order", "lever"),
        ("semantics.order", "knob"),
        ("semantics.order", "drawer"),
    }


def test_a_knob_turns_about_its_middle_and_a_lever_slides_far(tmp_path: Path) -> None:
    assert findings(gadget(), tmp_path) == set()


def test_a_stranger_may_have_them_too(tmp_path: Path) -> None:
    folder = write_quick_bundle(gadget(), tmp_path / "bundle")
    assert verdict(folder / URDF).findings == ()


def in_middle(**changes: object) -> Joint:
    return dataclasses.replace(TURN, **changes)  # type: ignore[arg-type]


DEFECTS = {
    "a knob called a door": ("semantics.hinge", "turn", gadget(knob="door")),
    "a lever called a tray": ("semantics.travel", "press", gadget(lever="tray")),
    "no word of the vocabulary": ("semantics.role", "knob", gadget(knob="nob")),
    "a second base": ("semantics.role", "knob", gadget(knob="base")),
    "a knob that turns about the air beside it": (
        "semantics.hinge", "turn", gadget(turn=in_middle(origin=(0.03, 0.0, 0.6))),
    ),
    "a lever that leaves its slit": (
        "semantics.travel", "press",
        gadget(press=dataclasses.replace(PRESS, limit=Limit(lower=0.0, upper=0.7))),
    ),
    "a lid that turns both ways": (
        "structure.rest", "turn (asset.urdf)",
        gadget(knob="lid", turn=in_middle(limit=Limit(lower=-1.0, upper=1.0))),
    ),
    "a knob that rests ajar": (
        "structure.rest", "turn (asset.urdf)",
        gadget(turn=in_middle(limit=Limit(lower=-1.0, upper=2.0))),
    ),
    "a knob whose axis is off by three degrees": (
        "semantics.tilt", "turn",
        gadget(turn=in_middle(axis=TILTED, origin=(0.09, -0.2, 0.6))),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", DEFECTS)
def test_a_joint_against_its_role_is_named(name: str, tmp_path: Path) -> None:
    check, part, obj = DEFECTS[name]
    assert (check, part) in findings(obj, tmp_path)


def test_a_knob_may_turn_both_ways(tmp_path: Path) -> None:
    both = in_middle(limit=Limit(lower=-2.0, upper=2.0))
    assert findings(gadget(turn=both), tmp_path) == set()


STRANGERS = {
    "a pivot that no pin goes through": (
        "semantics.hinge", "turn", gadget(turn=in_middle(origin=(0.03, 0.0, 0.6))),
    ),
    "a slide that leaves its parent": (
        "semantics.travel", "press",
        gadget(press=dataclasses.replace(PRESS, limit=Limit(lower=0.0, upper=0.7))),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", STRANGERS)
def test_a_strangers_joint_is_still_judged(name: str, tmp_path: Path) -> None:
    check, part, obj = STRANGERS[name]
    report = verdict(write_quick_bundle(obj, tmp_path / "bundle") / URDF)
    assert (check, part) in {(f.check, f.part) for f in report.findings}, report.findings
