"""What must hold of every assembled object, whatever its template and donors.

Numbers are those of the list in docs/assembly.md; what holds of a set of objects is in `variety`,
what holds of files is validation's.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.roles import ROLES
from artgen.articulation.types import Joint, State
from artgen.assembly.assemble import Assembled
from artgen.assembly.case import Case
from artgen.assembly.clash import more_open, open_overlaps, template_open
from artgen.assembly.evenness import density_by_part, density_by_surface
from artgen.assembly.looks import stuff_of
from artgen.assembly.piece import Piece, body_volumes, joined
from artgen.assembly.shape_hash import shape_hash, tree_hash
from artgen.assembly.source import Member, Side
from artgen.assembly.texels import STRETCH, stretch
from artgen.assembly.uv_fix import areas
from artgen.assembly.variation import LEAST_TRAVEL, may_shorten
from artgen.core.licence import most_restrictive
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.dataset.split import split_of
from artgen.geometry.clearance import shape_of_mesh
from artgen.geometry.distance import nearest_distance
from artgen.validate.bounds import shipped_bounds
from artgen.validate.mesh import repeated
from artgen.validate.sweep import crossings

BOX = 1e-6
"""Share of the diagonal by which a body's box may miss its slot's: ten steps of the vertex grid
on an object of 1 m."""
HINGE = 0.03
"""Share of a front's width that its axis may lie off the hinge side."""
KNUCKLE = 0.006
"""m; butt hinges turn about a knuckle beside the front."""
PARALLEL = np.cos(np.radians(0.1))
TOUCH = 0.002
"""Share of the diagonal between a handle and its front."""
LEAST = 0.005
"""Share by which another state may be more compact than rest."""
ENGAGED = 0.9
"""Share of its length that a drawer may travel."""
HELD = 0.1
"""Least share of a drawer's box inside the base's box when it is open."""
FLAT = 1e-14
"""m2; half of a square of the vertex grid."""
UNEVEN = 0.25
"""Greatest coefficient of variation of texel density over the faces of one material."""
RATIO = (0.8, 1.25)
"""Of the median texel density of a part to that of all parts."""
STATES = 9
OUT, UP = np.array([0.0, -1.0, 0.0]), np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, kw_only=True)
class Broken:
    """An invariant that does not hold."""

    number: int
    part: str
    value: str
    bound: str


def tree(case: Case) -> Iterator[Broken]:
    """1: the kinematic tree is the template's, with labels and kinds of joints."""
    names = {self.name: self.label for self in case.template.members}
    labels = {case.template.base_name: "base", **names}
    joints = case.template.joints
    found = case.new.hashes["tree"]
    if found != (wanted := tree_hash(labels, joints, case.template.base_name)):
        yield Broken(number=1, part="object", value=found, bound=wanted)


def finite(case: Case) -> Iterator[Broken]:
    """10: texture coordinates are numbers; one that is none breaks no bound. (A mesh refuses
    such vertices.)"""
    for name, piece in _named(case.new):
        if not np.isfinite(np.asarray(piece.mesh.uv)).all():
            yield Broken(number=10, part=name, value="not a number", bound="finite")


def boxes(case: Case) -> Iterator[Broken]:
    """2: the box of every fitted body is that of its slot, and what the template keeps is as it
    was."""
    bound = BOX * case.diagonal + 1e-7
    for member, _, body in case.filled:
        off = float(np.abs(body.bounds - member.body.bounds - case.shift).max())
        if off > bound:
            yield _broken(2, member, off, f"<= {bound:.2g} m")
    kept = {m.name: joined(m.pieces) for m in case.template.members if m.name not in case.new.seams}
    for name, own in {case.template.base_name: case.template.base, **kept}.items():
        off = float(np.abs(case.new.piece(name).bounds - own.bounds - case.shift).max())
        if off > bound:
            yield Broken(number=2, part=name, value=f"{off:.4g}", bound=f"<= {bound:.2g} m")


EDGES: Mapping[Side, tuple[int, int, int]] = {
    "left": (2, 0, 0),
    "right": (2, 0, 1),
    "bottom": (0, 2, 0),
    "top": (0, 2, 1),
    "rear": (0, 1, 1),
}
"""Where a part is hinged: along which axis, across which, and at which end of its box."""


def hinges(case: Case) -> Iterator[Broken]:
    """3: a hinge lies along the edge that it lay on, and opening moves the front outward, a lid
    up."""
    for member, joint, body in case.filled:
        if member.side not in EDGES:
            continue
        along, across, end = EDGES[member.side]
        width = float(np.ptp(body.bounds[:, across]))
        off = abs(joint.origin[across] - body.bounds[end, across])
        if off > HINGE * width + KNUCKLE or abs(joint.axis[along]) < PARALLEL:
            yield _broken(3, member, off, f"<= {HINGE * width + KNUCKLE:.3g} m, along the edge")
        way, named = (UP, "up") if member.side == "rear" else (OUT, "to -y")
        if joint.limit is None or _moved(body, joint, joint.limit.upper / 2.0) @ way <= 0.0:
            yield _broken(3, member, "opens inward", f"the middle of the front moves {named}")


def _moved(body: Piece, joint: Joint, q: float) -> Floats:
    """(3,) way that the middle of a body has gone at a state, m."""
    middle = body.bounds.mean(axis=0)[None]
    pose = forward_kinematics(joint.parent, [joint], {joint.name: q})[joint.child]
    return np.asarray((apply(pose, middle) - middle)[0])


def handles(case: Case) -> Iterator[Broken]:
    """4: a handle stands out before its front, touches it, lies within its sides and, on a door,
    on the half away from the hinge."""
    for member, _, body in case.filled:
        handle = case.new.layer(member.name, "handle")
        if handle is None:
            continue
        box, front = handle.bounds, body.bounds
        if (box[0, [0, 2]] < front[0, [0, 2]]).any() or (box[1, [0, 2]] > front[1, [0, 2]]).any():
            yield _broken(4, member, "wider than its front", "within the sides of its front")
        if box[0, 1] >= front[0, 1]:
            yield _broken(4, member, "does not stand out", "before the front")
        share = float((box[:, 0].mean() - front[0, 0]) / np.ptp(front[:, 0]))
        from_hinge = {"left": share, "right": 1.0 - share}.get(member.side, 1.0)
        if from_hinge < 0.5 - 1e-6:
            yield _broken(4, member, from_hinge, ">= 0.5 of the width from the hinge")
        gap = _gap(handle, body)
        if gap > TOUCH * case.diagonal:
            yield _broken(4, member, gap, f"<= {TOUCH * case.diagonal:.2g} m from its front")


def _gap(handle: Piece, body: Piece) -> float:
    """From the foot of a handle to the nearest point of its front, m."""
    points = handle.mesh.vertices
    foot = points[points[:, 1] > points[:, 1].max() - 1e-6]
    return min(nearest_distance(body.mesh.triangles, point) for point in foot)


def held(case: Case) -> Iterator[Broken]:
    """4: a front of which the template's had a handle has one, or an edge to grip, or a place where
    it is pushed open."""
    for member, _, _ in case.filled:
        slides = member.side == "along"
        bare = case.new.layer(member.name, "handle") is None
        if member.handle and bare and not slides and not case.new.piece(member.name).grips:
            yield _broken(
                4, member, "nothing to take hold of", "a handle, an edge or a place to push"
            )


def travels(case: Case) -> Iterator[Broken]:
    """17: every joint opens as far as the template's, or less by at most a fifth; one that others
    follow or wait for opens as far."""
    free = may_shorten(case.template)
    own = {joint.name: joint.limit for joint in case.template.joints}
    for joint in case.new.joints:
        was, now = own[joint.name], joint.limit
        if was is None or now is None or now == was:
            continue
        least = LEAST_TRAVEL if joint.name in free else 1.0
        if now.lower != was.lower or not least * was.upper <= now.upper <= was.upper:
            value, bound = f"{now.upper / was.upper:.3f}", f"{least} to 1 of the template's travel"
            yield Broken(number=17, part=joint.child, value=value, bound=bound)


def rest(case: Case) -> Iterator[Broken]:
    """5: rest is closed: no state of a joint makes the object's box smaller, and what closes opens
    one way."""
    pieces = {name: piece for name, _, piece in case.new.parts}
    labels = {name: label for name, label, _ in case.new.parts}
    for joint in case.new.joints:
        if joint.limit is None or joint.mimic is not None or not ROLES[labels[joint.child]].closes:
            continue
        if joint.limit.lower != 0.0:
            yield Broken(number=5, part=joint.child, value=f"{joint.limit.lower}", bound="from 0")
        states = np.linspace(joint.limit.lower, joint.limit.upper, STATES).tolist()
        volumes = [_volume(case.new, pieces, {joint.name: q}) for q in states]
        if min(volumes) < _volume(case.new, pieces, {}) * (1.0 - LEAST):
            yield Broken(number=5, part=joint.child, value="more compact open", bound="least at 0")


def _volume(new: Assembled, pieces: Mapping[str, Piece], state: State) -> float:
    """Of the box around all parts at a state, m3."""
    poses = forward_kinematics(new.parts[0][0], new.joints, state)
    corners = [apply(poses[name], piece.mesh.vertices) for name, piece in pieces.items()]
    points = np.concatenate(corners)
    return float(np.ptp(points, axis=0).prod())


def clear(case: Case) -> Iterator[Broken]:
    """6: parts do not pass through each other on the way of any joint, nor all open at once more
    than the template's own do."""
    allowed = shipped_bounds().overlap.value
    shapes = {name: shape_of_mesh(piece.mesh) for name, piece in _named(case.new)}
    base, joints = case.new.parts[0][0], case.new.joints
    for crossing in crossings(base, joints, case.new.preconditions, shapes):
        if crossing.overlap.volume > allowed:
            names = f"{crossing.overlap.first}, {crossing.overlap.second}"
            value = f"{crossing.overlap.volume:.3g} m3"
            yield Broken(number=6, part=names, value=value, bound=f"<= {allowed:g} m3")
    before = template_open(case.template)
    for pair, volume in open_overlaps(base, joints, shapes).items():
        if volume > more_open(before.get(pair, 0.0)):
            value, bound = f"{volume:.3g} m3", f"<= {more_open(before.get(pair, 0.0)):.3g} m3"
            yield Broken(number=6, part=", ".join(pair), value=value, bound=bound)


def engaged(case: Case) -> Iterator[Broken]:
    """7: what slides out stays in its rails."""
    for member, joint, _ in case.filled:
        if member.side != "out" or joint.limit is None:
            continue
        box = case.new.piece(member.name).bounds
        length = float(np.ptp(box[:, 1]))
        if joint.limit.upper > ENGAGED * length:
            yield _broken(7, member, joint.limit.upper / length, f"<= {ENGAGED} of its length")
        out = box + np.multiply(joint.limit.upper, joint.axis)
        base = case.new.parts[0][2].bounds
        shared = (np.minimum(out[1], base[1]) - np.maximum(out[0], base[0])).clip(min=0.0).prod()
        if shared < HELD * np.diff(box, axis=0).prod():
            yield _broken(7, member, float(shared), f">= {HELD} of its box within the base")


def sound(case: Case) -> Iterator[Broken]:
    """9: no triangle twice or without area, closed bodies outward, collision within the part."""
    reach = shipped_bounds().collision_reach.value
    for name, piece in _named(case.new):
        a, b, c = piece.mesh.triangles.transpose(1, 0, 2)
        least = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).min()) / 2.0
        if least < FLAT:
            yield Broken(number=9, part=name, value=f"{least:.2g} m2", bound=f">= {FLAT:g} m2")
        if count := repeated(piece.mesh.faces):
            yield Broken(number=9, part=name, value=f"{count} triangles twice", bound="0")
        closed = np.delete(body_volumes(piece.mesh), list(piece.shells))
        if closed.min(initial=np.inf) <= 0.0:
            yield Broken(number=9, part=name, value="a body winds inward", bound="outward")
        ends = np.array([c.bounds for c in piece.collision] or [piece.bounds])
        beyond = max((piece.bounds[0] - ends[:, 0]).max(), (ends[:, 1] - piece.bounds[1]).max())
        if beyond > reach:
            yield Broken(
                number=9, part=name, value=f"collision {beyond:.3g} m out", bound=f"<= {reach:g} m"
            )


def textured(case: Case) -> Iterator[Broken]:
    """10: texture is as dense on all faces of a material, on all parts, and no more stretched than
    on the donors."""
    for surface, spread in density_by_surface(case.new).items():
        if spread > UNEVEN:
            value, bound = f"{spread:.3f}", f"variation of density <= {UNEVEN}"
            yield Broken(number=10, part=surface, value=value, bound=bound)
    medians = density_by_part(case.new)
    middle = float(np.median(list(medians.values()) or [1.0]))
    for name, median in medians.items():
        if not RATIO[0] <= median / middle <= RATIO[1]:
            value, bound = f"{median / middle:.3f}", f"density {RATIO[0]} to {RATIO[1]} of others"
            yield Broken(number=10, part=name, value=value, bound=bound)
    for entry in case.new.given:
        donor = _donor(case, entry)
        body = case.new.layer(str(entry["part"]), "body")
        if body is None:
            continue
        weights = areas(donor.body.mesh.triangles)  # Faces are the same ones, in the same order.
        now, was = stretch(body.mesh, weights), stretch(donor.body.mesh, weights)
        if now > STRETCH * was:
            value, bound = f"{now:.3f}", f"stretch <= {STRETCH} x {was:.3f}"
            yield Broken(number=10, part=str(entry["part"]), value=value, bound=bound)


def kept_roles(case: Case) -> Iterator[Broken]:
    """11: panes stay panes and mirrors stay mirrors."""
    for entry in case.new.given:
        source, donor = case.sources[str(entry["source"])], _donor(case, entry)
        body = case.new.layer(str(entry["part"]), "body")
        if body is None:
            continue
        was = {stuff_of(source.surfaces[k]) for k in donor.body.slots} & {"glass", "mirror"}
        now = {stuff_of(case.new.surfaces[k]) for k in body.slots} & {"glass", "mirror"}
        if was != now:
            value, bound = str(sorted(now)), str(sorted(was))
            yield Broken(number=11, part=str(entry["part"]), value=value, bound=bound)


def licensed(case: Case) -> Iterator[Broken]:
    """15: every piece of every part names its source with its licence, and the licence of the whole
    is the most restrictive of them."""
    named = {(str(entry["part"]), str(entry["piece"])) for entry in case.new.sources}
    for part, piece in case.pieces:
        if (part, piece) not in named:
            yield Broken(number=15, part=part, value=f"its {piece} has no source", bound="a source")
    for entry in case.new.sources:
        own = case.sources[str(entry["source"])].licence.id
        if entry["licence"] != own:
            yield Broken(number=15, part=str(entry["part"]), value=entry["licence"], bound=own)
    used = {str(entry["source"]) for entry in case.new.sources} | {case.template.id}
    wanted = most_restrictive(case.sources[id].licence for id in used)
    if case.new.licence != wanted:
        yield Broken(number=15, part="object", value=case.new.licence.id, bound=wanted.id)


def held_out(case: Case) -> Iterator[Broken]:
    """16: template and donors are of one split, and what donors give is offered in that split."""
    used = {str(entry["source"]) for entry in case.new.sources} | {case.template.id}
    families = {case.sources[id].family for id in used}
    if missing := families - set(case.new.donors):
        value = f"{sorted(missing)} not listed"
        yield Broken(number=16, part="object", value=value, bound="every family among the donors")
    own = split_of("", case.new.donors)
    if own is None:
        yield Broken(number=16, part="object", value="two splits", bound="one split")
    for entry in case.new.sources:
        offered = None if entry["source"] == case.template.id else _offered(case, entry)
        if offered is not None and offered != own:
            value, bound = f"its {entry['piece']} is offered in {offered}", f"in {own} alone"
            yield Broken(number=16, part=str(entry["part"]), value=value, bound=bound)


def _offered(case: Case, entry: Mapping[str, object]) -> str:
    """The split that offers what an entry names; nowhere if none does."""
    donor = _donor(case, entry)
    if entry["piece"] == "handle" and donor.handle is not None:
        return case.handle_splits.get(shape_hash(donor.handle.mesh), "nowhere")
    return case.body_splits.get(shape_hash(donor.body.mesh), "nowhere")


def _broken(number: int, member: Member, value: float | str, bound: str) -> Broken:
    told = value if isinstance(value, str) else f"{value:.4g}"
    return Broken(number=number, part=member.name, value=told, bound=bound)


Check = Callable[[Case], Iterator[Broken]]
OF_OBJECTS: tuple[Check, ...] = (
    tree,
    boxes,
    hinges,
    handles,
    held,
    travels,
    rest,
    clear,
    engaged,
    sound,
    textured,
    kept_roles,
    licensed,
    held_out,
)


def broken(case: Case) -> list[Broken]:
    """All that does not hold of one object; nothing else is asked of one without numbers."""
    return list(finite(case)) or [found for check in OF_OBJECTS for found in check(case)]


def _named(new: Assembled) -> list[tuple[str, Piece]]:
    return [(name, piece) for name, _, piece in new.parts]


def _donor(case: Case, entry: Mapping[str, object]) -> Member:
    members = case.sources[str(entry["source"])].members
    return next(member for member in members if member.name == entry["of"])
