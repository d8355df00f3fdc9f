"""Prints of control panels."""

import dataclasses

import numpy as np
import pytest

from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.control_console import ConsoleStyle, lit, printed
from artgen.textures import texture_set
from artgen.textures.appliance_panel import BRANDS, PROGRAMS, layout_of
from artgen.textures.draw import Sheet

FACE = SurfaceSpec(name="fascia", recipe="plain", color=(0.85, 0.85, 0.85))
SIZES = [(0.595, 0.12), (0.445, 0.09), (0.595, 0.038), (0.445, 0.038)]


def panel(size: tuple[float, float], style: str, brand: int = 0) -> SurfaceSpec:
    console = ConsoleStyle(
        style=style, buttons=5, display=True, brand=brand, words="1:25", led="red"
    )
    return printed(FACE, console, size)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("style", ["buttons", "touch", "knob"])
def test_words_end_before_the_next_thing_begins(size: tuple[float, float], style: str) -> None:
    """The brand ends left of display or of the program names; those end left of the buttons."""
    spec = panel(size, style)
    layout = layout_of(spec)
    pixels = (1024, round(1024 * size[1] / size[0]))  # Square, as the recipe draws them.
    sheet = Sheet(size, pixels=pixels, background="#ffffff")
    brand = max(sheet.text_width(word, height=layout.cap) for word in BRANDS)
    middle = layout.knob or layout.display
    assert middle is not None
    names = 0.0
    if layout.knob is not None:
        cap = min(0.0048, 0.07 * size[1])
        names = 0.013 + max(sheet.text_width(name, height=cap) for name in PROGRAMS)
    half = 0.5 * middle.size[0] + names
    assert layout.brand[0] + brand < middle.center[0] - half
    assert middle.center[0] + half < layout.buttons[0].center[0] - 0.5 * layout.buttons[0].size[0]


@pytest.mark.parametrize("style", ["buttons", "touch", "knob"])
def test_print_covers_little_of_the_ground(style: str) -> None:
    image = texture_set(panel((0.595, 0.12), style)).color
    assert image is not None
    ground = np.median(image.reshape(-1, 3), axis=0)
    inked = (np.abs(image.astype(float) - ground).max(axis=2) > 40).mean()
    assert 0.002 < inked < 0.08
    assert (image[:2] == image[0, 0]).all()  # Nothing runs over the edge.
    assert (image[-2:] == image[0, 0]).all()


def test_every_brand_has_its_print() -> None:
    images = [texture_set(panel((0.595, 0.12), "touch", k)).color for k in range(len(BRANDS))]
    assert len({image.tobytes() for image in images if image is not None}) == len(BRANDS)


def test_brushed_ground_has_streaks_along_the_panel() -> None:
    """Neighbors along u are alike, neighbors across are not."""
    steel = dataclasses.replace(FACE, metallic=1.0)
    console = ConsoleStyle(
        style="touch", buttons=4, display=False, brand=0, words="1:25", led="red"
    )
    image = texture_set(printed(steel, console, (0.595, 0.12))).color
    assert image is not None
    blank = image[5:60, 700:900, 0].astype(float)
    along, across = np.abs(np.diff(blank, axis=1)).mean(), np.abs(np.diff(blank, axis=0)).mean()
    assert along < 0.2 * across


def test_a_display_shines_where_its_digits_are() -> None:
    console = ConsoleStyle(
        style="touch", buttons=4, display=True, brand=0, words="1:25", led="white"
    )
    images = texture_set(lit(console, (0.08, 0.03)))
    assert images.color is not None
    assert images.emission is not None
    shining = images.emission.max(axis=2) > 128
    assert 0.02 < shining.mean() < 0.25
    assert images.color[shining].mean() > 128
    assert images.color[~shining].mean() < 40
