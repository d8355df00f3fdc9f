"""L5: hollows stay open to hands, and moving parts can be got at."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import open_state, required_state, travel
from artgen.articulation.types import Joint, State
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply
from artgen.validate.bounds import Bound
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.report import Finding, Note
from artgen.validate.subject import Subject

POINTS = 6000
"""In a part's box, as even as a grid but on no common plane with its walls."""
EVEN = 1.2207440846057596
"""Root of x^4 = x + 1; multiples of its powers fill a cube evenly (Roberts 2018, R3 sequence)."""
HOLDERS = ("base", "drawer", "rack", "tray", "bin", "basket", "drum")
"""Labels of parts that things are put into; of a stranger's parts, each that is hollow."""
HAND = 0.04
"""m; what is narrower is a gap between wires or the recess of a panel, and no hollow for hands."""
ENCLOSED = (4, 5)
"""How many of six directions along the axes meet the part: an open box shows five, a shelf four; a
cavity that shows six is of no use to hands."""
WAYS = np.concatenate([np.eye(3), -np.eye(3)])
LOOKS = np.array(
    [(0, 1, 0), (0, -1, 0), (1, 0, 0), (-1, 0, 0), (0, 0, -1), (0, 1, -1), (0, 2, -1)], float
)
"""From the front, the back, both sides, above, and as one looks down who stands before it."""
WINDOW = 64
"""Rays a side of the object in each of these directions."""


@dataclass(frozen=True, kw_only=True)
class Interior:
    """The hollow of one part that hands get into.

    Attributes:
        part: its name.
        volume: of what the visual mesh leaves open, m3.
        open: share of it that contact pieces leave open too.
    """

    part: str
    volume: float
    open: float

    def __str__(self) -> str:
        return (
            f"{self.part}: {self.open:.1%} of a hollow of {1000.0 * self.volume:.3g} l is open to "
            "contact"
        )


def own_interiors(subject: BundleSubject) -> Iterator[Finding | Note]:
    """What one sees room for has room, in every container; how much is noted."""
    foreign, bounds = subject.origin.foreign, subject.bounds
    yield from _judged(subject, bounds.open_interior_foreign if foreign else bounds.open_interior)


def foreign_interiors(subject: Subject) -> Iterator[Finding | Note]:
    """Contact pieces leave half of every hollow open at least."""
    yield from _judged(subject, subject.bounds.open_interior_foreign)


def _judged(subject: Subject, bound: Bound) -> Iterator[Finding | Note]:
    for interior in open_interiors(subject):
        yield Note(name="semantics.interior", text=str(interior))
        if not interior.open >= bound.value:
            yield Finding(
                check="semantics.interior",
                part=interior.part,
                value=interior.open,
                bound=bound.at_least(),
                cause="contact pieces fill the hollow that is seen",
                remedy="author a piece for each wall instead of one hull around all",
            )


def open_interiors(subject: Subject) -> Iterator[Interior]:
    """Of every part that is a container: whose hollow takes enough of its box."""
    bounds = subject.bounds
    ours = subject.lacks("manifest") is None
    holders = {p.name for p in subject.parts if p.label in HOLDERS or not ours}
    for part, pieces in subject.collision.items():
        if part not in subject.meshes or part not in holders:
            continue
        hollow = hollow_points(subject.meshes[part])
        if len(hollow) < bounds.hollow_least.value * POINTS:
            continue
        box = float(np.prod(np.diff(subject.boxes[part], axis=0)))
        filled = float(inside_any(hollow, pieces, bounds.gap_slack.value).mean())
        yield Interior(part=part, volume=box * len(hollow) / POINTS, open=1.0 - filled)


def hollow_points(mesh: TriMesh) -> Floats:
    """(N, 3) of `POINTS` points in the mesh's box: those that lie in the open, but with the mesh
    around, and with room for a hand before or behind them along each axis."""
    lower, upper = mesh.bounds
    shares = np.arange(1, POINTS + 1)[:, None] / EVEN ** np.arange(1, 4)
    points = lower + (0.5 + shares) % 1.0 * (upper - lower)
    origins, ways = np.repeat(points, 6, axis=0), np.tile(WAYS, (len(points), 1))
    hit = _first_hits(mesh.triangles, origins, ways)
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    met = (hit >= 0).reshape(-1, 6)
    facing = np.einsum("ij,ij->i", normals[hit], ways)
    solid = (met & (facing.reshape(-1, 6) > 0.0)).sum(axis=1) > 3
    reach = np.einsum("ij,ij->i", a[hit] - origins, normals[hit])
    with np.errstate(divide="ignore", invalid="ignore"):
        away = np.where(met, (reach / facing).reshape(-1, 6), np.inf)
    edge = np.concatenate([upper - points, points - lower], axis=1)
    clear = np.fmin(away, edge)
    roomy = (clear[:, :3] + clear[:, 3:] >= HAND).all(axis=1)
    return np.asarray(points[np.isin(met.sum(axis=1), ENCLOSED) & ~solid & roomy])


def _first_hits(triangles: Floats, origins: Floats, ways: Floats) -> NDArray[np.intp]:
    """(N,) the triangle that each ray meets first, or -1."""
    scene = EmbreeScene()
    TriangleMesh(scene, np.asarray(triangles, np.float32))
    return np.asarray(scene.run(origins.astype(np.float32), ways.astype(np.float32)), np.intp)


def inside_any(points: Floats, pieces: Sequence[TriMesh], margin: float) -> NDArray[np.bool_]:
    """(N,) whether each point lies inside one of some convex pieces, by more than `margin` m."""
    found = np.zeros(len(points), bool)
    for piece in pieces:
        a, b, c = piece.triangles.transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True).clip(min=1e-300)
        reach = np.einsum("ij,ij->i", normal, a)
        found |= (points @ normal.T <= reach - margin).all(axis=1)
    return found


def within_reach(subject: Subject) -> Iterator[Finding]:
    """Every moving part shows itself from outside: at rest, or when what bars it stands open."""
    joints, rules = subject.joints, subject.passages
    states: list[State] = [{}, open_state(joints, rules)]
    states += [required_state(joint.name, rules) for joint in joints]
    states += [_carriers_open(joint, joints) for joint in joints]  # A bolt in an open door's edge.
    seen: set[str] = set()
    for state in {tuple(sorted(state.items())): state for state in states}.values():
        view = View.at(subject, state)
        seen |= view.seen(None)
        for part in view.names:
            if part not in seen:  # It may be smaller than rays over the whole object are apart.
                seen |= view.seen(part) & {part}
    for joint in joints:
        if joint.child in subject.meshes and joint.child not in seen:
            yield Finding(
                check="semantics.reach",
                part=joint.child,
                joint=joint.name,
                value="not seen from any side",
                bound="seen at rest, or with the joints that bar it open",
                cause="a hand cannot get at it",
                remedy="leave an opening before it, or state what has to be opened first",
            )


def _carriers_open(joint: Joint, joints: Sequence[Joint]) -> State:
    """What carries a joint wide open, itself at rest."""
    above = {other.child: other for other in joints}
    state: dict[str, float] = {}
    while joint.parent in above:
        joint = above[joint.parent]
        state[joint.name] = travel(joint)[1]
    return state


@dataclass(frozen=True, kw_only=True, eq=False)
class View:
    """An object at a state, seen by parallel rays along `LOOKS`.

    Attributes:
        names: of the parts.
        triangles: (T, 3, 3) of all parts, m.
        owner: (T,) the part of each.
    """

    names: tuple[str, ...]
    triangles: Floats
    owner: NDArray[np.intp]

    @classmethod
    def at(cls, subject: Subject, state: State) -> "View":
        """Every part where it is at a state."""
        poses = forward_kinematics(subject.parts[0].name, subject.joints, state)
        placed = [apply(poses[name], mesh.triangles) for name, mesh in subject.meshes.items()]
        return cls(
            names=tuple(subject.meshes),
            triangles=np.concatenate(placed),
            owner=np.repeat(np.arange(len(placed)), [len(t) for t in placed]),
        )

    def seen(self, part: str | None) -> set[str]:
        """Parts that rays meet first, spread over the object or over one part alone."""
        whole = self.triangles
        shown = whole if part is None else whole[self.owner == self.names.index(part)]
        start = float(np.linalg.norm(whole, axis=2).max()) + 1.0
        steps = (np.arange(WINDOW) + 0.5) / WINDOW
        origins, ways = [], []
        for way in LOOKS / np.linalg.norm(LOOKS, axis=1, keepdims=True):
            side = np.cross(way, np.eye(3)[np.argmin(np.abs(way))])
            across = np.stack([side, np.cross(way, side)]) / np.linalg.norm(side)
            low, high = (shown @ across.T).min(axis=(0, 1)), (shown @ across.T).max(axis=(0, 1))
            u, v = np.meshgrid(*(low[:, None] + (high - low)[:, None] * steps), indexing="ij")
            places = np.stack([u.ravel(), v.ravel()], axis=1)
            origins.append(places @ across - start * way)
            ways.append(np.tile(way, (WINDOW * WINDOW, 1)))
        hit = _first_hits(whole, np.concatenate(origins), np.concatenate(ways))
        return {self.names[k] for k in np.unique(self.owner[hit[hit >= 0]]).tolist()}
