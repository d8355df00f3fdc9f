"""Parts seen through their motion are those that were moved."""

import dataclasses

import numpy as np
import pytest
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from artgen.core.mesh import Floats
from artgen.core.transform import apply
from model.reconstruct.guess import ObjectGuess, PartGuess
from model.reconstruct.outlines import Mask, Outlines, Silhouettes, overlap, poses_of
from model.reconstruct.refine import moved

MOST_APART = 2e-4
"""Share of the rays that may meet one and miss the other: those that pass an edge within float32's
rounding of a vertex, 1e-7 of a radius, where a pixel is 1 / 24 of one; and a ray of 9,216."""


def met(part: PartGuess, pose: Floats, state: int, seen: Silhouettes) -> Mask:
    """(V, N) rays that meet the triangles where they are."""
    scene = EmbreeScene()
    TriangleMesh(scene, apply(pose, part.vertices[part.faces]).astype(np.float32))
    found = []
    for origin, ways in zip(seen.origins[state], seen.ways[state], strict=True):
        starts = np.tile(origin.astype(np.float32), (len(ways), 1))
        found.append(scene.run(starts, ways.astype(np.float32)) >= 0)
    return np.stack(found)


@pytest.mark.parametrize("step", [0.0, 0.06, -0.03])
def test_rays_taken_back_meet_what_moved_triangles_meet(
    guess: ObjectGuess, seen: Silhouettes, step: float
) -> None:
    """Every joint in every state."""
    other = guess
    for place, state in np.ndindex(len(guess.joints), len(seen.mask)):
        other = moved(other, place, state, step)
    found = Outlines(guess, seen).of(other)
    for part, mask in zip(other.parts, found, strict=True):
        for t in range(len(mask)):
            expected = met(part, poses_of(other, t)[part.slot], t, seen)
            assert expected.any()
            assert (mask[t] != expected).mean() <= MOST_APART


def test_what_is_kept_is_not_what_comes_next(guess: ObjectGuess, seen: Silhouettes) -> None:
    """Asked for one guess, then another, then the first again: the answers of fresh ones."""
    other = moved(guess, 0, 0, 0.1)
    outlines = Outlines(guess, seen)
    fresh = [Outlines(guess, seen).agreement(own) for own in (guess, other, guess)]
    assert [outlines.agreement(own) for own in (guess, other, guess)] == fresh
    assert fresh[0] != fresh[1]


def test_overlap_is_the_mean_of_the_images() -> None:
    """One image half covered, one empty and shown empty, one missed, one seen in two parts."""
    mask = np.array([[[1, 1, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0], [1, 0, 0, 1]]], bool)
    seen = Silhouettes(mask=mask, origins=np.zeros((1, 4, 3)), ways=np.zeros((1, 4, 4, 3)))
    first = np.array([[[1, 0, 0, 0], [0, 0, 0, 0], [0, 1, 0, 0], [1, 0, 0, 0]]], bool)
    second = np.array([[[1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]]], bool)
    assert overlap([first, second], seen) == (0.5 + 0.0 + 0.0 + 1.0) / 4.0


def test_poses_follow_parents_and_circles_end(guess: ObjectGuess) -> None:
    one, two = guess.joints
    poses = poses_of(
        dataclasses.replace(guess, joints=(one, dataclasses.replace(two, parent=1))), 1
    )
    alone = poses_of(guess, 1)
    assert np.abs(poses[2] - alone[1] @ alone[2]).max() <= 1e-12
    circle = (dataclasses.replace(one, parent=2), dataclasses.replace(two, parent=1))
    assert set(poses_of(dataclasses.replace(guess, joints=circle), 0)) == {0, 1, 2}
