"""A prediction fitted to the silhouettes: sides of boxes and states of joints, a step at a time.

Networks see a few small images; the capture may hold more and sharper ones. Each number is moved
up and down by ever smaller steps, and moves that make the silhouettes agree better are kept.
"""

import dataclasses

import numpy as np

from artgen.core.mesh import Floats
from model.reconstruct.guess import ColorAt, JointGuess, ObjectGuess, PartGuess
from model.reconstruct.outlines import Outlines, Silhouettes
from model.reconstruct.shapes import LEAST_SIDE

STEPS = (0.06, 0.03, 0.015)
"""Radii by which sides of boxes and slides move, and in full turns what turns."""
MANY = 5
"""Parts from which the last round is left out."""
FARTHEST = 0.16
"""Radii that a side of a box may leave its place by."""
MOST_SUNK = 0.05
"""Share of the smaller of two boxes by which moving a side may let them sink into each other."""
WORTH = 0.002
"""Mean IoU that a step must gain."""


def refined(guess: ObjectGuess, seen: Silhouettes) -> ObjectGuess:
    """The guess moved to where its silhouettes agree best with those that were seen."""
    outlines = Outlines(guess, seen)
    start = best = outlines.agreement(guess)
    first = guess
    for step in STEPS if len(guess.parts) < MANY else STEPS[:-1]:
        for change in range(count_of(guess)):
            for sign in (1.0, -1.0):
                tried = changed(guess, first, change, sign * step)
                value = best if tried is None else outlines.agreement(tried)
                if tried is not None and value > best + WORTH:
                    guess, best = tried, value
                    break
    if guess is first:
        return guess
    text = (
        f"sides of boxes and states were fitted to the silhouettes, which agree to {best:.2f} now, "
        f"to {start:.2f} before"
    )
    return dataclasses.replace(guess, told=(*guess.told, (0, text)))


def count_of(guess: ObjectGuess) -> int:
    """How many numbers can be moved: six sides a part, a q for each joint and state."""
    states = len(guess.joints[0].observed) if guess.joints else 0
    return states * len(guess.joints) + 6 * len(guess.parts)


def changed(guess: ObjectGuess, first: ObjectGuess, change: int, step: float) -> ObjectGuess | None:
    """The guess with one number moved by a step; None where it may not go there."""
    states = len(guess.joints[0].observed) if guess.joints else 0
    if change < states * len(guess.joints):
        place, state = divmod(change, states)
        joints = list(guess.joints)
        joints[place] = _moved_state(joints[place], state, step, guess.radius)
        return dataclasses.replace(guess, joints=tuple(joints))
    place, side = divmod(change - states * len(guess.joints), 6)
    part = _moved_side(guess.parts[place], side, step * guess.radius)
    off = np.abs(part.box - first.parts[place].box).max()
    if off > FARTHEST * guess.radius or np.ptp(part.box, axis=0).min() < LEAST_SIDE:
        return None
    if sunk(part, place, guess) > sunk(first.parts[place], place, first) + MOST_SUNK:
        return None
    parts = list(guess.parts)
    parts[place] = part
    return dataclasses.replace(guess, parts=tuple(parts))


def sunk(part: PartGuess, place: int, guess: ObjectGuess) -> float:
    """The largest share of the smaller of two boxes, a part's and another's, that the two share."""
    most, own = 0.0, float(np.ptp(part.box, axis=0).prod())
    for k, other in enumerate(guess.parts):
        lower = np.maximum(part.box[0], other.box[0])
        upper = np.minimum(part.box[1], other.box[1])
        least = min(own, float(np.ptp(other.box, axis=0).prod()))
        if k != place and least > 0.0:
            most = max(most, float((upper - lower).clip(min=0.0).prod()) / least)
    return most


def _moved_state(joint: JointGuess, state: int, step: float, radius: float) -> JointGuess:
    observed = joint.observed.copy()
    observed[state] += step * (radius if joint.type == "prismatic" else 2.0 * np.pi)
    return dataclasses.replace(joint, observed=observed)


def _moved_side(part: PartGuess, side: int, step: float) -> PartGuess:
    """The part stretched so that one side of its box moves by a step, m."""
    end, axis = divmod(side, 3)
    box = part.box.copy()
    box[end, axis] += step
    if not box[0, axis] < box[1, axis]:
        return dataclasses.replace(part, box=box)
    scale = np.ptp(box, axis=0) / np.maximum(np.ptp(part.box, axis=0), LEAST_SIDE)
    moved = box[0] + (part.vertices - part.box[0]) * scale
    return dataclasses.replace(
        part, box=box, vertices=moved, shade=_stretched(part.shade, part.box[0], box[0], scale)
    )


def _stretched(
    shade: ColorAt | None, before: Floats, after: Floats, scale: Floats
) -> ColorAt | None:
    """The color of a part that was stretched."""
    if shade is None:
        return None
    return lambda points: shade(before + (points - after) / scale)
