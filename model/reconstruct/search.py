"""What the network is asked about a capture, and which answer counts: the one whose boxes, moved as
it says, agree best with the silhouettes of all images.
"""

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch

from artgen.core.mesh import Floats
from model.batch import Articulation, Images
from model.config import Config
from model.infer import check_states, predict
from model.network.art import Art
from model.network.prediction import Prediction
from model.reconstruct.agreement import agreement
from model.reconstruct.capture import Capture
from model.reconstruct.choice import Choice
from model.reconstruct.guess import object_guess
from model.reconstruct.outlines import Silhouettes, silhouettes
from model.reconstruct.sight import Sphere, network_images, reposed
from model.reconstruct.sphere_fit import fitted, told_sphere
from model.reconstruct.states import Answer, completed, state_groups

JUDGED_PX = 48
"""Width and height of the silhouettes that predictions are judged by."""
COMPARED = 2
"""Sets of views by which a sphere is judged."""
COHERENCE = 0.1
"""What the likeness of answers counts beside their agreement. Of 40 random spheres around each of
seven held-out objects, agreement alone chose such that parts agree with the truth to a mean
generalized IoU of 0.02, with a tenth of likeness to 0.14 (likeness alone 0.09, the first 0.08
below zero, the true sphere 0.37)."""
FOREGROUND = 0.995
"""Share of the foreground that must see a sphere; a mask may have crumbs."""
TINY = 1e-12
"""Below the volume of any box, radii^3."""
MOST_LEADS = 4
"""Groups of states whose answers are completed and compared; all others only complete them."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Question:
    """A capture as a network reads it, to be asked about from any sphere; crops are made once.

    Attributes:
        parts: how many, base included; None asks the network.
        about: the sphere that images and silhouettes are about.
        images: all states and views at the network's size.
        seen: the silhouettes of all images.
    """

    art: Art
    config: Config
    parts: int | None
    capture: Capture
    about: Sphere
    images: Images
    seen: Silhouettes


@dataclass(frozen=True, kw_only=True, eq=False)
class Finding:
    """An answer, completed to all states.

    Attributes:
        agreement: mean IoU of its boxes with all silhouettes.
        views: that the network was shown.
        states: places in the capture of those that it was shown.
        sphere: that positions were divided by.
        seen: the silhouettes about that sphere.
    """

    agreement: float
    views: tuple[int, ...]
    states: tuple[int, ...]
    sphere: Sphere
    prediction: Prediction
    seen: Silhouettes


def question(
    art: Art, config: Config, capture: Capture, sphere: Sphere, *, parts: int | None
) -> Question:
    """What a network can be asked about a capture.

    Raises:
        ModelError: it has fewer states than the network was trained on.
    """
    check_states(config, len(capture.states))
    images = network_images(
        capture, sphere, size=config.data.input_px, background=config.data.background
    )
    judged = network_images(capture, sphere, size=JUDGED_PX, background="white")
    return Question(
        art=art,
        config=config,
        parts=parts,
        capture=capture,
        about=sphere,
        images=images,
        seen=silhouettes(judged, sphere.radius_m),
    )


def searched(asked: Question, choice: Choice) -> Finding:
    """The best answer about all sets of views that a choice offers, from where the camera file says
    the object is; where it does not, from the sphere of most merit.

    Raises:
        ModelError: the network cannot be asked so.
    """
    sphere, sets = asked.about, (choice.views, *choice.others)
    if not sphere.stated:
        few = in_states(
            asked, state_groups(len(asked.capture.states), asked.config.data.states)[-1]
        )
        sphere = fitted(
            sphere,
            lambda tried: merit(few, tried, sets[:COMPARED]) if holds(asked, tried) else -math.inf,
        )
    return best([found(asked, sphere, views) for views in sets])


def holds(asked: Question, sphere: Sphere) -> bool:
    """Whether a sphere can hold the object: rays that see foreground pass through it."""
    seen = seen_from(asked, sphere)
    ways = seen.ways / np.linalg.norm(seen.ways, axis=-1, keepdims=True)
    far = np.linalg.norm(np.cross(ways, seen.origins[:, :, None]), axis=-1)[seen.mask]
    return bool(np.quantile(far, FOREGROUND) <= sphere.radius_m)


def merit(asked: Question, sphere: Sphere, sets: Sequence[tuple[int, ...]]) -> float:
    """How well answers about some sets of views agree with the silhouettes, in the mean, and with
    those about the first set: from a wrong place, each set sees the object elsewhere."""
    findings = [found(asked, sphere, views) for views in sets]
    boxes = [boxes_of(finding.prediction.articulation) for finding in findings]
    alike = [box_likeness(boxes[0], others) for others in boxes[1:]]
    agreed = float(np.mean([finding.agreement for finding in findings]))
    return agreed + (COHERENCE * float(np.mean(alike)) if alike else 0.0)


def boxes_of(articulation: Articulation) -> Floats:
    """(P, 2, 3) lower and upper corners of all parts at rest, radii."""
    valid = articulation.valid_BP[0]
    middle, half = articulation.center_BP3[0, valid], articulation.size_BP3[0, valid] / 2.0
    return np.asarray(torch.stack([middle - half, middle + half], dim=1).double().cpu())


def box_likeness(one: Floats, other: Floats) -> float:
    """Mean generalized IoU of boxes of the same slots (Rezatofighi et al. 2019); slots that one of
    them lacks count as -1, its least."""
    both = min(len(one), len(other))
    found = [-1.0] * (max(len(one), len(other)) - both)
    for a, b in zip(one[:both], other[:both], strict=True):
        inner = float((np.minimum(a[1], b[1]) - np.maximum(a[0], b[0])).clip(min=0.0).prod())
        outer = float((np.maximum(a[1], b[1]) - np.minimum(a[0], b[0])).prod())
        union = float(np.ptp(a, axis=0).prod() + np.ptp(b, axis=0).prod()) - inner
        found.append(inner / max(union, TINY) - (outer - union) / max(outer, TINY))
    return float(np.mean(found))


def told_of(finding: Finding, asked: Question) -> tuple[str, ...]:
    """What a user should know of how an answer was found."""
    told, capture = [], asked.capture
    if not asked.about.stated:
        told.append(told_sphere(finding.sphere, asked.about))
    if len(finding.states) < len(capture.states):
        shown = ", ".join(str(capture.states[place]) for place in finding.states)
        told.append(
            f"the network reads {len(finding.states)} states at a time: boxes and joints are what "
            f"it says of the states {shown}; in every other state it told how far parts are open"
        )
    return tuple(told)


def found(asked: Question, sphere: Sphere, views: Sequence[int]) -> Finding:
    """The best that the network says about a sphere when it is shown some views."""
    chosen = list(views)
    images = reposed(asked.images, asked.capture, sphere).mapped(lambda own: own[:, :, chosen])
    groups = state_groups(len(asked.capture.states), asked.config.data.states)
    answers = [Answer(states=group, prediction=_said(asked, images, group)) for group in groups]
    seen = seen_from(asked, sphere)
    places = np.linspace(0, len(answers) - 1, min(len(answers), MOST_LEADS)).astype(int)
    findings = []
    for place in places.tolist():
        prediction = completed(answers[place], answers, len(asked.capture.states))
        boxes = object_guess(prediction.articulation, 0, {}, radius=sphere.radius_m)
        findings.append(
            Finding(
                agreement=agreement(boxes, seen),
                views=tuple(views),
                states=groups[place],
                sphere=sphere,
                prediction=prediction,
                seen=seen,
            )
        )
    return best(findings)


def in_states(asked: Question, places: Sequence[int]) -> Question:
    """The question about some states of the capture alone."""
    chosen, seen = list(places), asked.seen
    return dataclasses.replace(
        asked,
        capture=asked.capture.in_states(chosen),
        images=asked.images.mapped(lambda own: own[:, chosen]),
        seen=Silhouettes(
            mask=seen.mask[chosen], origins=seen.origins[chosen], ways=seen.ways[chosen]
        ),
    )


def best(findings: Sequence[Finding]) -> Finding:
    """The one that agrees best; of equals the first."""
    return max(findings, key=lambda own: own.agreement)


def _said(asked: Question, images: Images, states: Sequence[int]) -> Prediction:
    index = torch.tensor(list(states))
    return predict(
        asked.art, asked.config, images.mapped(lambda own: own[:, index]), parts=asked.parts
    )


def seen_from(asked: Question, sphere: Sphere) -> Silhouettes:
    """The silhouettes with another sphere's middle for zero."""
    shift = (asked.about.center - sphere.center) * sphere.meters
    return dataclasses.replace(asked.seen, origins=asked.seen.origins + shift)
