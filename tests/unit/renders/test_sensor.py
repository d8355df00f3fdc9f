"""Laws of the sensor's effects: nothing at zero, each on its own, each as strong as stated."""

from dataclasses import replace

import numpy as np
import pytest

from artgen.core.stream import Stream
from artgen.imaging import display
from renders.sensor import GRAY, balance, compressed, defocused, noisy, sensed
from renders.settings import SensorSettings

STREAM = Stream(5, "sensor")
ON = SensorSettings(exposure=1.0, white_balance=0.2, noise=4.0, blur=2.5, jpeg=90)
KEYS = {
    "exposure": "exposure_stops",
    "white_balance": "white_balance",
    "noise": "noise_codes",
    "blur": "blur_px",
    "jpeg": "jpeg_quality",
}


def scene(size: int = 48) -> np.ndarray:
    """A gray square on a transparent ground, brighter to the right."""
    image = np.zeros((size, size, 4), np.float32)
    image[8:-8, 8:-8, :3] = np.linspace(0.05, 0.5, size - 16)[None, :, None]
    image[8:-8, 8:-8, 3] = 1.0
    return image


def test_all_off_is_the_display_bit_for_bit() -> None:
    shown, drawn = sensed(scene(), SensorSettings(), STREAM)
    assert np.array_equal(shown, display(scene()))
    assert drawn == {}


@pytest.mark.parametrize("name", KEYS)
def test_what_is_drawn_for_one_does_not_depend_on_the_others(name: str) -> None:
    alone = replace(SensorSettings(), **{name: getattr(ON, name)})
    _, one = sensed(scene(), alone, STREAM)
    _, all_ = sensed(scene(), ON, STREAM)
    assert one == {KEYS[name]: all_[KEYS[name]]}
    assert not np.array_equal(sensed(scene(), alone, STREAM)[0], display(scene()))


def test_equal_streams_give_equal_bytes() -> None:
    one, other = (sensed(scene(), ON, Stream(5, "sensor"))[0] for _ in range(2))
    assert np.array_equal(one, other)
    assert not np.array_equal(one, sensed(scene(), ON, Stream(6, "sensor"))[0])


def test_exposure_multiplies_radiance_by_a_power_of_two() -> None:
    settings = SensorSettings(exposure=2.0)
    shown, drawn = sensed(scene(), settings, STREAM)
    factor = 2.0 ** drawn["exposure_stops"]
    brighter = scene() * np.array([factor, factor, factor, 1.0], np.float32)
    # Both round radiance to float32 once: an 8-bit code may differ where it lies on a half.
    assert np.abs(shown.astype(int) - display(brighter)).max() <= 1


def test_white_balance_keeps_the_luminance_of_gray() -> None:
    for share in (-0.3, 0.0, 0.25):
        gains = balance(share)
        assert gains @ [0.2126, 0.7152, 0.0722] == pytest.approx(1.0, abs=1e-15)
        assert gains[0] / gains[2] == pytest.approx((1 + share) / (1 - share), rel=1e-15)


@pytest.mark.parametrize("radius", [0.3, 1.0, 2.4, 5.0])
def test_defocus_keeps_what_does_not_leave_the_image(radius: float) -> None:
    blurred = defocused(scene(), radius)
    # float32 sums of some hundred terms for each of 2304 pixels
    np.testing.assert_allclose(blurred.sum((0, 1)), scene().sum((0, 1)), rtol=1e-5)
    point = np.zeros((15, 15, 4), np.float32)
    point[7, 7] = 1.0
    spread = defocused(point, radius)[..., 3]
    y, x = np.mgrid[:15, :15] - 7
    far = np.hypot(np.maximum(np.abs(x) - 0.5, 0), np.maximum(np.abs(y) - 0.5, 0))
    assert (spread[far > max(radius, 0.5)] == 0.0).all()
    np.testing.assert_allclose(spread, spread.T, atol=1e-7)


def test_noise_has_the_stated_deviation_at_middle_gray_and_none_where_nothing_is() -> None:
    image = np.ones((128, 128, 4), np.float32) * GRAY
    image[..., 3] = 1.0
    codes = display(noisy(image, 3.0, STREAM)).astype(float)[..., :3]
    # 49152 values: their deviation is known to 3 / sqrt(2 N) = 0.01; rounding to codes adds
    # sqrt(1 / 12) in squares, 0.014; the curve's bend over 3 codes less than a hundredth.
    assert codes.std() == pytest.approx(3.0, abs=0.08)
    assert codes.mean() == pytest.approx(119.0, abs=0.7)
    clear = np.zeros((8, 8, 4), np.float32)
    assert np.array_equal(noisy(clear, 3.0, STREAM), clear)


def test_the_best_jpeg_is_close_and_keeps_alpha() -> None:
    shown = display(scene())
    after = compressed(shown, 100)
    assert np.array_equal(after[..., 3], shown[..., 3])
    assert (after[shown[..., 3] == 0] == 0).all()
    # Quality 100 quantizes by 1 and converts color twice: 3 codes at most on a smooth image.
    inner = np.s_[9:-9, 9:-9, :3]
    assert np.abs(after[inner].astype(int) - shown[inner]).max() <= 3
