"""What is printed on a kettle: its water gauge with the maker's name, or a badge."""

from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.kettle_params import KettleParams
from artgen.generators.kit.printed import area, line, printed, words
from artgen.textures.appliance_panel import BRANDS

LITRES = (0.5, 1.0, 1.5, 1.7)


def gauge_print(p: KettleParams, size: tuple[float, float]) -> SurfaceSpec:
    """A window with water behind its scale, from MIN to MAX."""
    width, tall = size
    brand = BRANDS[p.brand]
    if not p.gauge:
        mark = words((width / 2.0, tall / 2.0), brand, cap=0.0038, ink="#2b2d30")
        return printed(
            "gauge", size, background="#c9cacb", marks=[mark], roughness=0.3, metallic=1.0
        )
    edge, low, high = 0.0022, 0.012, tall - 0.010
    level = low + (high - low) * (0.25 + 0.5 * p.gauge_share)
    marks = [
        area((edge, 0.006), (width - edge, tall - 0.005), ink="#39424a", radius=0.006),
        area((edge, 0.006), (width - edge, level), ink="#7fa3b4", radius=0.006),
        line([(edge, level), (width - edge, level)], width=0.0006, ink="#d5e6ee"),
    ]
    for k, litres in enumerate(LITRES):
        z = low + (high - low) * litres / LITRES[-1]
        marks.append(line([(edge + 0.001, z), (edge + 0.005, z)], width=0.0005, ink="#ffffff"))
        text = "MAX" if k == len(LITRES) - 1 else f"{litres:.1f}L"
        marks.append(words((width - 0.0068, z), text, cap=0.0024, ink="#ffffff"))
    marks.append(line([(edge + 0.001, low), (edge + 0.005, low)], width=0.0005, ink="#ffffff"))
    marks.append(words((width - 0.0068, low), "MIN", cap=0.0020, ink="#ffffff"))
    return printed("gauge", size, background="#202326", marks=marks, roughness=0.12)
