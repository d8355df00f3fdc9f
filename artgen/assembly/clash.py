"""Whether parts of an assembled object pass through each other, exactly, on all of their ways."""

from collections.abc import Mapping, Sequence

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Joint, Precondition
from artgen.assembly.piece import Piece, joined
from artgen.assembly.source import Source
from artgen.geometry.clearance import Mover, Shape, overlaps, shape_of_mesh
from artgen.validate.bounds import shipped_bounds
from artgen.validate.sweep import crossings

MORE_OPEN = 1.25
"""Factor by which parts that are all open at once may share more than the template's own do."""
Pair = tuple[str, str]


def clashing(
    base: str,
    joints: Sequence[Joint],
    preconditions: Sequence[Precondition],
    pieces: Mapping[str, Piece],
    open_before: Mapping[Pair, float],
) -> Pair | None:
    """Two parts that share more than validation allows, at rest or on the way of a joint (21 poses
    each, with what it needs open), or more than the template's own (`open_before`, m3) with all
    open; None where all are clear."""
    allowed = shipped_bounds().overlap.value
    shapes = {name: shape_of_mesh(piece.mesh) for name, piece in pieces.items()}
    for crossing in crossings(base, joints, preconditions, shapes):
        if crossing.overlap.volume > allowed:
            return crossing.overlap.first, crossing.overlap.second
    for pair, volume in open_overlaps(base, joints, shapes).items():
        if volume > more_open(open_before.get(pair, 0.0)):
            return pair
    return None


def more_open(volume: float) -> float:
    """What two parts may share with all open whose like in the template share `volume`, m3."""
    return MORE_OPEN * volume + shipped_bounds().overlap.value


def open_overlaps(
    base: str, joints: Sequence[Joint], shapes: Mapping[str, Shape]
) -> dict[Pair, float]:
    """Pairs of parts and what they share with every joint at its upper end, m3."""
    state = {j.name: j.limit.upper for j in joints if j.limit is not None and j.mimic is None}
    poses = forward_kinematics(base, joints, state)
    movers = [Mover(name=n, shape=shape, poses=poses[n][None]) for n, shape in shapes.items()]
    found: dict[Pair, float] = {}
    for overlap in overlaps(movers):
        first, second = sorted((overlap.first, overlap.second))
        found[first, second] = max(found.get((first, second), 0.0), overlap.volume)
    return found


def template_open(template: Source) -> dict[Pair, float]:
    """`open_overlaps` of a template's own parts."""
    shapes = {m.name: shape_of_mesh(joined(m.pieces).mesh) for m in template.members}
    shapes[template.base_name] = shape_of_mesh(template.base.mesh)
    return open_overlaps(template.base_name, template.joints, shapes)
