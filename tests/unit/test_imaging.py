"""Display of linear light: monotone, smooth, straight alpha, and honest about bad files."""

from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.core.errors import RenderError
from artgen.imaging import SHOULDER, display, png_file, read_exr, srgb_from_linear


def gray(value: float, alpha: float = 1.0) -> np.ndarray:
    return np.array([[[value * alpha] * 3 + [alpha]]], np.float32)


@given(st.floats(0, 20), st.floats(0, 20))
def test_brighter_light_never_looks_darker(one: float, two: float) -> None:
    low, high = sorted((one, two))
    assert display(gray(low))[0, 0, 0] <= display(gray(high))[0, 0, 0]


@given(st.floats(0, SHOULDER))
def test_below_the_shoulder_it_is_plain_srgb(value: float) -> None:
    """float32 input may fall on the other side of a rounding: one step of 255."""
    got = int(display(gray(value))[0, 0, 0])
    assert abs(got - float(srgb_from_linear(np.array(value))) * 255) <= 0.5 + 1e-4


def test_the_shoulder_has_no_step_and_no_kink() -> None:
    """Linear values a step of 1e-4 around it: slopes on both sides agree to first order."""
    x = SHOULDER + np.arange(-3, 4) * 1e-4
    bent = np.where(
        x > SHOULDER, SHOULDER - (1 - SHOULDER) * np.expm1(-(x - SHOULDER) / (1 - SHOULDER)), x
    )
    np.testing.assert_allclose(np.diff(bent), 1e-4, rtol=2e-3)
    assert display(gray(1e4))[0, 0, 0] == 255


@given(st.floats(0, 2), st.integers(1, 255))
def test_color_is_straight_and_alpha_linear(value: float, alpha: int) -> None:
    """One step: the product value * alpha is rounded to float32 before it is divided again."""
    shown = display(gray(value, alpha / 255))[0, 0].astype(int)
    assert shown[3] == alpha
    assert abs(shown[0] - int(display(gray(value))[0, 0, 0])) <= 1


def test_nothing_shows_where_alpha_is_zero() -> None:
    leaked = np.array([[[0.1, 0.2, 0.3, 0.0]]], np.float32)
    assert not display(leaked).any()


def test_known_values_of_the_transfer_curve() -> None:
    """IEC 61966-2-1: 0.5 gray in sRGB is 0.2140 linear."""
    assert float(srgb_from_linear(np.array(0.21404114))) == pytest.approx(0.5, abs=1e-6)
    assert srgb_from_linear(np.array([0.0, 1.0])).tolist() == pytest.approx([0, 1], abs=1e-12)


def test_png_bytes_repeat(tmp_path: Path) -> None:
    image = np.random.default_rng(0).integers(0, 255, (9, 7, 4), np.uint8)
    assert png_file(image) == png_file(image.copy())


def write_exr(path: Path, pixels: np.ndarray) -> None:
    height, width, channels = pixels.shape
    out = oiio.ImageOutput.create(str(path))
    out.open(str(path), oiio.ImageSpec(width, height, channels, "float"))
    out.write_image(pixels.astype(np.float32))
    out.close()


def test_exr_comes_back(tmp_path: Path) -> None:
    pixels = np.random.default_rng(1).random((5, 4, 4), np.float32)
    write_exr(tmp_path / "a.exr", pixels)
    assert np.array_equal(read_exr(tmp_path / "a.exr"), pixels)


@pytest.mark.parametrize(
    ("name", "pixels", "said"),
    [
        ("nan", np.full((4, 4, 4), np.nan), "not finite"),
        ("rgb", np.ones((4, 4, 3)), "not a whole RGBA image"),
    ],
)
def test_a_bad_image_is_refused(tmp_path: Path, name: str, pixels: np.ndarray, said: str) -> None:
    write_exr(tmp_path / f"{name}.exr", pixels)
    with pytest.raises(RenderError, match=said):
        read_exr(tmp_path / f"{name}.exr")


def test_a_missing_or_cut_image_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RenderError, match="cannot be read"):
        read_exr(tmp_path / "none.exr")
    write_exr(tmp_path / "cut.exr", np.random.default_rng(0).random((64, 64, 4)))
    whole = (tmp_path / "cut.exr").read_bytes()
    (tmp_path / "cut.exr").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(RenderError):
        read_exr(tmp_path / "cut.exr")
