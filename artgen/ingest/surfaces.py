"""Surfaces: what files say of materials, as surfaces and images of ours."""

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image

from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec, linear_from_srgb
from artgen.ingest.meshes.clean import Body
from artgen.ingest.meshes.soup import Look
from artgen.textures.images import TextureSet
from artgen.textures.picture import picture_surface

MOST_PIXELS = 64 * 2**20
"""An image that claims more is not decoded."""
SIDE = 1024
"""px; larger images are made as small."""
CLEAR = 0.7
"""Opacity below which a surface is a pane."""
TILE = 0.5
"""m that one copy of an image covers where no triangle tells."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Surfaces:
    """Surfaces of an object: slot by the digest of a look, and images for the texture library."""

    specs: tuple[SurfaceSpec, ...]
    images: tuple[TextureSet, ...]
    slots: Mapping[str, int]
    unreadable: int


def surfaces_of(bodies: Sequence[Body]) -> Surfaces:
    """One surface for each look that some body has, in order of first use."""
    looks = {look.digest: look for body in bodies for look in body.soup.looks}
    tiles = _tiles(bodies, looks)
    specs, images, unreadable = [], [], 0
    for number, (digest, look) in enumerate(looks.items()):
        pixels = None if look.image is None else decoded(look.image)
        unreadable += look.image is not None and pixels is None
        own = TextureSet(color=pixels)
        specs.append(_spec(f"surface_{number}", look, own, tiles.get(digest, (TILE, TILE))))
        images.append(own)
    slots = {digest: number for number, digest in enumerate(looks)}
    return Surfaces(specs=tuple(specs), images=tuple(images), slots=slots, unreadable=unreadable)


def _spec(name: str, look: Look, images: TextureSet, tile: tuple[float, float]) -> SurfaceSpec:
    if images.color is not None and look.opacity >= CLEAR:
        rough = min(max(look.roughness, 0.0), 1.0)
        return picture_surface(name, images, tile=tile, roughness=rough, metallic=look.metallic)
    red, green, blue = (linear_from_srgb(min(max(value, 0.0), 1.0)) for value in look.color)
    return SurfaceSpec(
        name=name,
        recipe="plain",
        color=(red, green, blue),
        roughness=min(max(look.roughness, 0.0), 1.0),
        metallic=look.metallic,
        transmission=1.0 if look.opacity < CLEAR else 0.0,
        tile=tile,
    )


def decoded(content: bytes) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]] | None:
    """(H, W, 3) of at most `SIDE` px a side; None where it is no image, or far too large."""
    try:
        with Image.open(io.BytesIO(content)) as picture:
            if picture.width * picture.height > MOST_PIXELS:
                return None
            small = picture.convert("RGB")
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        return None
    if max(small.size) > SIDE:
        share = SIDE / max(small.size)
        size = (max(1, round(small.width * share)), max(1, round(small.height * share)))
        small = small.resize(size, Image.Resampling.LANCZOS)
    return np.asarray(small, np.uint8)


def _tiles(bodies: Sequence[Body], looks: Mapping[str, Look]) -> dict[str, tuple[float, float]]:
    """By digest: (width, height) m that one copy of the image covers, the median over its area."""
    spans: dict[str, list[Floats]] = {}
    for body in bodies:
        soup = body.soup
        for number, look in enumerate(soup.looks):
            own = (soup.look == number) & np.isfinite(soup.uv).all(axis=(1, 2))
            if look.image is not None and own.any():
                found = gradients(soup.vertices[soup.faces[own]], soup.uv[own])
                spans.setdefault(look.digest, []).append(found)
    tiles = {}
    for digest, listed in spans.items():
        u, v, weight = np.concatenate(listed).T
        width, height = (_median(value, weight) for value in (u, v))
        if np.isfinite([width, height]).all() and min(width, height) > 0.0:
            tiles[digest] = width, height
    return tiles


def gradients(corners: Floats, uv: Floats) -> Floats:
    """(F, 3): m along the surface over which u and v grow by 1, and area m2; 0 where they do not
    grow."""
    p, q = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    normal = np.cross(p, q)
    area = np.linalg.norm(normal, axis=1)
    unit = normal / area.clip(min=1e-300)[:, None]
    # The gradient of a linear function on a triangle: (fq p' - fp q') over its area.
    across_p, across_q = np.cross(unit, p), np.cross(unit, q)
    columns = []
    for k in range(2):
        slope = b[:, k, None] * across_p - a[:, k, None] * across_q
        norm = np.linalg.norm(slope, axis=1) / area.clip(min=1e-300)
        columns.append(np.where(norm > 0.0, 1.0 / norm.clip(min=1e-300), 0.0))
    return np.stack([*columns, area / 2.0], axis=1)


def _median(values: Floats, weights: Floats) -> float:
    """Weighted; of the values above 0."""
    used = values > 0.0
    if not used.any():
        return float("nan")
    order = np.argsort(values[used])
    share = np.cumsum(weights[used][order])
    return float(values[used][order][np.searchsorted(share, share[-1] / 2.0)])
