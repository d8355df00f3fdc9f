"""Laws of laptops, over 30 seeds."""

import math
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from artgen.articulation.canonical import canonicalize
from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Body, Draft, DraftPart
from artgen.core.conventions import GRAVITY
from artgen.core.stream import Stream
from artgen.core.transform import apply
from artgen.finish import settle_overlaps
from artgen.generators.kit.counterbalance import weighed
from artgen.generators.kit.laptop_layout import ASPECTS, STYLES, Layout
from artgen.generators.laptop import INVARIANTS, PARAMS, build
from artgen.geometry.clearance import Mover, overlaps, shape_of_solids
from artgen.geometry.solid import Solid, union
from artgen.rules import Sampled, load_rule, sample

SEEDS = range(30)
every_seed = pytest.mark.parametrize("index", SEEDS)
RULE = load_rule("laptop")
ROUNDING = 1e-12
"""m3; a cube of 0.1 mm: booleans of faces that just touch leave 1e-16 at most."""
EXACT = 1e-9
"""m; sums of a dozen numbers below 1 m are off by 1e-15; manifold3d keeps 1e-12 of the extent."""


@cache
def drawn(index: int) -> Sampled:
    return sample(RULE, Stream(5, "laptop", index), params_type=PARAMS, invariants=INVARIANTS)


@cache
def made(index: int) -> Draft:
    one = drawn(index)
    return canonicalize(build(one.params, one.surfaces))


def part(draft: Draft, name: str) -> DraftPart:
    return next(p for p in draft.parts if p.name == name)


def wearing(found: DraftPart, surface: str) -> list[Body]:
    return [body for body in found.bodies if body.surface == surface]


def upper(draft: Draft) -> float:
    limit = draft.joints[0].limit
    assert limit is not None
    return limit.upper


def swept(draft: Draft, shapes: dict[str, list[Solid]]) -> float:
    """m3 that base and lid share at worst, every 5 degrees from closed to fully open."""
    count = round(math.degrees(upper(draft)) / 5.0) + 1
    states = [{"hinge": float(q)} for q in np.linspace(0.0, upper(draft), count)]
    poses = [forward_kinematics("base", draft.joints, state) for state in states]
    movers = [
        Mover(
            name=name,
            shape=shape_of_solids(solids),
            poses=np.array([pose[name] for pose in poses]),
        )
        for name, solids in shapes.items()
    ]
    return max((overlap.volume for overlap in overlaps(movers)), default=0.0)


@every_seed
def test_sizes_and_mass_lie_in_the_bands(index: int) -> None:
    draft = made(index)
    boxes = np.array([body.solid.bounds for p in draft.parts for body in p.bodies])
    width, depth, height = boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)
    mass = sum(weighed(settle_overlaps(p).bodies)[0] for p in draft.parts)
    found = {"width": width, "depth": depth, "height": height, "mass": mass}
    assert {name for name, value in found.items() if value not in RULE.bands[name]} == set()


@every_seed
def test_the_lid_meets_nothing_on_its_way(index: int) -> None:
    draft = made(index)
    shapes = {p.name: [body.solid for body in p.bodies] for p in draft.parts}
    assert swept(draft, shapes) <= ROUNDING


@every_seed
def test_collision_pieces_keep_apart_and_inside_their_part(index: int) -> None:
    """A piece may bridge a rounded edge: the nose's box stands below its curve by 0.6 of its rise,
    within the part's bounds."""
    draft = made(index)
    pieces = {p.name: [c for body in p.bodies for c in body.collision] for p in draft.parts}
    assert swept(draft, pieces) <= ROUNDING
    for p in draft.parts:
        boxes = np.array([body.solid.bounds for body in p.bodies])
        lower, highest = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
        for piece in pieces[p.name]:
            assert (piece.bounds[0] >= lower - EXACT).all()
            assert (piece.bounds[1] <= highest + EXACT).all()


@every_seed
def test_the_hinge_holds_the_lid_at_every_angle(index: int) -> None:
    """Friction exceeds the torque of gravity by a fifth, at angles 5 degrees apart, and a hand can
    open the lid."""
    draft = made(index)
    joint = draft.joints[0]
    mass, center = weighed(settle_overlaps(part(draft, "lid")).bodies)
    torques = []
    for q in np.radians(np.arange(0.0, math.degrees(upper(draft)) + 1e-9, 5.0)):
        pose = forward_kinematics("base", draft.joints, {"hinge": float(q)})["lid"]
        torques.append(abs(apply(pose, center)[1] - joint.origin[1]) * mass * GRAVITY)
    assert joint.friction >= 1.2 * max(torques)
    assert 0.5 <= joint.friction <= 5.0
    assert joint.effort > joint.friction + max(torques)


@every_seed
def test_barrels_turn_on_the_joints_axis(index: int) -> None:
    """Knuckles of both parts share the axis; along it they take turns and never overlap."""
    draft = made(index)
    at = Layout(drawn(index).params)
    _, y, z = draft.joints[0].origin
    spans = []
    for p in draft.parts:
        for body in wearing(p, "hinge"):
            core = body.collision[0].bounds
            assert np.abs(core.mean(axis=0)[1:] - (y, z)).max() < EXACT
            assert abs(body.solid.bounds[1, 1] - (y + at.radius)) < EXACT
            spans.append(tuple(core[:, 0]))
    spans.sort()
    assert all(b[0] - a[1] >= 0.0005 for a, b in pairwise(spans))
    assert abs(sum(a + b for a, b in spans)) < EXACT


@every_seed
def test_keys_are_apart_inside_the_well_and_below_the_palm_rest(index: int) -> None:
    draft = made(index)
    base = part(draft, "base")
    keys = wearing(base, "keys")
    assert 60 <= len(keys) <= 105
    boxes = np.array([body.solid.bounds for body in keys])
    gaps = np.maximum(
        boxes[:, None, 0, :2] - boxes[None, :, 1, :2], boxes[None, :, 0, :2] - boxes[:, None, 1, :2]
    ).max(axis=2)
    np.fill_diagonal(gaps, np.inf)
    assert gaps.min() >= drawn(index).params.key_gap - EXACT
    (floor,) = wearing(base, "keybed")[:1]
    lower, highest = floor.solid.bounds
    assert (boxes[:, 0, :2] > lower[:2] + 0.0005).all()
    assert (boxes[:, 1, :2] < highest[:2] - 0.0005).all()
    palm = max(body.solid.bounds[1, 2] for body in wearing(base, "deck"))
    assert (boxes[:, 1, 2] < palm - 0.0001).all()
    assert np.abs(boxes[:, 0, 2] - highest[2]).max() < EXACT


@every_seed
def test_seals_fill_the_gap_but_do_not_touch(index: int) -> None:
    draft = made(index)
    palm = max(body.solid.bounds[1, 2] for body in wearing(part(draft, "base"), "deck"))
    seals = [body.solid.bounds[0, 2] for body in wearing(part(draft, "lid"), "rubber")]
    assert np.abs(np.array(seals) - palm - 0.00015).max() < EXACT


@every_seed
def test_the_picture_has_the_size_its_diagonal_says_and_stands_upright(index: int) -> None:
    """Open, the image's up points up or back, never down, and it looks at the user."""
    draft, p = made(index), drawn(index).params
    (screen,) = wearing(part(draft, "lid"), "screen")
    assert screen.decal is not None
    width, height = screen.decal.size
    assert abs(math.hypot(width, height) - p.screen_inch * 0.0254) < EXACT
    assert abs(width / height - ASPECTS[p.aspect]) < 1e-12
    (surface,) = [s for s in draft.surfaces if s.name == "screen"]
    assert surface.tile == screen.decal.size
    pose = forward_kinematics("base", draft.joints, {"hinge": math.radians(100.0)})["lid"][:3, :3]
    assert (pose @ screen.decal.up)[2] > 0.9
    assert (pose @ np.cross(screen.decal.right, screen.decal.up))[1] < -0.9


@every_seed
def test_it_stands_on_rubber_feet_alone(index: int) -> None:
    base = part(made(index), "base")
    low = {body.surface: body.solid.bounds[0, 2] for body in base.bodies}
    feet = [body.solid.bounds for body in wearing(base, "rubber")]
    assert low.pop("rubber") == 0.0
    assert min(low.values()) >= 0.001 - EXACT
    assert len(feet) == (2 if drawn(index).params.feet == "strips" else 4)


@every_seed
def test_sockets_are_open_recesses_of_the_sides(index: int) -> None:
    """Every metal shell ends behind the case's side, and a hole of its width leads to it."""
    draft = made(index)
    base = part(draft, "base")
    shells = wearing(base, "port_metal")
    p = drawn(index).params
    assert len(shells) == min(p.ports_left, len(STYLES[p.style].ports)) + p.ports_right
    case = settle_overlaps(base).bodies[0].solid
    side = case.bounds[1, 0]
    for shell in shells:
        low, high = shell.solid.bounds
        assert max(-low[0], high[0]) < side - 0.0003
        middle = (low + high) / 2.0
        mouth = Solid(shell.solid.manifold).hull() - shell.solid
        assert (mouth & case).is_empty
        assert abs(middle[0]) > side - 0.004


def test_triangles_stay_within_the_budget() -> None:
    """Edges are rounded later, which adds some 2,000."""
    for index in SEEDS:
        bodies = [body for p in made(index).parts for body in p.bodies]
        assert sum(len(body.solid.trimesh().faces) for body in bodies) <= 11_000


def test_a_hundred_seeds_show_every_choice() -> None:
    """Each option that changes what there is appears at least once."""
    seen = {
        name: {getattr(drawn(i).params, name) for i in range(100)}
        for name in ("style", "hinge", "keyboard", "arrows", "pad", "speakers", "feet", "bezel",
                     "seal", "logo", "power")
    }  # fmt: skip
    for name, options in seen.items():
        assert options == set(RULE.draws[name].distribution.options), name  # type: ignore[attr-defined]
    counts = {tuple(len(p.bodies) for p in made(i).parts) for i in SEEDS}
    assert len(counts) >= 12


def test_larger_screens_make_heavier_laptops() -> None:
    """Means by size class: below 14, 14 to 16, above 16 inches."""
    masses: dict[str, list[float]] = {"small": [], "middle": [], "large": []}
    for index in SEEDS:
        inch = drawn(index).params.screen_inch
        size = "small" if inch < 14.0 else "middle" if inch <= 16.0 else "large"
        masses[size].append(sum(weighed(settle_overlaps(p).bodies)[0] for p in made(index).parts))
    small, middle, large = (float(np.mean(masses[k])) for k in ("small", "middle", "large"))
    assert small < middle < large


def test_the_base_leaves_room_for_what_turns() -> None:
    """Where a lid's knuckle lies, nothing of the base comes nearer than the designed play."""
    for index in SEEDS:
        draft = made(index)
        base = union(body.solid for body in part(draft, "base").bodies)
        for body in wearing(part(draft, "lid"), "hinge"):
            assert base.manifold.min_gap(body.solid.manifold, 0.002) >= 0.00055
