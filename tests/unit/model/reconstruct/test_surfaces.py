"""A field's parts become a guess in meters, with colors anywhere; empty ones become boxes."""

import dataclasses

import numpy as np
import torch

from model.batch import Articulation
from model.field.analytic import BoxField
from model.reconstruct.guess import PartGuess
from model.reconstruct.surfaces import field_guess, filling

RADIUS = 0.5


def articulation() -> Articulation:
    """A base, and a part whose box is empty space."""
    one = torch.zeros(1, 2)
    return Articulation(
        valid_BP=torch.tensor([[True, True]]),
        center_BP3=torch.tensor([[[0.0, 0.0, 0.0], [0.8, 0.0, 0.0]]]),
        size_BP3=torch.tensor([[[0.8, 0.6, 0.4], [0.2, 0.2, 0.2]]]),
        type_BP=torch.tensor([[0, 2]]),
        axis_BP3=torch.tensor([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]]),
        origin_BP3=torch.zeros(1, 2, 3),
        motion_BTP=torch.zeros(1, 2, 2),
        limits_BP2=torch.stack([one, one + 0.1], dim=-1),
        parent_BP=torch.tensor([[-1, 0]]),
    )


def field(present: bool) -> BoxField:
    said = articulation()
    return BoxField(
        articulation=said,
        center_BPM3=said.center_BP3[:, :, None],
        half_BPM3=said.size_BP3[:, :, None] / 2.0,
        rgb_BPM3=torch.tensor([[[[0.9, 0.1, 0.2]], [[0.2, 0.3, 0.4]]]]),
        present_BPM=torch.tensor([[[True], [present]]]),
    )


def test_surfaces_and_colors_are_the_fields() -> None:
    """Marching cubes of a box at 24 cells: edges are cut by a cell of 0.02 m at most."""
    base, part = field_guess(field(True), articulation(), 0, resolution=24, radius=RADIUS).parts
    half = RADIUS * np.array([0.4, 0.3, 0.2])
    assert np.abs(np.abs(base.vertices).max(axis=0) - half).max() <= 0.02
    assert base.shade is not None
    assert np.allclose(base.shade(np.array([[0.2, 0.0, 0.0]])), [[0.9, 0.1, 0.2]], atol=1e-6)
    assert not part.boxed


def test_a_moving_part_fills_its_box() -> None:
    """The base keeps its field's surface, a cell short of its box; the drawer reaches all sides."""
    said = articulation()
    short = dataclasses.replace(said, size_BP3=0.75 * said.size_BP3)
    small = dataclasses.replace(field(True), half_BPM3=short.size_BP3[:, :, None] / 2.0)
    base, part = field_guess(small, said, 0, resolution=24, radius=RADIUS).parts
    assert (np.ptp(base.vertices, axis=0) < 0.9 * np.ptp(base.box, axis=0)).all()
    bounds = np.array([part.vertices.min(axis=0), part.vertices.max(axis=0)])
    # A few float64 operations on lengths below 1.
    np.testing.assert_allclose(bounds, part.box, rtol=0.0, atol=1e-14)


def test_colors_are_stretched_with_the_surface() -> None:
    """Red is x, from 0 to 1 over a part that fills half of its box; a sheet stays in the middle."""
    box = np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])
    vertices = np.array([[0.0, -0.5, 0.25], [1.0, 0.5, 0.25], [0.0, 0.5, 0.25], [1.0, -0.5, 0.25]])
    faces = np.array([[0, 1, 2], [0, 3, 1]], np.int32)
    part = PartGuess(
        slot=1,
        vertices=vertices,
        faces=faces,
        rgb=np.zeros((4, 3)),
        box=box,
        shade=lambda points: points[:, [0, 0, 0]],
    )
    found = filling(part)
    assert found.shade is not None
    np.testing.assert_allclose(found.shade(found.vertices)[:, 0], vertices[:, 0], atol=1e-15)
    assert (found.vertices[:, 2] == 0.0).all()
    assert found.vertices[:, :2].min() == -1.0
    assert found.vertices[:, :2].max() == 1.0
    assert filling(dataclasses.replace(part, shade=None)).shade is None


def test_a_part_without_a_surface_is_a_box_and_told() -> None:
    guess = field_guess(field(False), articulation(), 0, resolution=24, radius=RADIUS)
    assert [part.boxed for part in guess.parts] == [False, True]
    ((slot, text),) = guess.told
    assert slot == 1
    assert "no surface" in text


def test_a_network_without_planes_predicts_boxes() -> None:
    guess = field_guess(None, articulation(), 0, resolution=24, radius=RADIUS)
    assert [len(part.faces) for part in guess.parts] == [12, 12]
    assert guess.told == ()
