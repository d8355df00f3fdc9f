"""The network is asked from where the object is, and the answer counts that agrees best."""

import dataclasses
import math
from collections.abc import Iterator
from typing import cast

import numpy as np
import pytest
import torch

from artgen.core.errors import ModelError
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation, Images
from model.config import Config
from model.network.art import Art
from model.network.prediction import Prediction
from model.reconstruct.assemble import Assembled
from model.reconstruct.cameras import Rig
from model.reconstruct.capture import Capture
from model.reconstruct.choice import chosen_views
from model.reconstruct.hull import check_cameras
from model.reconstruct.search import (
    COHERENCE,
    Question,
    box_likeness,
    found,
    holds,
    in_states,
    merit,
    question,
    searched,
    told_of,
)
from model.reconstruct.sight import Sphere, sphere_of
from model.training.recipes import RECIPES, articulation_only
from tests.unit.model.reconstruct.perfect import cabinet
from tests.unit.model.reconstruct.studio import STATES

RADIUS = 1.0
"""m; the open door's tip is 0.94 m from the middle of the cabinet's sphere."""
KINDS = {"revolute": REVOLUTE, "prismatic": PRISMATIC}


def truth() -> Articulation:
    """The cabinet of the photographs in radii."""
    guess = cabinet()
    box = torch.tensor(np.array([part.box for part in guess.parts])) / RADIUS
    joints = {joint.slot: joint for joint in guess.joints}
    unit = {slot: 2.0 * (math.pi if j.type == "revolute" else RADIUS) for slot, j in joints.items()}
    motion = [
        [0.0, *(state[f"part_{slot}_joint"] / unit[slot] for slot in (1, 2))] for state in STATES
    ]
    zero = np.zeros(3)
    return Articulation(
        valid_BP=torch.tensor([[True] * 3]),
        center_BP3=box.mean(dim=1)[None],
        size_BP3=(box[:, 1] - box[:, 0])[None],
        type_BP=torch.tensor([[FIXED, *(KINDS[joints[slot].type] for slot in (1, 2))]]),
        axis_BP3=torch.tensor(np.array([[zero, joints[1].axis, joints[2].axis]])),
        origin_BP3=torch.tensor(np.array([[zero, joints[1].origin / RADIUS, zero]])),
        motion_BTP=torch.tensor([motion]),
        limits_BP2=torch.zeros(1, 3, 2),
        parent_BP=torch.tensor([[-1, 0, 0]]),
    )


def sphere(perfect: Assembled) -> Sphere:
    """That of `truth`."""
    return Sphere(
        center=perfect.shift, radius=RADIUS, meters=1.0, center_stated=True, radius_stated=True
    )


class Knowing:
    """A network that says the truth in radii, whatever it is shown: right in meters only where it
    is asked from the true sphere."""

    def parameters(self) -> Iterator[torch.Tensor]:
        """One, on the CPU: that is where it predicts."""
        return iter((torch.zeros(1),))

    def __call__(self, images: Images, valid_BP: torch.Tensor) -> Prediction:
        said = truth()
        return Prediction(
            articulation=said,
            axis_BP3=said.axis_BP3,
            origin_BP3=said.origin_BP3,
            type_logits_BP2=torch.zeros(1, 3, 2),
        )


class Wavering(Knowing):
    """A network that has the drawer elsewhere every second time."""

    def __init__(self) -> None:
        self.asked = 0

    def __call__(self, images: Images, valid_BP: torch.Tensor) -> Prediction:
        said = super().__call__(images, valid_BP)
        self.asked += 1
        off = torch.tensor([0.0, 0.0, 0.2 * (self.asked % 2)])
        moved = dataclasses.replace(
            said.articulation, center_BP3=said.articulation.center_BP3 + off[None, :, None]
        )
        return dataclasses.replace(said, articulation=moved)


@pytest.fixture(scope="module")
def config() -> Config:
    return articulation_only(RECIPES["debug"]("nano"))


def asked(config: Config, capture: Capture, about: Sphere) -> Question:
    return question(cast(Art, Knowing()), config, capture, about, parts=3)


def hull_sphere(capture: Capture, **stated: object) -> Sphere:
    rig = Rig(file=capture.files[0][0], shots=(), **stated)  # type: ignore[arg-type]
    return sphere_of(rig, check_cameras(capture))


def test_images_and_silhouettes_are_the_same_from_any_sphere(
    config: Config, capture: Capture, perfect: Assembled
) -> None:
    """Asked about one sphere by way of another: poses are float32, so 2^-24 of some 3 m,
    and a ray along an edge may see the other side: one of 8 x 800 px or so is 2e-4."""
    true = sphere(perfect)
    other = dataclasses.replace(true, center=true.center + 0.2, radius=0.5)
    one, two = (found(asked(config, capture, about), true, (0, 1)) for about in (true, other))
    assert np.abs(one.seen.origins - two.seen.origins).max() <= 1e-6
    assert np.array_equal(one.seen.mask, two.seen.mask)
    assert one.agreement == pytest.approx(two.agreement, abs=1e-3)


def test_what_is_stated_stays(config: Config, capture: Capture, perfect: Assembled) -> None:
    true = sphere(perfect)
    there = asked(config, capture, true)
    choice = chosen_views(capture, true, config.data)
    finding = searched(there, choice)
    assert finding.sphere is true
    assert told_of(finding, there) == ()
    half = asked(config, capture, hull_sphere(capture, radius=RADIUS))
    finding = searched(half, choice)
    assert finding.sphere.radius == RADIUS
    assert "states no center:" in told_of(finding, half)[0]


def test_a_sphere_that_is_not_stated_is_found(
    config: Config, capture: Capture, perfect: Assembled
) -> None:
    """From one that is wide of it. A step of 0.16 radii is halved where it leads nowhere better,
    and half of that is what a number may be off; half of what can be gained is gained by then."""
    true, hull = sphere(perfect), hull_sphere(capture)
    wide = hull.center + np.array([0.0, 0.15, -0.1])
    about = dataclasses.replace(hull, center=wide, radius=1.15 * RADIUS)
    there = asked(config, capture, about)
    choice = chosen_views(capture, about, config.data)
    finding = searched(there, choice)
    before = found(there, about, choice.views).agreement
    best = found(there, true, choice.views).agreement
    assert finding.agreement - before >= 0.5 * (best - before) > 0.1
    assert float(np.linalg.norm(finding.sphere.center - true.center)) <= 0.08 * RADIUS
    assert abs(finding.sphere.radius / RADIUS - 1.0) <= 0.08
    (told,) = told_of(finding, there)
    assert "states no center and no radius: the sphere around the visual hull was moved" in told


def test_too_few_states_are_told_before_the_network_runs(
    config: Config, capture: Capture, perfect: Assembled
) -> None:
    with pytest.raises(ModelError, match="show 1 state"):
        asked(config, capture.in_states([0]), sphere(perfect))


def test_a_question_about_some_states_is_that_of_a_smaller_capture(
    config: Config, capture: Capture, perfect: Assembled
) -> None:
    swapped = in_states(asked(config, capture, sphere(perfect)), [1, 0])
    directly = asked(config, capture.in_states([1, 0]), sphere(perfect))
    assert swapped.capture.files == directly.capture.files == capture.files[::-1]
    assert torch.equal(swapped.images.rgb_BTV3HW, directly.images.rgb_BTV3HW)
    for name in ("mask", "origins", "ways"):
        assert np.array_equal(getattr(swapped.seen, name), getattr(directly.seen, name))


def test_a_sphere_that_cuts_the_silhouettes_cannot_hold_the_object(
    config: Config, capture: Capture, perfect: Assembled
) -> None:
    """The open door's tip is 0.94 m from the middle. A network that is sure of itself can agree
    with silhouettes from a sphere that is too small."""
    true = sphere(perfect)
    there = asked(config, capture, true)
    assert holds(there, true)
    assert holds(there, hull_sphere(capture))
    assert not holds(there, dataclasses.replace(true, radius=0.6))
    assert not holds(there, dataclasses.replace(true, center=true.center + 0.5))


def test_equal_boxes_are_alike_and_distant_ones_are_not() -> None:
    """By hand: two unit cubes a gap of one apart fill 2 of the 3 that hold both; cubes that share a
    half share 0.5 of 1.5."""
    cube = np.array([[[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]])
    x = np.array([1.0, 0.0, 0.0])
    assert box_likeness(cube, cube) == 1.0
    assert box_likeness(cube, cube + 2.0 * x) == pytest.approx(-1.0 / 3.0, abs=1e-12)
    assert box_likeness(cube, cube + 0.5 * x) == pytest.approx(1.0 / 3.0, abs=1e-12)
    assert box_likeness(cube, np.concatenate([cube, cube])) == 0.0
    flat = cube * [1.0, 1.0, 0.0]
    assert np.isfinite(box_likeness(flat, flat))


def test_answers_that_contradict_each_other_have_less_merit(
    config: Config, capture: Capture, perfect: Assembled
) -> None:
    """A network that says the same twice gains all that likeness counts, one that wavers less."""
    true = sphere(perfect)
    there = asked(config, capture, true)
    one = merit(there, true, [(0, 1)])
    assert merit(there, true, [(0, 1), (0, 2)]) == pytest.approx(one + COHERENCE, abs=1e-9)
    wavering = dataclasses.replace(there, art=cast(Art, Wavering()))
    said = [found(wavering, true, views).agreement for views in [(0, 1), (0, 2)]]
    wavering = dataclasses.replace(there, art=cast(Art, Wavering()))
    assert merit(wavering, true, [(0, 1), (0, 2)]) < np.mean(said) + COHERENCE - 0.01
