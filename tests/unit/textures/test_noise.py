import math

import numpy as np
import pytest

from artgen.core.stream import Stream
from artgen.textures.noise import fractal, smooth, smoothstep, white

SHAPE = (96, 128)


def rng(name="noise"):
    return Stream(3, name).generator()


@pytest.mark.parametrize("cells", [(6, 8), (96, 4), (3, 128), (5, 7)])
def test_smooth_noise_wraps_around(cells):
    """No step across the seam exceeds the largest step inside, in either direction."""
    field = smooth(rng(), cells, SHAPE)
    for axis in (0, 1):
        steps = np.abs(field - np.roll(field, 1, axis=axis))
        seam = np.take(steps, 0, axis=axis)
        inside = np.take(steps, range(1, SHAPE[axis]), axis=axis)
        assert seam.max() <= inside.max()


@pytest.mark.parametrize("cells", [(48, 64), (96, 32), (96, 128)])
def test_variance_is_one(cells):
    """Averaged over 40 fields of 1,500 free values or more: the relative standard error of a
    variance of even draws is sqrt(0.8 / n) <= 0.004; correlation of the spline triples it."""
    fields = [smooth(rng(str(k)), cells, SHAPE) for k in range(40)]
    assert np.mean([np.mean(field**2) for field in fields]) == pytest.approx(1.0, abs=0.05)


def test_fractal_keeps_the_variance():
    fields = [fractal(rng(str(k)), (12, 16), SHAPE, octaves=4) for k in range(60)]
    assert np.mean([np.mean(field**2) for field in fields]) == pytest.approx(1.0, abs=0.08)


def test_one_value_per_texel_is_white_noise():
    assert np.array_equal(smooth(rng(), SHAPE, SHAPE), white(rng(), SHAPE))


def test_noise_depends_on_its_stream_alone():
    assert np.array_equal(smooth(rng(), (6, 8), SHAPE), smooth(rng(), (6, 8), SHAPE))
    assert not np.array_equal(smooth(rng(), (6, 8), SHAPE), smooth(rng("other"), (6, 8), SHAPE))


def test_smoothstep_is_level_at_its_ends():
    x = np.linspace(-1.0, 2.0, 301)
    y = smoothstep(0.0, 1.0, x)
    assert (np.diff(y) >= 0.0).all()
    assert y[0] == 0.0
    assert y[-1] == 1.0
    assert smoothstep(0.0, 1.0, np.array([0.5]))[0] == 0.5
    assert math.isclose(smoothstep(2.0, 4.0, np.array([2.5]))[0], 0.15625)
