"""Laws of cabinets over many draws: sizes, clearances, reach, open interiors, variety."""

import dataclasses
import itertools
import math
from functools import cache

import numpy as np
import pytest

from artgen.articulation.canonical import part_bounds
from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import required_state
from artgen.articulation.types import Draft, DraftPart, Joint
from artgen.core.stream import Stream
from artgen.generators import cabinet
from artgen.generators.kit import cabinet_params
from artgen.generators.kit.cabinet_hinge import AXIS_AHEAD, KNUCKLE
from artgen.generators.kit.cabinet_kinds import KINDS
from artgen.generators.kit.front_layout import Cell
from artgen.geometry.clearance import Mover, Shape, overlaps, shape_of_solids
from artgen.geometry.solid import Solid, slab
from artgen.rules import Sampled, load_rule, sample

RULE = load_rule("cabinet")
SEEDS = range(40)
every_seed = pytest.mark.parametrize("seed", SEEDS)
CLEARANCE = 0.001
"""m; what is designed to stay between parts."""
ROUNDING = 1e-9
"""m; float64 coordinates of a meter, turned by up to 2 rad, are off by some 1e-15."""


@cache
def drawn(seed: int) -> Sampled:
    return sample(
        RULE,
        Stream(seed, "cabinet", 7),
        params_type=cabinet.PARAMS,
        invariants=cabinet.INVARIANTS,
    )


@cache
def drafted(seed: int) -> Draft:
    sampled = drawn(seed)
    return cabinet.build(sampled.params, sampled.surfaces)


def movers_of(draft: Draft) -> list[tuple[DraftPart, Joint]]:
    parts = {part.name: part for part in draft.parts}
    return [(parts[joint.child], joint) for joint in draft.joints]


def shapes(draft: Draft) -> tuple[dict[str, Shape], dict[str, Shape]]:
    """Visible bodies and contact pieces by part."""
    seen = {p.name: shape_of_solids([b.solid for b in p.bodies]) for p in draft.parts}
    felt = {
        p.name: shape_of_solids([c for b in p.bodies for c in b.collision]) for p in draft.parts
    }
    return seen, felt


@every_seed
def test_size_and_mass_lie_in_the_bands(seed: int) -> None:
    draft = drafted(seed)
    boxes = np.array([part_bounds(part) for part in draft.parts])
    extent = boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)
    mass = sum(b.density * b.solid.volume for part in draft.parts for b in part.bodies)
    found = dict(zip(("width", "depth", "height", "mass"), (*extent, mass), strict=True))
    assert {name: value in RULE.bands[name] for name, value in found.items()} == dict.fromkeys(
        RULE.bands, True
    )


@every_seed
def test_the_layout_tiles_the_face_exactly(seed: int) -> None:
    """Covers have the face's area and share none: they tile it. So do openings and boards."""
    params = drawn(seed).params
    case = cabinet_params.case_of(params)
    cells, boards = cabinet_params.layout(params)
    covers = [cell.cover for cell in cells]
    insides = [cell.opening for cell in cells] + [board.place for board in boards]
    for rects, whole in ((covers, case.face), (insides, case.opening)):
        area = sum(rect.width * rect.height for rect in rects)
        assert area == pytest.approx(whole.width * whole.height, rel=1e-12)
        for a, b in itertools.combinations(rects, 2):
            wide = min(a.x1, b.x1) - max(a.x0, b.x0)
            high = min(a.z1, b.z1) - max(a.z0, b.z0)
            assert min(wide, high) <= 1e-12


@every_seed
def test_parts_keep_a_millimetre_apart_over_every_travel(seed: int) -> None:
    draft = drafted(seed)
    for joint in draft.joints:
        held = required_state(joint.name, draft.preconditions)
        for share in (0.0, 0.04, 0.3, 1.0):
            state = {**held, joint.name: share * joint.limit.upper}
            pose = forward_kinematics("base", draft.joints, state)
            assert least_gap(draft, pose, joint.child) >= CLEARANCE - ROUNDING, (joint.name, share)


def least_gap(draft: Draft, pose: dict[str, np.ndarray], name: str) -> float:
    """The least distance of a part to the others, m; at most twice the clearance."""
    placed = [
        (part.name, solid, solid.bounds)
        for part in draft.parts
        for solid in (body.solid.transformed(pose[part.name]) for body in part.bodies)
    ]
    own = [entry for entry in placed if entry[0] == name]
    least = 2.0 * CLEARANCE
    for (_, a, box_a), (other, b, box_b) in itertools.product(own, placed):
        apart = max(np.max(box_a[0] - box_b[1]), np.max(box_b[0] - box_a[1]))
        if other != name and apart < least:
            least = min(least, a.manifold.min_gap(b.manifold, 2.0 * CLEARANCE))
    return least


@every_seed
def test_nothing_meets_when_several_stand_open_at_once(seed: int) -> None:
    draft = drafted(seed)
    rng = np.random.Generator(np.random.PCG64(seed))
    limits = {joint.name: joint.limit.upper for joint in draft.joints}
    for _ in range(12):
        shares = rng.choice([0.0, 1.0, rng.uniform()], size=len(limits))
        state = {
            name: share * q
            for share, (name, q) in zip(shares.tolist(), limits.items(), strict=True)
        }
        for rule in draft.preconditions:
            if state[rule.joint] > 0.0:
                state[rule.requires] = max(state[rule.requires], rule.at_least)
        assert crossings(draft, state) == []


def crossings(draft: Draft, state: dict[str, float]) -> list[tuple[str, str]]:
    """Pairs that share more than a cube of 0.5 mm, by sight or touch."""
    pose = forward_kinematics("base", draft.joints, state)
    return [
        (overlap.first, overlap.second)
        for kind in shapes(draft)
        for overlap in overlaps(
            [Mover(name=name, shape=shape, poses=pose[name][None]) for name, shape in kind.items()]
        )
        if overlap.volume > 1.25e-10
    ]


@every_seed
def test_rest_is_closed_for_good(seed: int) -> None:
    """Pushed 8 mm (drawers) or 8 mm at the free edge (doors) beyond rest, a part meets another."""
    draft = drafted(seed)
    for part, joint in movers_of(draft):
        width = float(np.diff(part_bounds(part), axis=0)[0, 0])
        push = 0.008 if joint.type == "prismatic" else 0.008 / width
        assert any(part.name in pair for pair in crossings(draft, {joint.name: -push})), part.name


@every_seed
def test_preconditions_are_true(seed: int) -> None:
    """A drawer behind a door runs into the closed door."""
    draft = drafted(seed)
    upper = {joint.name: joint.limit.upper for joint in draft.joints}
    for rule in draft.preconditions:
        assert crossings(draft, {rule.joint: 0.5 * upper[rule.joint]})
        assert rule.at_least <= upper[rule.requires]


@every_seed
def test_drawers_travel_most_of_their_length_and_doors_open_wide(seed: int) -> None:
    draft = drafted(seed)
    for part, joint in movers_of(draft):
        if joint.type == "prismatic":
            box = np.array([b.solid.bounds for b in part.bodies if b.surface == "drawer_box"])
            length = box[:, 1, 1].max() - box[:, 0, 1].min()
            assert 0.6 <= joint.limit.upper / length <= 0.9
            assert joint.axis == (0.0, -1.0, 0.0)
        else:
            assert math.radians(70.0) <= joint.limit.upper <= math.radians(112.0)
            assert joint.axis[:2] == (0.0, 0.0)


@every_seed
def test_hinges_lie_along_an_edge_of_their_door(seed: int) -> None:
    """At the face's outer edge, or on the knuckles before it: within the thickness of a front."""
    draft = drafted(seed)
    for part, joint in movers_of(draft):
        if joint.type == "revolute":
            lower = part.bodies[0].solid.bounds[0]
            aside = np.abs(part_bounds(part)[:, 0] - joint.origin[0]).min()
            assert aside <= KNUCKLE + ROUNDING
            assert abs(joint.origin[1] - lower[1]) <= AXIS_AHEAD + ROUNDING


@every_seed
def test_drawers_are_open_boxes(seed: int) -> None:
    """The room between the sides, up to their upper edge, is free of bodies and contact pieces."""
    draft = drafted(seed)
    for part, joint in movers_of(draft):
        if joint.type == "prismatic":
            room = inside_of(part)
            solids = [b.solid for p in draft.parts for b in p.bodies]
            pieces = [c for p in draft.parts for b in p.bodies for c in b.collision]
            assert room.volume > 0.0005, part.name
            assert sum((room & solid).volume for solid in solids + pieces) == 0.0, part.name


def inside_of(part: DraftPart) -> Solid:
    """The drawer's room: between its sides and ends, above its bottom."""
    *ends, bottom = [b.solid.bounds for b in part.bodies if b.surface == "drawer_box"]
    lower, upper = bottom[0].copy(), bottom[1].copy()
    lower[2], upper[2] = bottom[1, 2], min(box[1, 2] for box in ends)
    return slab(lower + 1e-6, upper - 1e-6)


@every_seed
def test_grips_are_within_reach(seed: int) -> None:
    """Metal handles stand before the face: drawers' amid the front, doors' far from the hinge."""
    draft = drafted(seed)
    for part, joint in movers_of(draft):
        box = part_bounds(part)
        for body in part.bodies:
            lower, upper = body.solid.bounds
            if body.surface != "metal" or upper[1] > box[0, 1] + 0.045 or lower[1] > box[0, 1]:
                continue
            x, _, z = (lower + upper) / 2.0
            assert 0.1 <= z <= 1.75
            assert (lower[[0, 2]] >= box[0, [0, 2]]).all()
            assert (upper[[0, 2]] <= box[1, [0, 2]]).all()
            if joint.type == "revolute":
                width = box[1, 0] - box[0, 0]
                assert abs(x - joint.origin[0]) > 0.6 * width


@every_seed
def test_nothing_fixed_hides_a_front(seed: int) -> None:
    """Each front can be seen and gripped: only the toe room of air lies before it."""
    draft = drafted(seed)
    base = draft.parts[0]
    for part, _ in movers_of(draft):
        if "_" in part.name.removeprefix("drawer_"):
            continue  # It waits behind a door.
        front = part.bodies[0].solid.bounds
        lower, upper = front.copy()
        lower[1], upper[1] = front[0, 1] - 0.5, front[0, 1] - 0.012
        margin = np.array([0.002, 0.0, 0.002])
        air = slab(lower + margin, upper - margin)
        assert sum((air & body.solid).volume for body in base.bodies) == 0.0, part.name


def test_draws_differ_in_kind_layout_and_parts() -> None:
    params = [drawn(seed).params for seed in SEEDS]
    words = [topology(p, cabinet_params.layout(p)[0]) for p in params]
    layouts = {word[1] for word in words}
    assert len(set(words)) >= 38
    assert len(layouts) >= 22
    assert {p.kind for p in params} == set(KINDS)


def topology(p: cabinet_params.CabinetParams, cells: list[Cell]) -> tuple[str, str]:
    """What stays the same when lengths change."""
    parts = (p.kind, p.mounting, p.stand, p.top, p.style, p.grip, p.runner)
    x = sorted({round(cell.cover.x0, 3) for cell in cells})
    divided = (f"{x.index(round(c.cover.x0, 3))}{c.leaf.kind}{c.leaf.inner}" for c in cells)
    return " ".join(parts), " ".join(divided)


def test_few_have_more_movers_than_seven() -> None:
    counts = [len(drafted(seed).joints) for seed in SEEDS]
    assert max(counts) <= 9
    assert np.mean(np.array(counts) <= 7) >= 0.8


def test_a_deeper_front_needs_a_wider_gap() -> None:
    """Bug prevented: the free corner of a thick narrow door swings into its neighbor."""
    p = next(s.params for s in map(drawn, SEEDS) if s.params.style == "slab" and has_door(s.params))
    thick = dataclasses.replace(p, front_thickness=0.06)
    assert cabinet_params.doors_clear_their_gap(p)
    assert not cabinet_params.doors_clear_their_gap(thick)


def has_door(p: cabinet_params.CabinetParams) -> bool:
    return any(cell.leaf.kind not in ("drawer", "open") for cell in cabinet_params.layout(p)[0])
