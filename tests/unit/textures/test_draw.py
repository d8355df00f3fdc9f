import numpy as np
import pytest

from artgen.core.errors import UsageError
from artgen.textures.draw import SEGMENTS, Sheet
from artgen.textures.icons import ICONS, draw_icon


def sheet(pixels=(80, 40)):
    return Sheet((0.2, 0.1), pixels=pixels, background="#000000")


def lit(image):
    """Lower left and upper right of the pixels that are not black, as shares of the sheet."""
    rows, columns = np.nonzero(image.sum(axis=2))
    height, width = image.shape[:2]
    return (columns.min() / width, 1.0 - (rows.max() + 1) / height), (
        (columns.max() + 1) / width,
        1.0 - rows.min() / height,
    )


def test_coordinates_start_at_the_lower_left():
    page = sheet()
    page.box((0.05, 0.075), (0.1, 0.1), fill="#ff0000")
    expected = np.zeros((40, 80, 3), np.uint8)
    expected[:10, 20:40, 0] = 255
    assert np.array_equal(page.image(), expected)


def test_a_disc_has_its_area():
    """Its border of 2 pi r = 113 finer pixels is right to half a pixel on average: 5 % at most."""
    page = sheet()
    page.disc((0.1, 0.05), 0.0225, fill="#ffffff")
    covered = page.image()[..., 0].sum() / 255.0 / (80 * 40) * 0.2 * 0.1
    assert covered == pytest.approx(np.pi * 0.0225**2, rel=0.05)


def test_capitals_have_the_height_asked_for():
    """A finer pixel is 1/160 of the sheet; hinting moves either end by one, drawing by one."""
    page = sheet((320, 160))
    page.text((0.1, 0.05), "HHH", height=0.04, fill="#ffffff")
    (_, low), (_, high) = lit(page.image())
    assert low == pytest.approx(0.3, abs=2 / 160)
    assert high == pytest.approx(0.7, abs=2 / 160)


@pytest.mark.parametrize(("anchor", "start"), [("left", 0.1), ("middle", 0.07), ("right", 0.04)])
def test_text_is_anchored(anchor, start):
    """The letters' own margins, a tenth of their height, stand between anchor and ink."""
    page = sheet((320, 160))
    length = page.text_width("HELLO", height=0.02)
    shift = {"left": 0.0, "middle": -length / 2.0, "right": -length}[anchor]
    page.text((0.1, 0.05), "HELLO", height=0.02, fill="#ffffff", anchor=anchor)
    (left, _), (right, _) = lit(page.image())
    assert left * 0.2 == pytest.approx(0.1 + shift, abs=0.003)
    assert right * 0.2 == pytest.approx(0.1 + shift + length, abs=0.003)


def test_all_digits_look_different():
    drawn = set()
    for word in SEGMENTS:
        page = sheet()
        page.digits((0.08, 0.03), word, height=0.04, fill="#ffffff")
        drawn.add(page.image().tobytes())
    assert len(drawn) == len(SEGMENTS)


def test_digits_tell_their_length():
    page = sheet((320, 160))
    length = page.digits((0.03, 0.03), "8:88", height=0.04, fill="#ffffff")
    (left, low), (right, high) = lit(page.image())
    assert (right - left) * 0.2 == pytest.approx(length, abs=0.006)  # a bar's width on each side
    assert (high - low) * 0.1 == pytest.approx(0.04, abs=0.006)


@pytest.mark.parametrize("name", sorted(ICONS))
def test_icons_stay_in_their_square(name):
    """Line ends stick out by half a line, 0.05 of the size."""
    page = sheet((320, 160))
    draw_icon(page, (0.1, 0.05), name, size=0.06, fill="#ffffff")
    (left, low), (right, high) = lit(page.image())
    assert min(left * 0.2 - 0.07, 0.13 - right * 0.2) >= -0.05 * 0.06 - 0.001
    assert min(low * 0.1 - 0.02, 0.08 - high * 0.1) >= -0.05 * 0.06 - 0.001
    assert page.image().mean() > 1.0


def test_a_picture_fills_its_corners():
    page = sheet()
    page.picture((0.1, 0.05), (0.2, 0.1), np.full((5, 5, 3), 200, np.uint8))
    expected = np.zeros((40, 80, 3), np.uint8)
    expected[:20, 40:] = 200
    assert np.array_equal(page.image(), expected)


def test_faults_are_told():
    with pytest.raises(UsageError, match="digit 'X'"):
        sheet().digits((0.0, 0.0), "1X", height=0.01, fill="#ffffff")
    with pytest.raises(UsageError, match="no icon 'snow'"):
        draw_icon(sheet(), (0.0, 0.0), "snow", size=0.01, fill="#ffffff")
    with pytest.raises(UsageError, match="is empty"):
        Sheet((0.0, 1.0), pixels=(4, 4), background="#000000")
