"""States of joints fitted to the silhouettes, a step at a time.

Networks see a few small images; the capture may hold more. Each state of each joint is moved up and
down by ever smaller steps, and moves that make the silhouettes agree better are kept. Boxes stay as
they are predicted: silhouettes of closed cases hardly tell where one part ends and the next begins,
and boxes that are moved until they agree better are farther from the truth (docs/reconstruct.md).
"""

import dataclasses

import numpy as np

from model.reconstruct.guess import ObjectGuess
from model.reconstruct.outlines import Outlines, Silhouettes

STEPS = (0.06, 0.03, 0.015, 0.0075)
"""By which slides move, radii, and what turns, full turns."""
WORTH = 5e-4
"""Mean IoU that a step must gain."""


def refined(guess: ObjectGuess, seen: Silhouettes) -> ObjectGuess:
    """The guess in the states in which its silhouettes agree best with those that were seen."""
    outlines = Outlines(guess, seen)
    start = best = outlines.agreement(guess)
    first = guess
    for step in STEPS:
        for place, state in np.ndindex(len(guess.joints), len(seen.mask)):
            for sign in (1.0, -1.0):
                tried = moved(guess, place, state, sign * step)
                value = outlines.agreement(tried)
                if value > best + WORTH:
                    guess, best = tried, value
                    break
    if guess is first:
        return guess
    text = (
        f"states were fitted to the silhouettes, which agree to {best:.2f} now, to {start:.2f} "
        "before"
    )
    return dataclasses.replace(guess, told=(*guess.told, (0, text)))


def moved(guess: ObjectGuess, place: int, state: int, step: float) -> ObjectGuess:
    """The guess with a joint farther open by a step in one state."""
    joint = guess.joints[place]
    observed = joint.observed.copy()
    observed[state] += step * (guess.radius if joint.type == "prismatic" else 2.0 * np.pi)
    joints = list(guess.joints)
    joints[place] = dataclasses.replace(joint, observed=observed)
    return dataclasses.replace(guess, joints=tuple(joints))
