"""Surfaces become solids: hollows stay, floaters go, what encloses nothing is told."""

import dataclasses

import numpy as np
import pytest

from artgen.core.errors import GeometryError
from artgen.geometry.solid import Solid, cylinder, slab
from model.reconstruct.guess import PartGuess
from model.reconstruct.shapes import mended, shape_of, sound, without_small_pieces
from tests.unit.model.reconstruct.perfect import part

BLOCK = slab((0.0, 0.0, 0.0), (0.4, 0.4, 0.4))
HOLLOW = BLOCK - slab((0.1, 0.1, 0.1), (0.3, 0.3, 0.3))
SPECK = slab((0.6, 0.0, 0.0), (0.62, 0.02, 0.02))


def shaped(guess: PartGuess, *, triangles: int = 10_000) -> Solid:
    return shape_of(guess, tolerance=1e-5, triangles=triangles).solid


def test_a_hollow_stays_open() -> None:
    """manifold3d takes the wall of a hollow for a piece of negative volume."""
    assert abs(shaped(part(0, HOLLOW)).volume - HOLLOW.volume) <= 1e-12
    assert abs(mended(HOLLOW, 1e-5).volume - HOLLOW.volume) <= 1e-12


def test_floaters_and_bubbles_are_dropped_and_counted() -> None:
    bubble = slab((0.05, 0.05, 0.05), (0.06, 0.06, 0.06))
    whole, dropped = without_small_pieces((HOLLOW | SPECK) - bubble, 0.02)
    assert dropped == 2
    assert abs(whole.volume - HOLLOW.volume) <= 1e-12


def test_a_surface_inside_out_is_turned() -> None:
    guess = part(0, BLOCK)
    found = shape_of(
        dataclasses.replace(guess, faces=guess.faces[:, ::-1]), tolerance=1e-5, triangles=100
    )
    assert abs(found.solid.volume - BLOCK.volume) <= 1e-12
    assert any("inside out" in change for change in found.changes)


def test_an_open_surface_is_replaced_by_its_box() -> None:
    guess = part(0, BLOCK)
    found = shape_of(
        dataclasses.replace(guess, faces=guess.faces[1:]), tolerance=1e-5, triangles=100
    )
    assert np.abs(found.solid.bounds - BLOCK.bounds).max() <= 1e-12
    assert any("encloses nothing" in change for change in found.changes)


def test_triangles_are_merged_down_to_a_number() -> None:
    """A fine cylinder; its volume changes by 5 % a round at most."""
    fine = cylinder(0.1, 0.3, segments=3000)
    found = shaped(part(0, fine), triangles=500)
    assert found.manifold.num_tri() <= 500
    assert abs(found.volume / fine.volume - 1.0) <= 0.05


def test_a_flat_triangle_is_merged_away() -> None:
    """A rod let 0.3 um into a block leaves a rim that rounding to 1e-7 m would flatten."""
    rim = (
        BLOCK
        | cylinder(0.1, 0.2, segments=64).at(0.2, 0.2, 0.3)
        | slab((0.1, 0.1, 0.4), (0.3, 0.30000003, 0.45))
    )
    a, b, c = np.round(sound(rim).trimesh().triangles, 7).transpose(1, 0, 2)
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 2e-14


def test_cuts_side_by_side_leave_what_one_cut_leaves() -> None:
    """Twenty slots that touch are one groove; their floors are one rectangle again."""
    slots = BLOCK
    for k in range(20):
        slots = slots - slab((0.1, 0.02 * k, 0.3), (0.3, 0.02 * (k + 1), 0.5))
    cut = BLOCK - slab((0.1, 0.0, 0.3), (0.3, 0.4, 0.5))
    assert slots.manifold.num_tri() > 100
    assert mended(slots, 1e-4).manifold.num_tri() == cut.manifold.num_tri()
    assert abs(mended(slots, 1e-4).volume - cut.volume) <= 1e-12


def test_nothing_left_is_an_error() -> None:
    with pytest.raises(GeometryError, match="vanished under its neighbors"):
        mended(BLOCK - BLOCK, 1e-4)


def test_a_hollow_that_was_cut_for_another_part_stays() -> None:
    """A knob of 2 cm within a base of 1 m: 8e-6 of its volume, far below what counts as a piece
    when it sticks out, and 8,000 times what validators call an overlap when it is filled."""
    base, knob = slab((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), slab((0.5, 0.5, 0.5), (0.52, 0.52, 0.52))
    assert (mended(base - knob, 1e-4) & knob).volume <= 1e-12
    chip = slab((2.0, 0.0, 0.0), (2.02, 0.02, 0.02))
    assert mended(base | chip, 1e-4).bounds[1, 0] == 1.0
    tiny = slab((0.5, 0.5, 0.5), (0.5002, 0.5002, 0.5002))
    assert mended(base - tiny, 1e-5).volume == 1.0
