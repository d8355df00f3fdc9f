"""Lids and trays are donors as doors and drawers are; bases stay with their template."""

from dataclasses import replace

import pytest

from artgen.articulation.types import ArticulatedObject, Joint, Limit
from artgen.assembly import invariants
from artgen.assembly.assemble import Assembled, assembled
from artgen.assembly.case import Case, case_of
from artgen.assembly.choice import Market
from artgen.assembly.invariants import broken
from artgen.assembly.library import Library, is_slot, write_library
from artgen.assembly.source import source_of_object
from artgen.core.licence import OURS
from artgen.core.stream import Stream
from tests.strategies import box_part, chest, hinge
from tests.unit.assembly.mutations import with_joint

SIZES = ((0.8, 0.4), (0.9, 0.42))
"""Width and depth of two pieces of furniture, m."""


def lidded(width: float, depth: float) -> ArticulatedObject:
    """A chest with a flat lid, hinged along its rear edge and with a strip to lift it by before its
    front edge."""
    x, y = width / 2.0, depth / 2.0
    base = box_part("base", [((-x, -y, 0.0), (x, y, 0.4))])
    board = ((-x, -y, 0.402), (x, y, 0.42))
    strip = ((-0.1, -y - 0.01, 0.405), (0.1, -y, 0.415))
    lid = box_part("lid", [board, strip], slots=[0, 1])
    joint = hinge(
        "hinge", "base", "lid", axis=(-1.0, 0.0, 0.0), origin=(0.0, y, 0.411),
        limit=Limit(lower=0.0, upper=1.5),
    )  # fmt: skip
    return furniture(base, lid, joint)


def trayed(width: float, depth: float) -> ArticulatedObject:
    """A table with a tray below its top that is pulled out."""
    x, y = width / 2.0, depth / 2.0
    base = box_part("base", [((-x, -y, 0.6), (x, y, 0.63)), ((-x, y - 0.02, 0.0), (x, y, 0.6))])
    tray = box_part("tray", [((-0.9 * x, -y, 0.5), (0.9 * x, 0.8 * y, 0.512))])
    joint = Joint(
        name="slide", type="prismatic", parent="base", child="tray", axis=(0.0, -1.0, 0.0),
        limit=Limit(lower=0.0, upper=0.2), friction=1.0, damping=1.0, effort=20.0, velocity=1.0,
    )  # fmt: skip
    return furniture(base, tray, joint)


def furniture(base, part, joint) -> ArticulatedObject:
    return replace(chest(), category="storage_furniture", parts=(base, part), joints=(joint,))


@pytest.fixture(scope="module", params=[(lidded, "lid", "rear"), (trayed, "tray", "out")])
def case(request, tmp_path_factory) -> Case:
    """The first of two, its moving part from the second."""
    made, label, side = request.param
    folder = tmp_path_factory.mktemp("library")
    sources = [
        source_of_object(made(*size), id=f"s{k}", licence=OURS, dataset="x", family="f")
        for k, size in enumerate(SIZES)
    ]
    write_library(folder, sources, recipe={})
    market = Market(Library(folder), ("storage_furniture",))
    (slot,) = (e for e in market.library.members("s0"))
    assert (slot.label, slot.kind, slot.side, is_slot(slot)) == (label, "whole", side, True)
    new = assembled(market, "s0", Stream(1))
    assert isinstance(new, Assembled), new
    return case_of(new, market.library)


def test_the_part_is_the_donors_and_the_base_the_templates(case):
    """The strip of the lid was once taken for its front: the donor gave a strip, the lid stayed."""
    taken = {(e["piece"], e["source"]) for e in case.new.sources}
    assert taken == {("base", "s0"), ("whole", "s1")}


def test_every_invariant_holds(case):
    """3 once asked of a lid that it swing to -y, where it has to go up."""
    assert broken(case) == []


def test_3_a_lid_that_opens_into_the_chest(case):
    """The control."""
    joint = case.new.joints[0]
    if joint.type == "prismatic":
        return
    flipped = with_joint(case, joint.child, lambda j: replace(j, axis=(1.0, 0.0, 0.0)))
    assert {fault.number for fault in invariants.hinges(flipped)} == {3}
    front = (0.0, -joint.origin[1], joint.origin[2])
    moved = with_joint(case, joint.child, lambda j: replace(j, origin=front))
    assert {fault.number for fault in invariants.hinges(moved)} == {3}
