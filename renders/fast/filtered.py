"""What a rig shows: the sky as spherical harmonics, the surrounding blurred by roughness.

Both work on equirectangular images of radiance as `artgen.render_job.Environment` defines them.
"""

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats

HEIGHT = 64
LAYERS = 8
"""Roughness 0 to 1 in even steps."""


def directions(height: int) -> Floats:
    """(H, 2 H, 3) unit vectors of the pixels' middles."""
    elevation = np.pi / 2.0 - np.pi * (np.arange(height) + 0.5) / height
    azimuth = np.pi * (np.arange(2 * height) + 0.5) / height - np.pi
    flat = np.cos(elevation)[:, None]
    return np.stack(
        [
            flat * np.sin(azimuth),
            -flat * np.cos(azimuth),
            np.broadcast_to(np.sin(elevation)[:, None], (height, 2 * height)),
        ],
        axis=-1,
    )


def solid_angles(height: int) -> Floats:
    """(H,) sr of one pixel of each row."""
    edges = np.sin(np.pi / 2.0 - np.pi * np.arange(height + 1) / height)
    return -np.diff(edges) * np.pi / height


def basis(vectors: Floats) -> Floats:
    """(..., 9) real polynomials of degree 0, 1 and 2, not normalized."""
    x, y, z = np.moveaxis(vectors, -1, 0)
    one = np.ones_like(x)
    return np.stack([one, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y], axis=-1)


NORM = np.array([1.0, 3.0, 3.0, 3.0, 15.0, 15.0, 5.0 / 4.0, 15.0, 15.0 / 4.0]) / (4.0 * np.pi)
"""Squared normalization of each polynomial of `basis`."""
COSINE = np.array([1.0, *[2.0 / 3.0] * 3, *[0.25] * 5])
"""What a cosine lobe, divided by pi, leaves of each degree (Ramamoorthi and Hanrahan 2001)."""


def white_wall(radiance: Floats) -> Floats:
    """(9, 3) factors of `basis`: radiance of a white wall by its normal, degree 2.

    Args:
        radiance: (H, 2 H, 3) equirectangular.
    """
    height = len(radiance)
    weight = solid_angles(height)[:, None, None] * radiance
    moments = np.einsum("hwk,hwc->kc", basis(directions(height)), weight)
    return np.asarray((NORM * COSINE)[:, None] * moments)


class Blur:
    """Filters surroundings by the lobe of each roughness; made once, as no rig changes the lobes.

    For a normal that is also the direction of view (Karis 2013) the lobe depends on the angle to
    the normal alone, so along a row it is a convolution, which Fourier factors turn into products.
    """

    def __init__(self) -> None:
        towards = directions(HEIGHT)
        first = towards[:, 0]
        cosine = np.einsum("id,jwd->ijw", first, towards)
        area = solid_angles(HEIGHT)[None, :, None]
        self._factors = [_factors(cosine, area, (k / (LAYERS - 1)) ** 2) for k in range(1, LAYERS)]

    def __call__(self, radiance: Floats) -> NDArray[np.float32]:
        """(LAYERS, H, 2 H, 3) of a (H, 2 H, 3) image with H = HEIGHT; layer 0 is the image."""
        rows = np.fft.rfft(radiance, axis=1).transpose(1, 0, 2)
        parts = np.concatenate([rows.real, rows.imag], axis=2).astype(np.float32)
        layers = [radiance]
        for factors in self._factors:
            real, imaginary = np.split(factors @ parts, 2, axis=2)
            spread = (real + 1j * imaginary).transpose(1, 0, 2)
            layers.append(np.fft.irfft(spread, n=2 * HEIGHT, axis=1))
        return np.maximum(np.stack(layers), 0.0).astype(np.float32)


def _factors(cosine: Floats, area: Floats, alpha: float) -> NDArray[np.float32]:
    """(H + 1, H, H) Fourier factors of the GGX lobe of `alpha` about each row's first pixel; real,
    as the lobe is symmetric.

    A pixel is 3 degrees wide, so the lobe is kept no narrower than that."""
    squared = max(alpha, 0.03) ** 2
    half = 0.5 * (1.0 + cosine)  # squared cosine between the normal and the half vector
    density = squared / (np.pi * (half * (squared - 1.0) + 1.0) ** 2)
    weight = area * density * np.maximum(cosine, 0.0)
    weight /= weight.sum(axis=(1, 2), keepdims=True)
    factors = np.fft.rfft(weight, axis=2).real.transpose(2, 0, 1)
    return np.ascontiguousarray(factors, np.float32)


def split_sum(size: int = 32, samples: int = 256) -> NDArray[np.float32]:
    """(size, size, 2) scale and bias of the specular color, by roughness (rows) and the cosine to
    the eye (columns), texel middles; GGX with Smith's shadowing (Karis 2013, listing 4)."""
    middle = (np.arange(size) + 0.5) / size
    facing, alpha = middle[None, :, None], (middle**2)[:, None, None]
    turn, height = _points(samples)
    tilt = np.sqrt((1.0 - height) / (1.0 + (alpha**2 - 1.0) * height))
    lean = np.sqrt(np.maximum(0.0, 1.0 - tilt**2))
    across = np.sqrt(1.0 - facing**2)
    half = np.maximum(across * lean * np.cos(turn) + facing * tilt, 1e-6)
    out = 2.0 * half * tilt - facing
    lit = np.maximum(out, 1e-6)
    seen = 1.0 / (1.0 + _masked(lit, alpha) + _masked(facing, alpha))
    weight = np.where(out > 0.0, seen * half / (tilt * facing), 0.0)
    grazing = (1.0 - half) ** 5
    pair = np.stack([(1.0 - grazing) * weight, grazing * weight], axis=-1)
    return pair.mean(axis=2).astype(np.float32)


def _points(count: int) -> tuple[Floats, Floats]:
    """Even points: an angle, which steps by the golden section, and a number in (0, 1)."""
    index = np.arange(count)
    return 2.0 * np.pi * (index * 0.6180339887498949 % 1.0), (index + 0.5) / count


def _masked(cosine: Floats, alpha: Floats) -> Floats:
    """Smith's Lambda of GGX."""
    return 0.5 * (np.sqrt(1.0 + alpha**2 * (1.0 / cosine**2 - 1.0)) - 1.0)
