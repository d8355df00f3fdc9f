"""Colors between sRGB and linear light."""

from hypothesis import given
from hypothesis import strategies as st

from artgen.core.surface import linear_color, linear_from_srgb, srgb_from_linear, srgb_hex


@given(st.floats(0.0, 1.0))
def test_the_curves_undo_each_other(value: float) -> None:
    """A power and its inverse round a few times, each by 1.1e-16 of at most 1. IEC 61966-2-1 rounds
    its constants: at the seam `linear_from_srgb` jumps by 2.3e-9, and what lies in between is lost
    by as much."""
    assert abs(srgb_from_linear(linear_from_srgb(value)) - value) <= 1e-14
    assert abs(linear_from_srgb(srgb_from_linear(value)) - value) <= 3e-9


@given(st.integers(0, 255))
def test_bytes_come_back(byte: int) -> None:
    text = f"#{byte:02x}" + "00ff"
    assert srgb_hex(linear_color(text)) == text
