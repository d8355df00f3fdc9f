"""The invariants of one object hold of what is assembled, and each catches what it is for.

Numbers are those of docs/assembly.md. 8 and 12 to 14 are about files and sets: see test_run,
test_round_trip and the study's tests.
"""

from dataclasses import replace

import numpy as np
import pytest

from artgen.articulation.types import Limit
from artgen.assembly import invariants
from artgen.assembly.invariants import broken
from artgen.assembly.piece import piece_of_part
from artgen.assembly_study.rows import left_as_it_was
from artgen.core.licence import PARTNET
from artgen.dataset.split import split_of
from tests.strategies import box_part, hinge
from tests.unit.assembly.mutations import (
    has,
    moved_by,
    part_with,
    scaled,
    with_joint,
    with_layer,
    with_new,
    with_piece,
)


def numbers(found):
    return {fault.number for fault in found}


def test_all_hold_of_what_is_assembled(cases):
    assert len(cases) >= 20
    assert [fault for case in cases for fault in broken(case)] == []


def test_1_another_kind_of_joint_is_another_tree(case_with):
    case = case_with(has("out"))
    name = part_with(case, "out").name
    swapped = with_joint(case, name, lambda j: replace(j, type="revolute", origin=(0.0, 0.0, 0.0)))
    assert numbers(invariants.tree(swapped)) == {1}


def test_1_another_label_is_another_tree(cases):
    case = cases[0]
    name = case.template.members[0].name
    parts = tuple((n, "lid" if n == name else label, p) for n, label, p in case.new.parts)
    assert numbers(invariants.tree(with_new(case, parts=parts))) == {1}


def test_2_and_6_a_donor_scaled_by_a_tenth_too_much(case_with):
    """Two fronts beside each other lie 3 mm apart: one a tenth larger meets the other."""
    case = case_with(lambda c: has("out")(c) and len(c.template.members) >= 4)
    name = part_with(case, "out").name
    large = with_layer(case, name, "body", lambda piece: scaled(piece, 1.1))
    assert numbers(invariants.boxes(large)) == {2}
    assert numbers(invariants.clear(large)) == {6}


def test_2_a_base_that_is_not_the_templates(case_with):
    case = case_with(lambda c: len(c.new.parts) >= 3)
    base = case.new.parts[0][0]
    taller = with_piece(case, base, lambda p: moved_by(p, lambda v: v * (1.0, 1.0, 1.01)))
    assert base in {fault.part for fault in invariants.boxes(taller)}


def test_6_doors_that_meet_when_both_are_open(cases):
    """Each alone passes the other, which is closed; the control opens less far."""
    base = box_part("base", [((-0.4, 0.03, 0.0), (0.4, 0.3, 0.5))])
    left = box_part("left", [((-0.4, 0.0, 0.0), (-0.01, 0.02, 0.5))])
    right = box_part("right", [((0.01, 0.0, 0.0), (0.4, 0.02, 0.5))])
    parts = tuple((p.name, p.label, piece_of_part(p)) for p in (base, left, right))
    numbers_at = {}
    for degrees in (80.0, 120.0):
        limit = Limit(lower=0.0, upper=np.radians(degrees))
        joints = tuple(
            hinge(name, "base", name, axis=(0.0, 0.0, turn), origin=(x, 0.0, 0.0), limit=limit)
            for name, x, turn in (("left", -0.01, 1.0), ("right", 0.01, -1.0))
        )
        both = with_new(cases[0], parts=parts, joints=joints, preconditions=())
        numbers_at[degrees] = numbers(invariants.clear(both))
    assert numbers_at == {80.0: set(), 120.0: {6}}


def test_3_an_axis_that_is_not_along_its_edge(case_with):
    """0.2 degrees off; 0.1 are allowed."""
    case = case_with(has("left", "right"))
    name = part_with(case, "left", "right").name
    tilt = np.radians(0.2)
    tilted = with_joint(
        case, name,
        lambda j: replace(j, axis=(np.sin(tilt), 0.0, float(np.copysign(np.cos(tilt), j.axis[2])))),
    )  # fmt: skip
    assert {fault.part for fault in invariants.hinges(tilted)} == {name}


@pytest.mark.parametrize("side", ["left", "right"])
def test_3_the_hinge_moved_to_the_other_edge(case_with, side):
    case = case_with(has(side))
    member = part_with(case, side)
    body = case.new.layer(member.name, "body")
    far = body.bounds[1 if side == "left" else 0, 0]
    moved = with_joint(case, member.name, lambda j: replace(j, origin=(far, *j.origin[1:])))
    assert 3 in numbers(invariants.hinges(moved))


def test_3_a_door_that_turns_inward(case_with):
    case = case_with(has("left", "right"))
    name = part_with(case, "left", "right").name
    flipped = with_joint(case, name, lambda j: replace(j, axis=tuple(-a for a in j.axis)))
    assert 3 in numbers(invariants.hinges(flipped))


def test_4_a_handle_left_too_large(case_with):
    case = case_with(has("out", layer="handle"))
    name = part_with(case, "out", layer="handle").name
    large = with_layer(case, name, "handle", lambda piece: scaled(piece, 6.0))
    assert numbers(invariants.handles(large)) == {4}


def test_4_a_handle_on_the_side_of_the_hinge(case_with):
    case = case_with(has("left", "right", layer="handle"))
    member = part_with(case, "left", "right", layer="handle")
    middle = case.new.layer(member.name, "body").bounds.mean(axis=0)[0]
    beside = with_layer(
        case, member.name, "handle",
        lambda p: moved_by(p, lambda v: np.array([2.0 * middle, 0, 0]) - v * (1, -1, -1)),
    )  # fmt: skip
    assert numbers(invariants.handles(beside)) == {4}


def test_4_a_handle_in_the_air(case_with):
    case = case_with(has("out", layer="handle"))
    name = part_with(case, "out", layer="handle").name
    away = with_layer(case, name, "handle", lambda p: moved_by(p, lambda v: v - (0, 0.02, 0)))
    assert numbers(invariants.handles(away)) == {4}


def test_5_an_axis_that_points_inward(case_with):
    case = case_with(has("out", layer="handle"))
    name = part_with(case, "out", layer="handle").name
    flipped = with_joint(
        case, name, lambda j: replace(j, axis=(0.0, 1.0, 0.0), limit=Limit(lower=0.0, upper=0.03))
    )
    assert 5 in numbers(invariants.rest(alone(flipped, name)))


def test_5_the_open_end_stated_as_rest(case_with):
    case = case_with(has("out"))
    name = part_with(case, "out").name
    joint = next(j for j in case.new.joints if j.child == name)
    opened = with_piece(
        case, name, lambda p: moved_by(p, lambda v: v + np.multiply(joint.limit.upper, joint.axis))
    )
    stated = with_joint(opened, name, lambda j: replace(j, axis=tuple(-a for a in j.axis)))
    assert 5 in numbers(invariants.rest(stated))


def alone(case, name):
    """The base and one moving part."""
    base = case.new.parts[0][0]
    return with_new(
        case,
        parts=tuple(part for part in case.new.parts if part[0] in (base, name)),
        joints=tuple(joint for joint in case.new.joints if joint.child == name),
    )


def test_7_a_drawer_that_leaves_its_rails(case_with):
    case = case_with(has("out"))
    name = part_with(case, "out").name
    length = float(np.ptp(case.new.piece(name).bounds[:, 1]))
    long = with_joint(case, name, lambda j: replace(j, limit=Limit(lower=0.0, upper=0.99 * length)))
    assert numbers(invariants.engaged(long)) == {7}


def test_7_a_drawer_that_is_hardly_held(case_with):
    """It starts far out, so that less than a tenth of it is left inside, with a travel that is
    allowed."""
    case = case_with(has("out"))
    name = part_with(case, "out").name
    length = float(np.ptp(case.new.piece(name).bounds[:, 1]))
    out = with_piece(case, name, lambda p: moved_by(p, lambda v: v - (0.0, 0.5 * length, 0.0)))
    half = with_joint(out, name, lambda j: replace(j, limit=Limit(lower=0.0, upper=0.5 * length)))
    (fault,) = invariants.engaged(half)
    assert (fault.number, fault.part) == (7, name)
    assert "within the base" in fault.bound


def test_9_a_triangle_without_area(cases):
    case = cases[0]
    name = next(iter(case.new.seams))

    def flat(piece):
        points = np.array(piece.mesh.vertices)
        _, second, third = piece.mesh.faces[0]
        points[third] = points[second]
        return replace(piece, mesh=replace(piece.mesh, vertices=points))

    faults = list(invariants.sound(with_piece(case, name, flat)))
    assert any("m2" in fault.value for fault in faults)


def test_9_mirrored_without_turning_the_winding(cases):
    case = cases[0]
    name = next(iter(case.new.seams))
    inward = with_piece(
        case, name, lambda p: replace(p, mesh=replace(p.mesh, faces=p.mesh.faces[:, [0, 2, 1]]))
    )
    assert numbers(invariants.sound(inward)) == {9}


def test_9_a_triangle_twice(cases):
    case = cases[0]
    name = case.new.parts[0][0]

    def doubled(piece):
        mesh = piece.mesh
        twice = {key: np.concatenate([getattr(mesh, key), getattr(mesh, key)[:1]])
                 for key in ("faces", "uv", "slot", "body")}  # fmt: skip
        return replace(piece, mesh=replace(mesh, **twice))

    assert 9 in numbers(invariants.sound(with_piece(case, name, doubled)))


def test_9_collision_that_reaches_out_of_its_part(cases):
    """A front of a hollow door whose collision reaches back through a lining that is not there."""
    case = cases[0]
    name = next(iter(case.new.seams))

    def deep(piece):
        longer = [replace(c, vertices=np.add(c.vertices, (0.0, 0.3, 0.0))) for c in piece.collision]
        return replace(piece, collision=tuple(longer))

    assert 9 in numbers(invariants.sound(with_piece(case, name, deep)))


def test_10_texture_left_stretched(cases):
    """Left as they were on the donor, fronts that were scaled unequally show it."""
    caught = 0
    for case in cases:
        for entry in case.new.given:
            if entry["piece"] != "front" or max(entry["scale"]) / min(entry["scale"]) < 1.5:
                continue
            donor = next(m for m in case.sources[entry["source"]].members
                         if m.name == entry["of"])  # fmt: skip
            left = with_layer(
                case, entry["part"], "body",
                lambda p, d=donor, e=entry: replace(
                    p, mesh=replace(p.mesh, uv=left_as_it_was(
                        p.mesh, d.body.mesh, mirrored=e["mirrored"]).uv)
                ),
            )  # fmt: skip
            assert 10 in numbers(invariants.textured(left))
            caught += 1
    assert caught >= 3


def test_10_a_coordinate_that_is_no_number(cases):
    """Comparisons with NaN are false, so no bound was ever broken by one."""
    case = cases[0]
    name = next(iter(case.new.seams))

    def spoiled(piece):
        uv = np.array(piece.mesh.uv)
        uv[0, 0, 0] = np.nan
        return replace(piece, mesh=replace(piece.mesh, uv=uv))

    (fault,) = broken(with_piece(case, name, spoiled))
    assert (fault.number, fault.part) == (10, name)


def test_10_a_part_that_is_denser_than_the_others(case_with):
    """By 1.4 all over, which stretches nothing."""
    case = case_with(lambda c: len(c.new.parts) >= 4)
    name = next(iter(case.new.seams))
    dense = with_piece(
        case, name, lambda p: replace(p, mesh=replace(p.mesh, uv=np.asarray(p.mesh.uv) * 1.4))
    )
    faults = list(invariants.textured(dense))
    assert name in {fault.part for fault in faults if fault.bound.startswith("density")}


def test_10_a_material_that_is_dense_here_and_coarse_there(cases):
    """Every second triangle of the base three times as dense."""
    case = cases[0]
    base = case.new.parts[0][0]

    def uneven(piece):
        uv = np.array(piece.mesh.uv)
        uv[::2] *= 3.0
        return replace(piece, mesh=replace(piece.mesh, uv=uv))

    faults = list(invariants.textured(with_piece(case, base, uneven)))
    assert any(fault.bound.startswith("variation") for fault in faults)


def test_11_a_pane_that_became_wood(case_with):
    def glazed(case):
        return any("glass" in s.name for s in case.new.surfaces) and any(
            case.new.surfaces[k].transmission > 0.0
            for name in case.new.seams
            for k in case.new.layer(name, "body").slots
        )

    case = case_with(glazed)
    opaque = tuple(replace(s, transmission=0.0) for s in case.new.surfaces)
    assert numbers(invariants.kept_roles(with_new(case, surfaces=opaque))) == {11}


def test_15_one_restrictive_source_binds_the_whole(cases):
    case = cases[0]
    used = case.new.given[0]["source"]
    told = tuple({**e, "licence": PARTNET.id} if e["source"] == used else e
                 for e in case.new.sources)  # fmt: skip
    bound = {**case.sources, used: replace(case.sources[used], licence=PARTNET)}
    case = with_new(replace(case, sources=bound), sources=told)
    assert numbers(invariants.licensed(case)) == {15}
    assert not numbers(invariants.licensed(with_new(case, licence=PARTNET)))


def test_15_a_piece_without_a_source(cases):
    """Each in turn: once no check could fail here, and bases, works and fronts that the template
    kept named no source."""
    for case in cases[:6]:
        told = case.new.sources
        assert {part for part, _, _ in case.new.parts} == {entry["part"] for entry in told}
        for k, entry in enumerate(told):
            less = with_new(case, sources=(*told[:k], *told[k + 1 :]))
            faults = list(invariants.licensed(less))
            assert [fault.part for fault in faults] == [entry["part"]]


def test_15_a_source_under_other_terms(cases):
    case = cases[0]
    told = ({**case.new.sources[0], "licence": "MIT"}, *case.new.sources[1:])
    assert numbers(invariants.licensed(with_new(case, sources=told))) == {15}


def test_16_a_donor_of_another_split(cases):
    case = cases[0]
    own = split_of("", case.new.donors)
    other = next(f"x{k}" for k in range(99) if split_of(f"x{k}") != own)
    mixed = with_new(case, donors=(*case.new.donors, other))
    assert numbers(invariants.held_out(mixed)) == {16}


def test_16_a_donor_that_is_not_named(cases):
    case = cases[0]
    used = case.new.given[0]["source"]
    sources = {**case.sources, used: replace(case.sources[used], family="unnamed")}
    assert numbers(invariants.held_out(replace(case, sources=sources))) == {16}


def test_16_a_front_or_a_handle_that_another_split_offers(cases):
    """Once only families were looked at."""
    case = next(c for c in cases if any(e["piece"] == "handle" and e["source"] != c.template.id
                                        for e in c.new.sources))  # fmt: skip
    assert not numbers(invariants.held_out(case))
    for key, pieces in (("handle_splits", {"handle"}), ("body_splits", {"front", "whole"})):
        splits = dict.fromkeys(getattr(case, key), "elsewhere")
        faults = list(invariants.held_out(replace(case, **{key: splits})))
        assert numbers(faults) == {16}
        told = {fault.value.split()[1] for fault in faults}
        assert told <= pieces
