"""Where an object's front is, if the camera file does not say: the network is asked about the
object turned about z by every step of a circle, and the turn of most merit counts.

Networks know objects whose front is -y, so from a wrong side their boxes and joints disagree with
the silhouettes; merit falls off over some 20 degrees to either side.
"""

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import inverted
from model.reconstruct.choice import chosen_views
from model.reconstruct.search import COMPARED, Question, in_states, merit
from model.reconstruct.sight import reposed
from model.reconstruct.states import state_groups

STEPS = 24
"""Turns of a circle that are tried."""
FINER = 2
"""Times that the step is halved about the best of them."""
CLEAR = 0.03
"""Merit by which the front must be better than what lies a quarter turn or more from it, to be told
without a doubt; agreement, 0 to 1."""
APART = math.pi / 2.0


@dataclass(frozen=True, kw_only=True)
class Front:
    """What was found.

    Attributes:
        turn: radians about z by which the world was turned, counterclockwise from above.
        lead: merit over that of the best front a quarter turn or more away.
    """

    turn: float
    lead: float


def faced(asked: Question) -> tuple[Question, Front]:
    """The question about the object with its front to -y, as far as the network can tell."""
    few = in_states(asked, state_groups(len(asked.capture.states), asked.config.data.states)[-1])
    front = best_turn(lambda turn: seen_so(turned(few, turn)))
    return turned(asked, front.turn), front


def best_turn(worth: Callable[[float], float]) -> Front:
    """The turn of most worth: the best of a circle's, then of ever nearer neighbors."""
    step = 2.0 * math.pi / STEPS
    tried = {k * step: worth(k * step) for k in range(STEPS)}
    best = max(tried, key=lambda turn: tried[turn])
    others = [value for turn, value in tried.items() if _between(turn, best) >= APART - 1e-9]
    lead = tried[best] - max(others)
    for _ in range(FINER):
        step /= 2.0
        for turn in (best - step, best + step):
            tried[turn] = worth(turn)
        best = max((best - step, best, best + step), key=lambda turn: tried[turn])
    return Front(turn=math.remainder(best, 2.0 * math.pi), lead=lead)


def _between(one: float, other: float) -> float:
    return abs(math.remainder(one - other, 2.0 * math.pi))


def seen_so(asked: Question) -> float:
    """Merit of what the network says of the views that it knows from there."""
    choice = chosen_views(asked.capture, asked.about, asked.config.data)
    return merit(asked, asked.about, (choice.views, *choice.others)[:COMPARED])


def turned(asked: Question, angle: float) -> Question:
    """The same question in a world that is turned about z."""
    turn = np.eye(4)
    turn[:3, :3] = axis_angle_matrix((0.0, 0.0, 1.0), angle)
    poses = asked.capture.camera_from_world @ inverted(turn)
    capture = dataclasses.replace(asked.capture, camera_from_world=poses)
    about = dataclasses.replace(asked.about, center=turn[:3, :3] @ asked.about.center)
    seen = dataclasses.replace(
        asked.seen,
        origins=asked.seen.origins @ turn[:3, :3].T,
        ways=asked.seen.ways @ turn[:3, :3].T,
    )
    return dataclasses.replace(
        asked,
        capture=capture,
        about=about,
        images=reposed(asked.images, capture, about),
        seen=seen,
    )


def told_front(front: Front) -> str:
    """What a user should know of a front that was not stated."""
    said = (
        "the camera file does not say where the object's front is: it was found "
        f"{abs(math.degrees(front.turn)):.0f} degrees {'right' if front.turn < 0.0 else 'left'} of "
        "where the first camera stands, as predictions agree best with the silhouettes from there"
    )
    if front.lead >= CLEAR:
        return said
    return (
        f"{said}, but hardly better than from another side; if the front is wrong, convert the "
        "cameras to our JSON with the front at -y"
    )
