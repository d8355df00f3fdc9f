"""Whether parts of an assembled object pass through each other, exactly, on all of their ways."""

from collections.abc import Mapping, Sequence

from artgen.articulation.types import Joint, Precondition
from artgen.assembly.piece import Piece
from artgen.geometry.clearance import shape_of_mesh
from artgen.validate.bounds import shipped_bounds
from artgen.validate.sweep import crossings


def clashing(
    base: str,
    joints: Sequence[Joint],
    preconditions: Sequence[Precondition],
    pieces: Mapping[str, Piece],
) -> tuple[str, str] | None:
    """Two parts that share more than validation allows, at rest or on the way of a joint (21 poses
    each, with what it needs open); None where all are clear."""
    allowed = shipped_bounds().overlap.value
    shapes = {name: shape_of_mesh(piece.mesh) for name, piece in pieces.items()}
    for crossing in crossings(base, joints, preconditions, shapes):
        if crossing.overlap.volume > allowed:
            return crossing.overlap.first, crossing.overlap.second
    return None
