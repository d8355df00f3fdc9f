"""Procedural outdoor surroundings: clear skies with a sun, and overcast ones.

Clear: Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight" (SIGGRAPH 1999): Perez'
luminance distribution, chromaticities by turbidity, and the sun through Rayleigh, aerosol and ozone
losses (its appendix). Overcast: the CIE standard overcast sky. Radiance is in kcd/m2 until a rig
scales it; the ground is a gray diffuser under the same sky.
"""

import math
from dataclasses import dataclass

import numpy as np

from artgen.core.camera import orbit_direction
from artgen.core.mesh import Floats
from renders.fast.filtered import directions, solid_angles

SUN_RADIUS = math.radians(1.2)
"""The real sun's is 0.27 degrees; spread out, it keeps its power, as through a thin haze, and maps
of 128 rows hold it."""
GROUND = 0.22
"""Albedo of what lies below the horizon: soil, paving."""
SUN_ILLUMINANCE = 128.0
"""klx above the atmosphere."""
WAVELENGTHS = np.array([0.65, 0.55, 0.45])
"""um, standing for red, green, blue."""
SUN_COLOR = np.array([1.0, 0.99, 0.95])
"""Of the solar spectrum there, over green."""
OZONE = np.array([0.06, 0.085, 0.003])
"""Absorption by ozone at the wavelengths, 1/cm; the model's layer is 0.35 cm."""
RGB_FROM_XYZ = np.array(
    [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
     [0.0556434, -0.2040259, 1.0572252]]
)  # fmt: skip
"""Linear Rec.709 (IEC 61966-2-1)."""


@dataclass(frozen=True, kw_only=True)
class Weather:
    """A sky.

    Attributes:
        azimuth, elevation: of the sun, as of cameras, rad.
        turbidity: 2 is a clear, 6 a hazy day.
        overcast: no sun is seen; turbidity and azimuth mean nothing.
    """

    azimuth: float
    elevation: float
    turbidity: float
    overcast: bool = False


def sky_map(weather: Weather, height: int) -> Floats:
    """(H, 2 H, 3) radiance all around, kcd/m2 of each primary."""
    towards = directions(height)
    above = towards[..., 2] > 0.0
    sky = _overcast(towards) if weather.overcast else _clear(weather, towards)
    sky = np.where(above[..., None], sky, 0.0)
    if not weather.overcast:
        sky += _sun(weather, towards, height)
    falling = solid_angles(height)[:, None] * np.maximum(towards[..., 2], 0.0)
    ground = GROUND * np.einsum("hw,hwc->c", falling, sky) / math.pi
    return np.where(above[..., None], sky, ground)


def _overcast(towards: Floats) -> Floats:
    """CIE overcast: three times as bright at the zenith as at the horizon; slightly blue."""
    bright = 9.0 * (1.0 + 2.0 * np.maximum(towards[..., 2], 0.0)) / 3.0
    return bright[..., None] * np.array([0.97, 1.0, 1.04])


def _clear(weather: Weather, towards: Floats) -> Floats:
    sun = orbit_direction(weather.azimuth, weather.elevation)
    t, zenith = weather.turbidity, math.pi / 2.0 - weather.elevation
    cosine = np.maximum(towards[..., 2], 0.01)  # the model ends at the horizon
    gamma = np.arccos(np.clip(towards @ sun, -1.0, 1.0))
    chi = (4.0 / 9.0 - t / 120.0) * (math.pi - 2.0 * zenith)
    top = (4.0453 * t - 4.9710) * math.tan(chi) - 0.2155 * t + 2.4192
    powers = np.array([zenith**3, zenith**2, zenith, 1.0])
    turbidities = np.array([t * t, t, 1.0])
    top_x, top_y = (float(turbidities @ table @ powers) for table in (_ZENITH_X, _ZENITH_Y))
    luminance, x, y = (
        value * _perez(row, cosine, gamma) / _perez(row, np.array(1.0), np.array(zenith))
        for value, row in (
            (top, _LUMINANCE @ (t, 1.0)),
            (top_x, _X @ (t, 1.0)),
            (top_y, _Y @ (t, 1.0)),
        )
    )
    luminance = np.maximum(luminance, 0.0)
    xyz = np.stack([luminance * x / y, luminance, luminance * (1.0 - x - y) / y], axis=-1)
    return np.asarray(np.maximum(xyz @ RGB_FROM_XYZ.T, 0.0))


def _perez(row: Floats, cosine: Floats, gamma: Floats) -> Floats:
    """Perez' function of five coefficients, of the cosine of the zenith angle and of the angle to
    the sun."""
    a, b, c, d, e = row
    return np.asarray(
        (1.0 + a * np.exp(b / cosine)) * (1.0 + c * np.exp(d * gamma) + e * np.cos(gamma) ** 2)
    )


def _sun(weather: Weather, towards: Floats, height: int) -> Floats:
    """The disc alone; its pixels hold the sun's whole illuminance at whatever resolution."""
    sun = orbit_direction(weather.azimuth, weather.elevation)
    away = np.arccos(np.clip(towards @ sun, -1.0, 1.0))
    pixel = math.pi / height
    weight = np.clip((SUN_RADIUS - away) / pixel + 0.5, 0.0, 1.0)
    power = float((solid_angles(height)[:, None] * weight).sum())
    return np.asarray(weight[..., None] * sunlight(weather) / power)


def sunlight(weather: Weather) -> Floats:
    """(3,) klx of each primary on a surface that faces the sun (Preetham 1999, appendix)."""
    degrees = 90.0 - math.degrees(weather.elevation)
    mass = 1.0 / (math.cos(math.radians(degrees)) + 0.15 * (93.885 - degrees) ** -1.253)
    haze = 0.04608 * weather.turbidity - 0.04586
    rayleigh = np.exp(-0.008735 * mass * WAVELENGTHS**-4.08)
    aerosol = np.exp(-haze * mass * WAVELENGTHS**-1.3)
    ozone = np.exp(-0.35 * OZONE * mass)
    return np.asarray(SUN_ILLUMINANCE * SUN_COLOR * rayleigh * aerosol * ozone)


_LUMINANCE = np.array(
    [[0.1787, -1.4630], [-0.3554, 0.4275], [-0.0227, 5.3251], [0.1206, -2.5771], [-0.0670, 0.3703]]
)
_X = np.array(
    [[-0.0193, -0.2592], [-0.0665, 0.0008], [-0.0004, 0.2125], [-0.0641, -0.8989],
     [-0.0033, 0.0452]]
)  # fmt: skip
_Y = np.array(
    [[-0.0167, -0.2608], [-0.0950, 0.0092], [-0.0079, 0.2102], [-0.0441, -1.6537],
     [-0.0109, 0.0529]]
)  # fmt: skip
_ZENITH_X = np.array(
    [[0.00166, -0.00375, 0.00209, 0.0], [-0.02903, 0.06377, -0.03202, 0.00394],
     [0.11693, -0.21196, 0.06052, 0.25886]]
)  # fmt: skip
_ZENITH_Y = np.array(
    [[0.00275, -0.00610, 0.00317, 0.0], [-0.04214, 0.08970, -0.04153, 0.00516],
     [0.15346, -0.26756, 0.06670, 0.26688]]
)  # fmt: skip
