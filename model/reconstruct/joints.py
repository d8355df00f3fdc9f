"""Predicted joints made into joints that hold the house's promises: unit axes along the sides of
things where they nearly are, rest at one end or in the middle, positive motion opens.

Every change is told, so that a report can say what was seen and what was made of it.
"""

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from artgen.core.mesh import Floats
from model.reconstruct.guess import JointGuess

SNAP_DEG = 15.0
"""An axis nearer than this to an axis of the object is put on it: validators take less for a slip,
and things that are meant to be slanted are slanted more."""
SLIDE_SNAP_DEG = 25.0
"""The same of a slide. Of 199 slides of generated objects of ten categories none is slanted, and a
drawer that climbs by 18 degrees looks wrong."""
TWO_WAYS = 0.35
"""Share of its range that a joint goes backward at least, if it rests in the middle."""
LEAST_TURN = 0.1
"""rad; twice the least that validators take for a joint."""
HARDLY = 0.02
"""Share of its range by which a joint may go beyond rest without a word."""
ENDLESS = 0.97
"""Share of a full turn beyond which a joint has no ends: wheels, dials, turntables."""
LEAST_SLIDE = 0.004
"""m; the way of a button."""


@dataclass(frozen=True, kw_only=True, eq=False)
class CleanJoint:
    """A joint as it will be stated; m and rad, zero at the sphere's middle.

    Attributes:
        observed: (T,) q of the images' states, with the sign of the stated axis.
        changes: what was altered, a sentence each.
    """

    guess: JointGuess
    axis: Floats
    origin: Floats
    lower: float
    upper: float
    observed: Floats
    changes: tuple[str, ...]

    @property
    def endless(self) -> bool:
        """Whether it turns all around, so that it is stated as continuous."""
        turn = 2.0 * math.pi
        return self.guess.type == "revolute" and self.upper - self.lower >= ENDLESS * turn


def clean_joint(guess: JointGuess) -> CleanJoint:
    """The joint as it can be stated."""
    changes: list[str] = []
    near = SLIDE_SNAP_DEG if guess.type == "prismatic" else SNAP_DEG
    axis = snapped(guess.axis, changes, near=near)
    lower, upper = reached(guess, changes)
    observed = guess.observed
    if -lower > upper:
        axis, lower, upper, observed = -axis, -upper, -lower, -observed
        changes.append("its axis was turned around, so that positive motion opens")
    lower, upper = rested(guess, lower, upper, changes)
    return CleanJoint(
        guess=guess,
        axis=axis + 0.0,
        origin=guess.origin,
        lower=lower,
        upper=upper,
        observed=observed.clip(lower, upper),
        changes=tuple(changes),
    )


def reached(guess: JointGuess, changes: list[str]) -> tuple[float, float]:
    """Ends that hold the predicted ones, rest, and all states of the images."""
    first, last = sorted((guess.lower, guess.upper))
    lower = min(0.0, first, *guess.observed.tolist())
    upper = max(0.0, last, *guess.observed.tolist())
    if first == last:
        changes.append("no limits were predicted for it; it goes as far as the images show")
    elif max(first - lower, upper - last) > HARDLY * (upper - lower):
        changes.append(
            f"its predicted way from {first:.4g} to {last:.4g} was widened to {lower:.4g} and "
            f"{upper:.4g}, so that it holds rest and what the images show"
        )
    return lower, upper


def snapped(axis: Floats, changes: list[str], *, near: float) -> Floats:
    """A unit axis; a coordinate axis where it is within `near` degrees of one."""
    length = float(np.linalg.norm(axis))
    if not length > 1e-6:
        changes.append("its axis has no direction; the vertical stands for it")
        return np.array([0.0, 0.0, 1.0])
    unit = axis / length
    along = int(np.argmax(np.abs(unit)))
    off = math.degrees(math.acos(min(1.0, float(abs(unit[along])))))
    if off > near:
        return np.asarray(unit / np.linalg.norm(unit))
    if off > 0.0:
        changes.append(f"its axis was {off:.1f} degrees off {'xyz'[along]} and was put on it")
    return np.asarray(np.eye(3)[along] * math.copysign(1.0, unit[along]))


def rested(
    guess: JointGuess, lower: float, upper: float, changes: list[str]
) -> tuple[float, float]:
    """Ends with rest at the lower one, or in the middle of what goes both ways."""
    least = LEAST_TURN if guess.type == "revolute" else LEAST_SLIDE
    if upper < least:
        changes.append(f"its way of {upper:.4g} was widened to {least:g}")
        upper = least
    if guess.type == "revolute" and upper > 2.0 * math.pi:
        changes.append(f"its way of {upper:.4g} rad was cut to one turn")
        upper = 2.0 * math.pi
    if -lower >= TWO_WAYS * (upper - lower):
        both = max(-lower, upper)
        if guess.type == "revolute":
            both = min(both, math.pi)
        if both != -lower or both != upper:
            changes.append(f"it goes both ways; its ends were set to -{both:.4g} and {both:.4g}")
        return -both, both
    if lower < -HARDLY * (upper - lower):
        changes.append(f"the {-lower:.4g} by which it went beyond rest were cut off")
    return 0.0, upper


def parents_first(joints: Sequence[CleanJoint]) -> list[CleanJoint]:
    """Joints in an order in which parents come before children; a circle is broken at the base."""
    placed, ordered, waiting = {0}, [], list(joints)
    while waiting:
        ready = [j for j in waiting if j.guess.parent in placed] or [_rebased(waiting[0])]
        slots = {joint.guess.slot for joint in ready}
        ordered += ready
        placed |= slots
        waiting = [joint for joint in waiting if joint.guess.slot not in slots]
    return ordered


def _rebased(joint: CleanJoint) -> CleanJoint:
    guess = dataclasses.replace(joint.guess, parent=0)
    changes = (*joint.changes, "its parent moved with it in a circle; it hangs on the base")
    return dataclasses.replace(joint, guess=guess, changes=changes)
