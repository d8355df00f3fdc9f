"""The judge of rounded bodies: passes good ones, rejects every kind of bad one."""

import numpy as np
import pytest

from artgen.core.mesh import Floats, Ints
from artgen.geometry.measure import moments, open_edges
from artgen.geometry.solid import box, chamfered_box
from blender_scripts.soundness import heights, is_manifold, is_sound, without_caps

RADIUS = 0.004


def arrays(solid) -> tuple[Floats, Ints]:
    mesh = solid.trimesh()
    return mesh.vertices, mesh.faces


SHARP = arrays(box((0.1, 0.1, 0.1), at=(0, 0, -0.05)))
CUT = arrays(chamfered_box((0.1, 0.1, 0.1), RADIUS, at=(0, 0, -0.05)))


def sound(body: tuple[Floats, Ints]) -> bool:
    return is_sound(body, *SHARP, RADIUS)


def test_a_chamfered_box_is_sound() -> None:
    assert sound(CUT)


@pytest.mark.parametrize(
    "spoil",
    [
        lambda v, f: (v, f[:-1]),
        lambda v, f: (v, f[:, ::-1]),
        lambda v, f: (v, np.vstack([f, f[:1]])),
        lambda v, f: (v + np.array([0.001, 0.0, 0.0]), f),
        lambda v, f: (v * 0.8, f),
        lambda v, f: (v * 1.001, f),
        lambda v, f: (np.where(np.arange(len(v))[:, None] == 3, np.nan, v), f),
        lambda v, f: (v, f[:0]),
        lambda v, f: (v, np.vstack([f[1:], np.roll(f[:1, ::-1], 1)])),
    ],
    ids=["hole", "inverted", "doubled", "moved", "shrunk", "grown", "nan", "empty", "flipped"],
)
def test_a_spoilt_body_is_not_sound(spoil) -> None:
    assert not sound(spoil(*CUT))


def with_cap(corners: int) -> tuple[Floats, Ints]:
    """A box whose top has `corners` extra vertices on one straight side, joined by collapsed
    triangles, as a triangulated polygon has them."""
    v, f = SHARP
    top = next(k for k in range(len(f)) if v[f[k], 2].min() > 0.049)
    a, b, c = f[top].tolist()
    share = np.arange(1, corners + 1)[:, None] / (corners + 1)
    chain = [a, *(len(v) + np.arange(corners)).tolist(), b]
    points = np.vstack([v, v[a] + share * (v[b] - v[a])])
    fan = [[a, chain[k + 1], chain[k]][::-1] for k in range(1, corners + 1)]
    rest = np.delete(f, top, axis=0).tolist()
    other = next(t for t in rest if {a, b} <= set(t))
    (far,) = set(other) - {a, b}
    rest.remove(other)
    split = [[chain[k + 1], chain[k], far] for k in range(corners + 1)]
    return points, np.array([*rest, [a, b, c], *fan, *split], np.int32)


@pytest.mark.parametrize("corners", [1, 2, 5])
def test_collapsed_triangles_go_and_the_shape_stays(corners: int) -> None:
    points, faces = with_cap(corners)
    assert open_edges(faces) == 0
    assert (heights(points[faces]) < 1e-9).sum() == corners
    mended = without_caps(points, faces)
    assert is_manifold(mended)
    assert heights(points[mended]).min() > 1e-3
    assert len(mended) == len(faces)
    assert moments(points[mended]).volume == pytest.approx(1e-3, rel=1e-12)


def test_a_body_without_collapsed_triangles_is_left_alone() -> None:
    assert np.array_equal(without_caps(*CUT), CUT[1])
