"""Scenes of a base and a mover, put together by hand."""

from artgen.articulation.types import Joint, JointType, Limit, Vector
from artgen.geometry.solid import Solid
from model.reconstruct.scene import Scene


def stated(
    part: str,
    kind: JointType,
    *,
    axis: Vector,
    origin: Vector = (0.0, 0.0, 0.0),
    upper: float,
    parent: str = "base",
) -> Joint:
    """A joint from rest to `upper`."""
    return Joint(
        name=f"{part}_joint",
        type=kind,
        parent=parent,
        child=part,
        axis=axis,
        origin=origin,
        limit=Limit(lower=0.0, upper=upper),
        friction=1.0,
        damping=0.0,
        effort=1.0,
    )


def scene_of(joint: Joint, **solids: Solid) -> Scene:
    """Parts by name, the base first, and one joint."""
    return Scene(solids=solids, joints=(joint,))
