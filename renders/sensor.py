"""What a real camera adds to a composite after rendering; every effect is off unless asked for.

Light passes the lens and the shutter, falls on the sensor, is developed and compressed: defocus,
exposure, white balance and noise act on linear radiance in this order, then the display curve, then
JPEG on the bytes. Each has a random stream of its own, so that switching one on changes no other's
draw. Parts alone are targets and are never touched.
"""

import io
from collections.abc import Mapping

import numpy as np
from PIL import Image
from scipy.ndimage import convolve

from artgen.core.stream import Stream
from artgen.imaging import Bytes, Singles, display
from renders.settings import SensorSettings

GRAY = 0.1845
"""Linear radiance whose sRGB code is the middle one, 119."""
SLOPE = 255 * 1.055 / 2.4 * GRAY ** (1 / 2.4 - 1)
"""8-bit codes a unit of linear radiance there."""
READ_SHARE = 0.25
"""Share of the variance at middle gray that light does not cause: what the electronics add."""
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Of linear Rec.709."""
STEPS = 5
"""A pixel of a blur disc is covered as far as this many points across it are inside."""


def sensed(
    linear: Singles, settings: SensorSettings, stream: Stream
) -> tuple[Bytes, Mapping[str, float]]:
    """The displayed image of (H, W, 4) linear premultiplied radiance, and what was drawn for it.

    Nothing is drawn for an effect that is off; with all off this is `display`, bit for bit.
    """
    drawn: dict[str, float] = {}
    if settings.blur:
        drawn["blur_px"] = float(stream.child("blur").generator().uniform(0.0, settings.blur))
        linear = defocused(linear, drawn["blur_px"])
    if settings.exposure:
        stops = float(stream.child("exposure").generator().uniform(-1.0, 1.0) * settings.exposure)
        drawn["exposure_stops"] = stops
        linear = _tinted(linear, np.full(3, 2.0**stops))
    if settings.white_balance:
        share = float(stream.child("white balance").generator().uniform(-1.0, 1.0))
        drawn["white_balance"] = share * settings.white_balance
        linear = _tinted(linear, balance(drawn["white_balance"]))
    if settings.noise:
        drawn["noise_codes"] = settings.noise
        linear = noisy(linear, settings.noise, stream.child("noise"))
    shown = display(linear)
    if settings.jpeg:
        drawn["jpeg_quality"] = settings.jpeg
        shown = compressed(shown, settings.jpeg)
    return shown, drawn


def defocused(linear: Singles, radius: float) -> Singles:
    """The image through a lens that spreads every point to a disc of `radius` px; radiance and
    coverage keep their sums but for what leaves the image."""
    reach = int(np.ceil(radius))
    if reach == 0:
        return linear
    fine = (np.arange((2 * reach + 1) * STEPS) + 0.5) / STEPS - reach - 0.5
    inside = (fine[:, None] ** 2 + fine[None, :] ** 2 <= max(radius, 0.5) ** 2).astype(float)
    disc = inside.reshape(2 * reach + 1, STEPS, 2 * reach + 1, STEPS).sum(axis=(1, 3))
    disc /= disc.sum()
    blurred = [convolve(linear[..., k], disc, mode="constant") for k in range(linear.shape[-1])]
    return np.stack(blurred, axis=-1).astype(np.float32)


def balance(share: float) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """(3,) gains of red and blue, the one as much up as the other down, that leave the luminance
    of gray."""
    gains = np.array([1.0 + share, 1.0, 1.0 - share])
    return np.asarray(gains / (LUMINANCE @ gains))


def noisy(linear: Singles, codes: float, stream: Stream) -> Singles:
    """The image with shot and read noise, normal with a standard deviation of `codes` of 255 at
    middle gray; only where something is seen, and in proportion to how much of it."""
    alpha = linear[..., 3:]
    color = linear[..., :3] / np.where(alpha > 0.0, alpha, 1.0)
    variance = (codes / SLOPE) ** 2
    shot = np.maximum(color, 0.0) / GRAY * (1.0 - READ_SHARE)
    deviation = np.sqrt(variance * (shot + READ_SHARE))
    added = deviation * stream.generator().standard_normal(color.shape)
    return np.concatenate([(color + added) * alpha, alpha], axis=-1).astype(np.float32)


def compressed(shown: Bytes, quality: int) -> Bytes:
    """The image after JPEG, colors alone; alpha is kept, and color is 0 where it is 0."""
    buffer = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(shown[..., :3])).save(
        buffer, "JPEG", quality=quality, subsampling=0
    )
    color = np.asarray(Image.open(buffer))
    clear = shown[..., 3:] == 0
    return np.concatenate([np.where(clear, np.uint8(0), color), shown[..., 3:]], axis=-1)


def _tinted(linear: Singles, gains: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> Singles:
    return np.concatenate([linear[..., :3] * gains, linear[..., 3:]], axis=-1).astype(np.float32)
