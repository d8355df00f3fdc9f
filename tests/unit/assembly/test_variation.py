"""Joints that open less far and fronts that are pushed: how often, how much, and which never."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from artgen.articulation.types import Limit, Mimic, Precondition
from artgen.assembly import invariants
from artgen.assembly.assemble import Assembled
from artgen.assembly.choice import Group
from artgen.assembly.library import is_slot
from artgen.assembly.plan import DONORS, first_plan
from artgen.assembly.run import new_object
from artgen.assembly.variation import (
    LEAST_TRAVEL,
    PUSHED,
    SHORTER,
    drawn_push,
    drawn_travels,
    may_shorten,
    shortened,
    takes_push,
    with_push,
)
from artgen.core.stream import Stream
from tests.unit.assembly.mutations import has, part_with, with_joint, with_layer, with_new
from tests.unit.assembly.test_fit import piece_of
from tests.unit.assembly.test_source import SLIDE

DRAWS = 2000


def binomial(share, count=DRAWS):
    """Five standard deviations: one test in two million fails by chance, and streams are fixed."""
    return 5.0 * np.sqrt(share * (1.0 - share) / count)


def test_one_object_in_ten_is_pushed_to_open():
    pushed = sum(drawn_push(Stream(k, "push")) for k in range(DRAWS))
    assert pushed / DRAWS == pytest.approx(PUSHED, abs=binomial(PUSHED))


@pytest.fixture(scope="module")
def source(market):
    return next(s for id in market.template_ids if len(may_shorten(s := market.library.source(id))))


def groups_of(library, source):
    return [Group(slots=(e,), donors=()) for e in library.members(source.id) if is_slot(e)]


def test_one_group_in_five_opens_less_far_evenly_down_to_four_fifths(library, source):
    """Shares are uniform, so their mean lies within 5 x 0.2 / sqrt(12 n) of 0.9."""
    groups = groups_of(library, source)[:1]
    drawn = [drawn_travels(source, groups, Stream(k)) for k in range(DRAWS)]
    shares = np.array([share for travels in drawn for share in travels.values()])
    assert len(shares) / DRAWS == pytest.approx(SHORTER, abs=binomial(SHORTER))
    assert shares.min() >= LEAST_TRAVEL
    assert shares.max() < 1.0
    assert shares.mean() == pytest.approx(0.9, abs=0.2 / np.sqrt(12 * len(shares)) * 5.0)


def test_a_group_has_one_kind_of_runners(market):
    for id in market.template_ids:
        source = market.library.source(id)
        slots = tuple(e for e in market.library.members(id) if is_slot(e))
        for k in range(20):
            shares = drawn_travels(source, [Group(slots=slots, donors=())], Stream(k))
            assert len(set(shares.values())) <= 1


def test_what_others_follow_or_wait_for_is_not_shortened(source):
    """The controls: with a follower, and with a joint that waits, the joint is no longer free."""
    joint = source.members[0].joint
    follower = replace(SLIDE, name="f", mimic=Mimic(joint=joint.name, multiplier=1.0, offset=0.0))
    second = replace(source.members[0], name="second", joint=follower)
    followed = replace(source, members=(*source.members, second))
    waited = replace(
        source, preconditions=(Precondition(joint="x", requires=joint.name, at_least=0.1),)
    )
    assert joint.name in may_shorten(source)
    assert joint.name not in may_shorten(waited)
    assert not {joint.name, "f"} & may_shorten(followed)


@pytest.mark.parametrize("upper", [0.3, np.pi / 2.0, 1e-3])
def test_a_shortened_joint_keeps_its_share_rounded_up(upper):
    joint = replace(SLIDE, limit=Limit(lower=0.0, upper=upper))
    found = shortened(joint, {"slide": LEAST_TRAVEL}).limit
    assert LEAST_TRAVEL * upper <= found.upper <= LEAST_TRAVEL * upper + 1e-6
    assert shortened(joint, {"another": LEAST_TRAVEL}) is joint


def test_after_the_last_donor_the_first_comes_again_opening_less_far(market):
    """Only where something is met on the way: a donor that cannot be fitted stays so."""
    id = market.template_ids[0]
    source = market.library.source(id)
    groups = market.groups(id, Stream(3).child("groups"))
    for moved_on in ("next_donor", "less_far"):
        plan, seen = first_plan(source, groups, Stream(3)), []
        while plan.donors[0] is not None:
            seen.append(plan.donors[0])
            getattr(plan, moved_on)(0, groups, "why")
        count = min(DONORS, len(groups[0].donors))
        free = {m.joint.name for m in source.members} & may_shorten(source)
        again = list(range(count)) * (moved_on == "less_far" and bool(free))
        assert seen == [*range(count), *again]


def test_pushed_fronts_have_no_handles_and_a_place_to_push(market, cases):
    """Others that take a handle have one, unless neither template nor donor had."""
    pushed = Counter(case.new.pushed for case in cases)
    assert pushed[True] >= 1
    for case in cases:
        for member, _, _ in case.filled:
            if case.new.pushed and member.kind == "front":
                assert case.new.layer(member.name, "handle") is None
                grips = case.new.piece(member.name).grips
                assert {grip.kind for grip in grips} <= {"edge"}
                assert grips or member.side == "along"


@pytest.mark.parametrize(
    ("side", "at"),
    [
        ("out", (0.2, 0.0, 0.3)),
        ("left", (0.38, 0.0, 0.3)),
        ("right", (0.02, 0.0, 0.3)),
        ("bottom", (0.2, 0.0, 0.58)),
        ("top", (0.2, 0.0, 0.02)),
    ],
)
def test_a_front_is_pushed_beside_the_side_that_opens(side, at):
    front = with_push(piece_of((0.0, 0.0, 0.0), (0.4, 0.02, 0.6)), side, "x")
    assert np.allclose(front.grips[0].position, at, atol=1e-9)


def test_fronts_with_an_edge_to_grip_and_sliding_doors_are_not_pushed(case_with):
    member = part_with(case_with(has("out")), "out")
    assert takes_push(member, replace(member, body=replace(member.body, grips=())))
    edge = with_push(member.body, "out", "edge")
    assert not takes_push(member, replace(member, body=edge))
    assert not takes_push(replace(member, side="along"), replace(member, body=edge))


def test_joints_of_what_is_assembled_open_as_far_or_less_by_a_fifth_at_most(market):
    found = [new_object(market, "storage_furniture", 4, k) for k in range(12)]
    shares = []
    for new in found:
        if isinstance(new, Assembled):
            own = {j.name: j.limit for j in market.library.source(new.template).joints}
            shares += [j.limit.upper / own[j.name].upper for j in new.joints if j.limit]
    assert min(shares) >= LEAST_TRAVEL
    assert max(shares) == 1.0
    assert min(shares) < 1.0


@pytest.mark.parametrize("share", [0.79, 1.01])
def test_17_a_joint_that_opens_a_fourth_less_or_further(case_with, share):
    case = case_with(has("out"))
    name = part_with(case, "out").name
    far = case.template.members[[m.name for m in case.template.members].index(name)].joint.limit
    other = with_joint(
        case, name, lambda j: replace(j, limit=Limit(lower=0.0, upper=share * far.upper))
    )
    assert {fault.number for fault in invariants.travels(other)} == {17}


def test_4_a_front_that_lost_its_handle_and_cannot_be_pushed(case_with):
    """The control: no handle, no edge, no place to push, where the template had a handle."""
    case = case_with(
        lambda c: any(m.handle and c.new.layer(m.name, "handle") for m, _, _ in c.filled)
    )
    name = next(m.name for m, _, _ in case.filled
                if m.handle and case.new.layer(m.name, "handle"))  # fmt: skip
    body, _, works = case.new.seams[name]
    bare = with_new(case, seams={**case.new.seams, name: (body, 0, works)})
    assert list(invariants.held(bare)) == []
    bare = with_layer(bare, name, "body", lambda p: p)
    gone = with_new(bare, parts=tuple(
        (n, lab, replace(p, grips=()) if n == name else p) for n, lab, p in bare.new.parts
    ))  # fmt: skip
    assert {fault.number for fault in invariants.held(gone)} == {4}
