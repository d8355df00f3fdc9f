"""More states than a network was trained on: it is asked about groups of them that share the first,
and one answer is completed by what the others say of the states that it has not seen.

T states of the capture, P part slots.
"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from scipy.optimize import linear_sum_assignment
from torch import Tensor

from model.batch import FIXED, Articulation
from model.network.prediction import Prediction


@dataclass(frozen=True, kw_only=True, eq=False)
class Answer:
    """What the network said of one object in some states.

    Attributes:
        states: their places in the capture, ascending, as many as the prediction has.
    """

    states: tuple[int, ...]
    prediction: Prediction


def state_groups(states: int, together: int) -> list[tuple[int, ...]]:
    """Groups of `together` of the T states, which have the first in common and all states among
    them; one group of all where they are no more than that."""
    if states <= together:
        return [tuple(range(states))]
    others = together - 1
    if not others:
        return [(state,) for state in range(states)]
    starts = [*range(1, states - others, others), states - others]
    return [(0, *range(start, start + others)) for start in starts]


def completed(lead: Answer, answers: Sequence[Answer], states: int) -> Prediction:
    """The lead's prediction with a motion in every state of the capture.

    A state that the lead has not seen is read from the first answer that has; its parts are matched
    to the lead's by their boxes at rest. Where the two disagree on how a part moves, the mean of
    the lead's own states stands for it.
    """
    own = lead.prediction.articulation
    motion_TP = own.motion_BTP.new_zeros(states, own.motion_BTP.shape[2])
    for state in range(states):
        teller = next(answer for answer in (lead, *answers) if state in answer.states)
        said = teller.prediction.articulation
        word_P = said.motion_BTP[0, teller.states.index(state)]
        motion_TP[state] = word_P if teller is lead else in_terms_of(own, said, word_P)
    return dataclasses.replace(
        lead.prediction, articulation=dataclasses.replace(own, motion_BTP=motion_TP[None])
    )


def in_terms_of(own: Articulation, said: Articulation, word_P: Tensor) -> Tensor:
    """(P,) motions that another articulation states, for the parts of our own."""
    found_P = own.motion_BTP[0].mean(dim=0)
    for slot, other in matched_slots(own, said):
        if own.type_BP[0, slot] == said.type_BP[0, other]:
            along = float(own.axis_BP3[0, slot] @ said.axis_BP3[0, other])
            found_P[slot] = word_P[other] if along >= 0.0 else -word_P[other]
    return found_P


def matched_slots(own: Articulation, said: Articulation) -> list[tuple[int, int]]:
    """Pairs of moving slots whose boxes at rest are nearest to each other, all together."""
    slots, others = (
        torch.nonzero(articulation.type_BP[0] != FIXED).flatten().tolist()
        for articulation in (own, said)
    )
    cost = torch.cdist(_boxes(own, slots), _boxes(said, others))
    rows, columns = linear_sum_assignment(np.asarray(cost.cpu()))
    return [(slots[row], others[column]) for row, column in zip(rows, columns, strict=True)]


def _boxes(articulation: Articulation, slots: list[int]) -> Tensor:
    """(N, 6) middles and sizes."""
    both = torch.cat([articulation.center_BP3[0], articulation.size_BP3[0]], dim=-1)
    return both[slots].double()
