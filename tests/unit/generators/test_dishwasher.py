"""Laws of dishwashers, over 30 seeds."""

import dataclasses
import math
from functools import cache

import manifold3d as m3
import numpy as np
import pytest

from artgen.articulation.canonical import canonicalize
from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Draft, DraftPart, State
from artgen.core.stream import Stream
from artgen.finish import settle_overlaps
from artgen.generators.dishwasher import INVARIANTS, PARAMS, build
from artgen.generators.kit.counterbalance import net_torque, weighed
from artgen.generators.kit.dishwasher_layout import ENTRY, DishwasherParams, layout
from artgen.geometry.clearance import Shape, shape_of_solids
from artgen.geometry.solid import Solid, slab, union
from artgen.rules import Sampled, load_rule, sample
from artgen.validate.sweep import crossings

SEEDS = range(30)
every_seed = pytest.mark.parametrize("index", SEEDS)
RULE = load_rule("dishwasher")
RACKS = ("lower_rack", "upper_rack", "cutlery_tray")
ROUNDING = 1e-12
"""m3; a cube of 0.1 mm: booleans of faces that just touch leave 1e-16 at most."""


@cache
def drawn(index: int) -> Sampled:
    return sample(RULE, Stream(5, "dishwasher", index), params_type=PARAMS, invariants=INVARIANTS)


@cache
def made(index: int) -> Draft:
    one = drawn(index)
    return canonicalize(build(one.params, one.surfaces))


def part(draft: Draft, name: str) -> DraftPart:
    return next(p for p in draft.parts if p.name == name)


def racks(draft: Draft) -> list[str]:
    return [p.name for p in draft.parts if p.name in RACKS]


def posed(draft: Draft, name: str, state: State) -> Solid:
    """All bodies of a part where a state puts them."""
    pose = forward_kinematics("base", draft.joints, state)[name]
    return union(body.solid for body in part(draft, name).bodies).transformed(pose)


def travel(draft: Draft, joint: str) -> float:
    limit = next(j for j in draft.joints if j.name == joint).limit
    assert limit is not None
    return limit.upper


def visual(draft: Draft) -> dict[str, Shape]:
    return {p.name: shape_of_solids(b.solid for b in p.bodies) for p in draft.parts}


def physical(draft: Draft) -> dict[str, Shape]:
    return {
        p.name: shape_of_solids(piece for b in p.bodies for piece in b.collision)
        for p in draft.parts
    }


@every_seed
def test_size_and_mass_are_those_of_its_class(index: int) -> None:
    """28 to 42 kg in the 0.45 m class, 35 to 55 kg in the 0.60 m class."""
    draft, p = made(index), drawn(index).params
    settled = [settle_overlaps(one) for one in draft.parts]
    bounds = np.array([body.solid.bounds for one in settled for body in one.bodies])
    extent = bounds[:, 1].max(axis=0) - bounds[:, 0].min(axis=0)
    mass = {one.name: weighed(one.bodies)[0] for one in settled}
    for value, band in zip(extent, ("width", "depth", "height"), strict=True):
        assert float(value) in RULE.bands[band]
    assert extent[0] == pytest.approx(p.width, abs=1e-9)
    lower, upper = (28.0, 42.0) if p.slim else (35.0, 55.0)
    assert lower <= sum(mass.values()) <= upper
    assert 3.0 <= mass["door"] <= 8.5
    assert all(0.5 <= mass[rack] <= 3.0 for rack in racks(draft))


@every_seed
def test_nothing_interpenetrates_over_any_travel(index: int) -> None:
    """Visible solids and collision pieces, at rest and over each joint, preconditions held."""
    draft = made(index)
    for shapes in (visual(draft), physical(draft)):
        found = list(crossings("base", draft.joints, draft.preconditions, shapes))
        assert [c for c in found if c.overlap.volume > ROUNDING] == []


@every_seed
def test_bodies_of_a_part_share_no_volume(index: int) -> None:
    """Else finishing cuts them, and the spring's mass is not the finished door's. The tub's beads
    under the rails are the one exception."""
    for one in made(index).parts:
        if one.name == "base":
            continue
        volumes = [body.solid.volume for body in one.bodies]
        assert union(b.solid for b in one.bodies).volume == pytest.approx(sum(volumes), abs=1e-9)


@pytest.mark.parametrize("index", range(0, 30, 6))
def test_racks_stand_clear_by_more_than_half_a_millimeter(index: int) -> None:
    """Wheels run 1 mm above the track, bars in their rails with 1.6 mm; faceted wheels lose
    nothing downwards because a vertex points there or the facet is higher."""
    draft = made(index)
    for rack in racks(draft):
        moving = union(b.solid for b in part(draft, rack).bodies).manifold
        for body in part(draft, "base").bodies:
            assert moving.min_gap(body.solid.manifold, 0.002) > 0.0005
        for body in part(draft, "door").bodies:
            assert moving.min_gap(body.solid.manifold, 0.002) > 0.0005


@every_seed
def test_racks_need_an_open_door(index: int) -> None:
    """Each precondition is necessary: with the door shut the rack meets it half-way out."""
    draft = made(index)
    for rack in racks(draft):
        slide = f"{rack}_slide"
        state = {slide: 0.5 * travel(draft, slide)}
        shared = posed(draft, rack, state) & posed(draft, "door", state)
        assert shared.volume > 1e-6


@every_seed
def test_the_lower_rack_needs_the_door_fully_open(index: int) -> None:
    """At 80 degrees, enough for the others, the door still rises into its wheels."""
    draft = made(index)
    state = {"lower_rack_slide": travel(draft, "lower_rack_slide"), "door_hinge": ENTRY}
    assert (posed(draft, "lower_rack", state) & posed(draft, "door", state)).volume > 1e-6


@pytest.mark.parametrize("index", range(0, 30, 3))
def test_preconditions_suffice_at_every_allowed_angle(index: int) -> None:
    draft = made(index)
    top = travel(draft, "door_hinge")
    for rule in draft.preconditions:
        rack = rule.joint.removesuffix("_slide")
        for angle in np.linspace(rule.at_least, top, 4):
            for share in (0.35, 0.7, 1.0):
                q = share * travel(draft, rule.joint)
                state = {"door_hinge": float(angle), rule.joint: q}
                rolled, opened = posed(draft, rack, state), posed(draft, "door", state)
                assert (rolled & opened).volume <= ROUNDING


@every_seed
def test_every_rack_has_one_precondition(index: int) -> None:
    draft = made(index)
    assert {rule.joint for rule in draft.preconditions} == {f"{r}_slide" for r in racks(draft)}
    assert {rule.requires for rule in draft.preconditions} == {"door_hinge"}
    assert all(ENTRY <= rule.at_least < travel(draft, "door_hinge") for rule in draft.preconditions)


@every_seed
def test_the_cavity_is_open(index: int) -> None:
    """A block that nearly fills the tub, and one in each rack, meet no collision piece; the tub's
    block meets no visible body but rails, shower head and the floor's edge either."""
    draft, at = made(index), layout(drawn(index).params)
    shift = part(draft, "base").bodies[0].solid.bounds.mean(axis=0)[1] - at.cabinet.depth / 2.0
    x, top = at.tub.half_width - 0.016, at.tub.ceiling - 0.015
    probe = slab((-x, shift - 0.001, at.track + 0.001), (x, shift + at.tub.depth - 0.004, top))
    for body in part(draft, "base").bodies:
        assert (probe & body.solid).volume < 1e-3 * probe.volume
        assert all((probe & piece).is_empty for piece in body.collision)
    for rack in racks(draft):
        pieces = [piece for b in part(draft, rack).bodies for piece in b.collision]
        lower, upper = np.array([piece.bounds for piece in pieces]).transpose(1, 0, 2)
        floor = pieces[0].bounds[1, 2]
        room = slab(
            (*(lower.min(axis=0) + 0.006)[:2], floor + 0.001),
            (*(upper.max(axis=0) - 0.006)[:2], upper[:, 2].max()),
        )
        assert all((room & piece).is_empty for piece in pieces)


@every_seed
def test_the_door_stays_where_it_is_put(index: int) -> None:
    """Friction exceeds what spring and gravity leave at every angle, and nowhere does opening or
    closing take more than 5 N m."""
    draft = made(index)
    hinge = next(j for j in draft.joints if j.name == "door_hinge")
    assert hinge.spring is not None
    q = np.linspace(0.0, travel(draft, "door_hinge"), 91)
    pull = net_torque(part(draft, "door").bodies, pivot=hinge.origin, spring=hinge.spring, q=q)
    assert pull[0] < 0.0  # The spring keeps the door shut.
    assert np.abs(pull).max() < hinge.friction
    assert 0.5 <= hinge.friction <= hinge.friction + np.abs(pull).max() <= 5.0


@every_seed
def test_arms_turn_within_the_tub(index: int) -> None:
    draft = made(index)
    width = layout(drawn(index).params).tub.half_width
    for name in ("lower_spray_arm", "upper_spray_arm"):
        joint = next(j for j in draft.joints if j.child == name)
        lower, upper = part(draft, name).bodies[0].solid.bounds
        assert joint.type == "continuous"
        assert max(
            upper[0], -lower[0], *np.abs([lower[1], upper[1]] - np.array(joint.origin[1]))
        ) < (width)


@every_seed
def test_an_art_sample_holds_all_parts(index: int) -> None:
    assert len(made(index).parts) <= 7


@every_seed
def test_meshes_are_light(index: int) -> None:
    """Before rounding, which adds some 1700 triangles to end at 14,500 at most."""
    count = sum(len(b.solid.trimesh().faces) for p in made(index).parts for b in p.bodies)
    assert count <= 12_800
    assert sum(len(b.collision) for p in made(index).parts for b in p.bodies) <= 40


def outline(draft: Draft) -> list[tuple[str, int]]:
    """Body counts by part: what a change of topology changes."""
    return [(p.name, len(p.bodies)) for p in draft.parts]


def genus(draft: Draft) -> int:
    """Handles of all bodies together."""
    return sum(b.solid.manifold.genus() for p in draft.parts for b in p.bodies)


BASE = {
    "form": "freestanding",
    "console": "buttons",
    "handle": "bar",
    "cutlery": "tray",
    "display": True,
    "shelves": 2,
    "blades": 2,
    "wheels": 4,
}


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("form", "built_under"),
        ("console", "touch"),
        ("console", "knob"),
        ("handle", "groove"),
        ("cutlery", "basket"),
        ("display", False),
        ("shelves", 1),
        ("blades", 3),
        ("wheels", 3),
    ],
)
def test_choices_change_the_topology(key: str, value: object) -> None:
    one = drawn(0)
    start = dataclasses.replace(one.params, **BASE)
    other = dataclasses.replace(start, **{key: value})
    first, second = build(start, one.surfaces), build(other, one.surfaces)
    pieces = [
        [len(b.solid.pieces()) for p in draft.parts for b in p.bodies] for draft in (first, second)
    ]
    faces = [
        sum(len(b.solid.trimesh().faces) for p in draft.parts for b in p.bodies)
        for draft in (first, second)
    ]
    assert (outline(first), pieces[0], genus(first)) != (
        outline(second),
        pieces[1],
        genus(second),
    ) or (faces[0] != faces[1])


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("handle_suits_front", {"form": "integrated", "handle": "pocket"}),
        ("door_clears_kick_plate", {"drop": 0.060, "toe_depth": 0.036}),
        ("panel_swings_under_sill", {"door": 0.030}),
        ("pin_above_kick", {"toe_height": 0.05, "drop": 0.04}),
        ("pins_fit_under_rack", {"tine_height": 0.30}),
    ],
)
def test_invariants_refuse_what_would_jam(name: str, change: dict[str, object]) -> None:
    good: DishwasherParams = drawn(0).params
    assert INVARIANTS[name](good)
    assert not INVARIANTS[name](dataclasses.replace(good, **change))


def test_the_rule_names_every_invariant() -> None:
    assert set(RULE.invariants) == set(INVARIANTS)


@every_seed
def test_the_closed_door_covers_the_mouth(index: int) -> None:
    """Seen from the front, no ray enters the tub."""
    at = layout(drawn(index).params)
    assert at.door.half_width > at.tub.half_width + 0.008
    assert at.door.bottom < at.tub.floor
    assert at.door.top > at.tub.ceiling + 0.008
    assert math.isclose(at.door.half_width, at.cabinet.half_width, abs_tol=0.003)


def test_a_union_of_wires_is_as_heavy_as_its_wires() -> None:
    """The basket's wires were spaced so that booleans find nothing to cut."""
    wires = part(made(0), "lower_rack").bodies[0].solid.pieces()
    assert sum(wire.volume for wire in wires) == pytest.approx(
        part(made(0), "lower_rack").bodies[0].solid.volume, rel=1e-9
    )
    assert all(wire.manifold.status() == m3.Error.NoError for wire in wires)
    assert all(wire.manifold.genus() in (0, 1) for wire in wires)
