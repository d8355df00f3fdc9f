"""How well a prediction agrees with the silhouettes, before anything is mended: guesses are ranked
by it, and where a part's field agrees worse than its predicted box, the box stands for it.
"""

import dataclasses
from collections.abc import Mapping

import numpy as np

from model.reconstruct.guess import ObjectGuess, PartGuess
from model.reconstruct.outlines import Outlines, Silhouettes, overlap
from model.reconstruct.shapes import boxed

BETTER = 0.01
"""By how much a part's box must agree better than its field, mean IoU of all images."""


def agreement(guess: ObjectGuess, seen: Silhouettes) -> float:
    """Mean IoU of the silhouettes of a guess, moved as it says, with those that were seen."""
    return Outlines(guess, seen).agreement(guess)


def agreeing(guess: ObjectGuess, seen: Silhouettes) -> ObjectGuess:
    """The guess with boxes for parts where boxes agree better.

    Fields as a whole and boxes as a whole are compared first; then each part, the largest first,
    may be the other of the two.
    """
    fields = {part.slot: part for part in guess.parts}
    boxes = {part.slot: boxed(part) for part in guess.parts}
    outlines = {
        part: mask
        for own in (guess, _of(guess, boxes))
        for part, mask in zip(own.parts, Outlines(own, seen).of(own), strict=True)
    }

    def value_of(parts: Mapping[int, PartGuess]) -> float:
        return overlap([outlines[part] for part in parts.values()], seen)

    with_fields, with_boxes = value_of(fields), value_of(boxes)
    best, chosen, others = with_fields, fields, boxes
    if with_boxes > with_fields + BETTER:
        best, chosen, others = with_boxes, boxes, fields
    for slot in sorted(fields, key=lambda slot: -float(np.ptp(fields[slot].box, axis=0).prod())):
        tried = {**chosen, slot: others[slot]}
        value = value_of(tried)
        if value > best + BETTER:
            best, chosen = value, tried
    text = (
        "a rounded box of the predicted size stands for its field; silhouettes agree to "
        f"{best:.2f} so, to {with_fields:.2f} by fields alone"
    )
    told = [(slot, text) for slot in chosen if chosen[slot].boxed and not fields[slot].boxed]
    return dataclasses.replace(_of(guess, chosen), told=(*guess.told, *told))


def _of(guess: ObjectGuess, parts: Mapping[int, PartGuess]) -> ObjectGuess:
    return dataclasses.replace(guess, parts=tuple(parts[part.slot] for part in guess.parts))
