"""Light and color of ray-cast images: several lights, an ambient sky, surfaces a little off."""

from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from artgen.core.stream import Stream
from model.batch import TensorBlock

LIGHTS = 3
"""Directional lights: a key, a fill and a weak one from anywhere."""
POWER = ((0.6, 1.4), (0.1, 0.6), (0.0, 0.4))
"""Range of each light's strength; a white diffuser that looks into a light of 1 shows 1."""
AMBIENT = (0.25, 0.6)
"""Range of the sky's strength; the ground gives back `GROUND` of it."""
GROUND = (0.3, 0.9)
TINT = 0.12
"""Deviation of the logarithm of a light's color channels."""
JITTER = 0.18
"""Deviation of the logarithm of a surface's color channels, common and each."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Look:
    """What the draws of one item decide.

    Attributes:
        toward: (LIGHTS, 3) unit vectors from the object to each light, object axes.
        power: (LIGHTS, 3) linear RGB.
        sky: (3,) linear RGB from above.
        ground: (3,) linear RGB from below.
        gains: (S, 3) factors on the surfaces' colors.
    """

    toward: NDArray[np.float64]
    power: NDArray[np.float64]
    sky: NDArray[np.float64]
    ground: NDArray[np.float64]
    gains: NDArray[np.float64]


def drawn_look(surfaces: int, stream: Stream) -> Look:
    """Lights, sky and color of an item whose object has so many surfaces."""
    rng = stream.child("lights").generator()
    toward = rng.normal(size=(LIGHTS, 3))
    toward[0, 2] = abs(toward[0, 2])
    toward[:2, 1] = -np.abs(toward[:2, 1])  # Key and fill come from the front's side.
    toward /= np.linalg.norm(toward, axis=1, keepdims=True)
    low, high = np.transpose(POWER)
    power = low + (high - low) * rng.random(LIGHTS)
    tints = np.exp(TINT * rng.normal(size=(LIGHTS, 3)))
    around = stream.child("ambient").generator()
    sky = (AMBIENT[0] + np.ptp(AMBIENT) * around.random()) * np.exp(TINT * around.normal(size=3))
    back = (GROUND[0] + np.ptp(GROUND) * around.random()) * np.exp(TINT * around.normal(size=3))
    color = stream.child("color").generator()
    gains = JITTER * color.normal(size=(surfaces, 1)) + JITTER * color.normal(size=(surfaces, 3))
    return Look(
        toward=toward,
        power=power[:, None] * tints,
        sky=sky,
        ground=sky * back,
        gains=np.exp(gains),
    )


@dataclass(frozen=True, kw_only=True)
class Lighting(TensorBlock):
    """Looks of B items.

    Attributes:
        toward_BL3: as `Look.toward`.
        power_BL3: linear.
        sky_B3: linear.
        ground_B3: linear.
    """

    toward_BL3: Tensor
    power_BL3: Tensor
    sky_B3: Tensor
    ground_B3: Tensor


def lighting(looks: list[Look], device: torch.device) -> Lighting:
    """Looks together."""

    def stacked(arrays: list[NDArray[np.float64]]) -> Tensor:
        return torch.from_numpy(np.stack(arrays).astype(np.float32)).to(device)

    return Lighting(
        toward_BL3=stacked([look.toward for look in looks]),
        power_BL3=stacked([look.power for look in looks]),
        sky_B3=stacked([look.sky for look in looks]),
        ground_B3=stacked([look.ground for look in looks]),
    )


def shaded(
    look_N6: Tensor, normal_N3: Tensor, sight_N3: Tensor, lights: Lighting, item_N: Tensor
) -> Tensor:
    """(N, 3) sRGB in [0, 1] of surface points; diffuse, a Blinn lobe, a two-colored sky.

    Args:
        look_N6: linear RGB, roughness, metallic, emission.
        normal_N3: unit, outward.
        sight_N3: unit, from the eye to the point.
        item_N: whose light falls on it.
    """
    color, (roughness, metallic, emission) = look_N6[:, :3], look_N6[:, 3:, None].unbind(dim=1)
    up = 0.5 + 0.5 * normal_N3[:, 2:]
    sky, ground, toward_NL3, power_NL3 = (
        rows if len(rows) == 1 else rows[item_N]  # One item's rows serve all points as they are.
        for rows in (lights.sky_B3, lights.ground_B3, lights.toward_BL3, lights.power_BL3)
    )
    around = up * sky + (1.0 - up) * ground
    sharpness = 2.0 / roughness.clamp(min=0.15) ** 2
    gloss = torch.lerp(torch.full_like(color, 0.04), color, metallic)
    diffuse = around
    shine = around
    for k in range(LIGHTS):
        toward, power = toward_NL3[:, k], power_NL3[:, k]
        facing = (normal_N3 * toward).sum(dim=1, keepdim=True).clamp(min=0.0)
        halfway = torch.nn.functional.normalize(toward - sight_N3, dim=1)
        lobe = (normal_N3 * halfway).sum(dim=1, keepdim=True).clamp(min=0.0) ** sharpness
        diffuse = diffuse + power * facing
        shine = shine + power * facing * lobe * (0.125 * sharpness + 0.25)
    linear = color * (1.0 - metallic) * diffuse + gloss * shine + color * emission
    return encoded(linear)


def encoded(linear: Tensor) -> Tensor:
    """Linear light to sRGB in [0, 1] (IEC 61966-2-1)."""
    bright = linear.clamp(0.0, 1.0)
    curve = 1.055 * bright.clamp(min=0.0031308) ** (1.0 / 2.4) - 0.055
    return torch.where(bright <= 0.0031308, 12.92 * bright, curve)
