"""Guesses: rest first, canonical joints last."""

import math

import torch

from artgen.core.stream import Stream
from model.batch import FIXED, PRISMATIC, REVOLUTE
from model.config import FieldConfig
from model.field.kinematics import moved, world_from_rest
from model.fitting.fit_guess import Guess, canonical, tight
from tests.unit.model.box_scenes import cabinet, changed
from tests.unit.model.fit_scenes import drawer

BOUNDS = torch.tensor([[-0.5, -0.4, -0.3], [0.5, 0.6, 0.3]])


def guesses(*, states: int = 2, types: tuple[int, ...] | None = None, seed: int = 0) -> Guess:
    return Guess(
        BOUNDS,
        parts=3,
        states=states,
        guesses=4,
        plane_px=4,
        channels=2,
        field=FieldConfig(hidden=4),
        motion=0.05,
        types=types,
        stream=Stream(seed, "guess"),
    )


def test_a_guess_is_at_rest_in_the_first_state() -> None:
    articulation = guesses(states=3).articulation()
    poses = world_from_rest(articulation)
    assert torch.equal(poses[:, 0], torch.eye(4).expand(4, 3, 4, 4))
    assert torch.equal(poses[:, :, 0], torch.eye(4).expand(4, 3, 4, 4))
    torch.testing.assert_close(articulation.motion_BTP[:, 1:, 1:], torch.full((4, 2, 2), 0.05))
    lengths = articulation.axis_BP3[:, 1:].norm(dim=-1)
    torch.testing.assert_close(lengths, torch.ones(4, 2))
    assert (articulation.type_BP[:, 0] == FIXED).all()
    torch.testing.assert_close(articulation.center_BP3[0, 0], BOUNDS.mean(dim=0))
    torch.testing.assert_close(articulation.size_BP3[0, 0], BOUNDS[1] - BOUNDS[0])


def test_guesses_follow_from_the_stream_alone() -> None:
    torch.manual_seed(1)
    first = guesses()
    torch.manual_seed(2)
    second, other = guesses(), guesses(seed=1)
    for name, value in first.state_dict().items():
        assert torch.equal(value, second.state_dict()[name]), name
    assert not torch.equal(first.twist_GP3, other.twist_GP3)


def test_types_are_drawn_or_given() -> None:
    drawn = guesses().type_GP[:, 1:]
    assert set(drawn.flatten().tolist()) == {REVOLUTE, PRISMATIC}
    given = guesses(types=(FIXED, PRISMATIC, REVOLUTE)).type_GP
    assert given.tolist() == [[FIXED, PRISMATIC, REVOLUTE]] * 4


def test_keeping_forgets_the_others() -> None:
    guess = guesses()
    before = guess.articulation()
    guess.keep(torch.tensor([1, 3]))
    after = guess.articulation()
    assert torch.equal(after.axis_BP3, before.axis_BP3[[1, 3]])
    assert torch.equal(after.type_BP, before.type_BP[[1, 3]])
    assert guess.field()(torch.zeros(2, 3, 1, 3))[0].shape == (2, 3, 1)


def test_canonical_joints_move_as_before() -> None:
    """Flipped axes and slid origins are the same motions: a few roundings of numbers near 1."""
    articulation = cabinet()
    away = (
        articulation.origin_BP3
        + 0.7 * articulation.axis_BP3 * (articulation.type_BP == REVOLUTE)[..., None]
    )
    odd = changed(
        articulation,
        axis_BP3=-articulation.axis_BP3,
        motion_BTP=-articulation.motion_BTP,
        origin_BP3=away,
    )
    found = canonical(odd)
    points = torch.rand(1, 5, 3, generator=torch.Generator().manual_seed(0))
    for t in range(2):
        there = moved(world_from_rest(found)[0, t], points)
        expected = moved(world_from_rest(articulation)[0, t], points)
        torch.testing.assert_close(there, expected, rtol=0, atol=1e-6)
    assert (found.motion_BTP >= 0.0).all()
    assert (found.limits_BP2[..., 0] == 0.0).all()
    assert math.isclose(found.limits_BP2[0, 1, 1].item(), 0.14, rel_tol=1e-6)
    torch.testing.assert_close(found.origin_BP3, articulation.origin_BP3, rtol=0, atol=1e-6)


def test_boxes_become_as_tight_as_what_fields_hold() -> None:
    """A drawer whose box is the whole cabinet's; to half a cell of its longest side / 24."""
    articulation, field = drawer()
    loose = changed(
        articulation,
        center_BP3=articulation.center_BP3[:, :1].expand(-1, 2, -1),
        size_BP3=torch.full_like(articulation.size_BP3, 1.4),
    )
    found = tight(type(field)(**{**vars(field), "articulation": loose}), loose, 24)
    half_cell = 1.4 * 1.05 / 24 / 2
    torch.testing.assert_close(found.size_BP3, articulation.size_BP3, rtol=0, atol=2 * half_cell)
    torch.testing.assert_close(found.center_BP3, articulation.center_BP3, rtol=0, atol=half_cell)
    assert found.valid_BP.all()


class Posed(torch.nn.Module):
    """Where the parts of a guess are."""

    def __init__(self, guess: Guess) -> None:
        super().__init__()
        self.guess = guess

    def forward(self) -> torch.Tensor:
        return world_from_rest(self.guess.articulation())


def test_slopes_of_joints_are_right_and_finite_at_rest() -> None:
    """A twist is an axis times a motion; where it is zero, neither has a direction."""
    posed = Posed(guesses(states=3, types=(FIXED, PRISMATIC, REVOLUTE)).double())
    names = ("twist_GP3", "origin_GP3", "share_GTP")

    def poses(*values: torch.Tensor) -> torch.Tensor:
        own = {f"guess.{name}": value for name, value in zip(names, values, strict=True)}
        return torch.func.functional_call(posed, own, ())

    start = [getattr(posed.guess, name).detach().clone().requires_grad_() for name in names]
    assert torch.autograd.gradcheck(poses, start, fast_mode=True)
    start[0] = torch.zeros_like(start[0]).requires_grad_()
    for slope in torch.autograd.grad(poses(*start).sum(), start):
        assert torch.isfinite(slope).all()
