"""Laws of the pieces that laptops are made of."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.generators.kit.barrel import Barrels, free_spans, one_long_hinge, pockets, two_hinges
from artgen.generators.kit.keyboard import Keycap, keycap
from artgen.generators.kit.lofted_shell import cover, tray
from artgen.generators.kit.side_port import SOCKETS, fitting, side_port
from artgen.geometry.solid import slab
from artgen.textures.keyboard_layout import ARROWS, SIDE_UNITS, KeyboardStyle, keyboard_keys

SMALL = st.floats(0.001, 0.004)


@given(st.floats(0.006, 0.12), st.floats(0.006, 0.02), st.sampled_from([0.0009, 0.0034]))
@settings(deadline=None)
def test_a_keycap_is_convex_and_fills_its_cell_at_the_foot(
    width: float, depth: float, smile: float
) -> None:
    cap = keycap((width, depth), Keycap(height=0.002, taper=0.0004, corner=0.0009, smile=smile))
    # manifold3d merges points closer than 1e-12 of the extent; both volumes are sums of 36 terms.
    assert cap.hull().volume - cap.volume < 1e-15
    assert np.allclose(cap.extent, (width, depth, 0.002), rtol=0.0, atol=1e-12)
    assert len(cap.trimesh().faces) <= 36


@pytest.mark.parametrize("block", sorted(SIDE_UNITS))
@pytest.mark.parametrize("arrows", ARROWS)
def test_keys_lie_in_their_field_and_apart(block: str, arrows: str) -> None:
    style = KeyboardStyle(
        block=block, arrows=arrows, pitch=0.019, row_pitch=0.0185, gap=0.003, function_share=0.55,
        power_key=True,
    )  # fmt: skip
    keys = keyboard_keys(style)
    center, half = (np.array([getattr(k, n) for k in keys]) for n in ("center", "size"))
    half = half / 2.0
    assert (center - half >= 0.003 / 2.0 - 1e-12).all()
    assert (center + half <= np.array(style.size) - 0.003 / 2.0 + 1e-12).all()
    apart = np.abs(center[:, None] - center[None]) - half[:, None] - half[None]
    apart = apart.max(axis=2)
    np.fill_diagonal(apart, np.inf)
    assert apart.min() >= 0.003 - 1e-12
    assert [k.legend for k in keys].count("power") == 1


def test_letters_are_staggered_and_the_function_row_is_low() -> None:
    style = KeyboardStyle(
        block="compact", arrows="half", pitch=0.019, row_pitch=0.019, gap=0.003,
        function_share=0.55, power_key=False,
    )  # fmt: skip
    keys = {key.legend: key for key in keyboard_keys(style)}
    q, a, z = (keys[letter].center[0] for letter in "QAZ")
    # A quarter and half a unit, as on typewriters.
    assert np.allclose((a - q, z - a), (0.25 * 0.019, 0.5 * 0.019), rtol=0.0, atol=1e-12)
    assert keys["F1"].size[1] < 0.6 * keys["Q"].size[1]
    assert keys[""].size[0] > 4.0 * keys["Q"].size[0]


@given(st.floats(0.26, 0.41), st.floats(0.60, 0.76), st.floats(0.02, 0.03), SMALL)
@settings(deadline=None, max_examples=25)
def test_pockets_free_the_lids_knuckles_and_nothing_beside_them(
    width: float, place: float, length: float, radius: float
) -> None:
    for base, lid in (
        two_hinges(width=width, place=place * width / 2.0, length=length, base_length=0.006),
        one_long_hinge(length=0.7 * width, base_length=0.01),
    ):
        barrels = Barrels(y=0.2, z=0.01, radius=radius, base=base, lid=lid)
        cut = pockets(barrels, clearance=0.001, depth=radius + 0.001, rear=0.22)
        block = slab((-width / 2.0, 0.0, -0.02), (width / 2.0, 0.21, 0.01)) - cut
        for span in barrels.lid:
            assert (block & barrels.knuckle(span)).is_empty
        for left, right in free_spans(barrels, width=width):
            kept = slab((left, 0.19, 0.0), (right, 0.21, 0.01))
            # Faces that touch leave slivers of 1e-12 m times the area.
            assert (kept - block).is_empty or (kept - block).volume < 1e-12


def test_shells_keep_their_bounds() -> None:
    box = tray(x=0.15, y=(0.0, 0.21), z=(0.001, 0.013), radii=(0.01, 0.006), belly=0.003,
               nose=(0.04, 0.006))  # fmt: skip
    lid = cover(x=0.15, y=(0.0, 0.2), z=(0.013, 0.018), radii=(0.01, 0.003), crown=0.002)
    for solid, lower, upper in (
        (box, (-0.15, 0.0, 0.001), (0.15, 0.21, 0.013)),
        (lid, (-0.15, 0.0, 0.013), (0.15, 0.2, 0.018)),
    ):
        assert np.allclose(solid.bounds, (lower, upper), rtol=0.0, atol=1e-12)
        assert 0.8 < solid.volume / np.prod(solid.extent) < 1.0


@pytest.mark.parametrize("kind", sorted(SOCKETS))
@pytest.mark.parametrize("face", [-0.15, 0.15])
def test_a_socket_fills_its_own_cut_from_behind_the_face(kind: str, face: float) -> None:
    cut, bodies = side_port(kind, face=face, y=0.1, z=0.01)
    for body in bodies:
        # Arcs are the same chords in cut and body; only rounding is left outside.
        outside = body.solid - cut
        assert outside.is_empty or outside.volume < 1e-15
        assert np.abs(body.solid.bounds[:, 0]).max() < 0.15 - 0.0003
    assert (bodies[0].solid & bodies[1].solid).volume < 1e-15
    assert np.allclose(cut.bounds.mean(axis=0)[1:], (0.1, 0.01), rtol=0.0, atol=1e-12)


def test_low_walls_hold_flat_sockets_alone() -> None:
    assert fitting(("usb_a", "audio", "usb_c"), room=0.005) == ("usb_c", "usb_c", "usb_c")
    assert fitting(("usb_a", "hdmi"), room=0.007) == ("usb_a", "hdmi")
