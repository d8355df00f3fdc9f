"""The predicted colors as one image on the atlas: every texel asks the nearest predicted points."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from scipy.spatial import cKDTree

from artgen.articulation.types import ArticulatedObject
from artgen.core.mesh import Floats
from artgen.geometry.normals import unit
from artgen.textures.atlas import LINEAR, framed
from artgen.textures.images import Image, TextureSet
from artgen.textures.picture import picture_surface
from artgen.textures.raster import touched_texels
from model.reconstruct.guess import GRAY, ColorAt, PartGuess

PaintOver = Callable[[str, Floats, Floats, Floats], Floats]
"""Part, (N, 3) points at rest, m, their unit normals and colors so far, to (N, 3) colors."""

SIZE = 512
"""Texels along a side, as many as the atlas of a bundle has."""
NEIGHBORS = 3
ROUGHNESS = 0.6


def nearest_color(vertices: Floats, rgb: Floats) -> ColorAt:
    """Colors of the nearest vertices, the nearer the more; gray where there are none."""
    if not len(vertices):
        return lambda points: np.full((len(points), 3), GRAY)
    tree = cKDTree(vertices)
    count = min(NEIGHBORS, len(vertices))

    def color_at(points: Floats) -> Floats:
        distance, index = tree.query(points, k=count)
        distance, index = distance.reshape(-1, count), index.reshape(-1, count)
        weight = 1.0 / (distance + 1e-6)
        return np.asarray((weight[..., None] * rgb[index]).sum(1) / weight.sum(1, keepdims=True))

    return color_at


def part_color(part: PartGuess, reach: float) -> ColorAt:
    """The color of a predicted part: that of the field, each point for itself, and where nothing of
    the surface is within `reach` m, as in a cut, that of the nearest of the surface.
    """
    near = nearest_color(part.vertices, part.rgb)
    shade = part.shade
    if shade is None:
        return near
    if part.boxed:
        return shade
    tree = cKDTree(part.vertices)

    def color_at(points: Floats) -> Floats:
        own = np.isfinite(tree.query(points, distance_upper_bound=reach)[0])
        rgb = near(points)
        if own.any():
            rgb[own] = shade(points[own])
        return rgb

    return color_at


def nearest_part(parts: Sequence[PartGuess], reach: float) -> ColorAt:
    """The color of whichever of some parts is nearest."""
    colors = [part_color(part, reach) for part in parts]
    if len(parts) == 1:
        return colors[0]
    trees = [cKDTree(part.vertices) for part in parts]

    def color_at(points: Floats) -> Floats:
        nearest = np.argmin([tree.query(points)[0] for tree in trees], axis=0)
        rgb = np.zeros((len(points), 3))
        for k, color in enumerate(colors):
            if (nearest == k).any():
                rgb[nearest == k] = color(points[nearest == k])
        return rgb

    return color_at


def moved_color(color: ColorAt, shift: Floats) -> ColorAt:
    """The color of a part that was moved by a shift, m."""
    return lambda points: color(points - shift)


def colored(
    obj: ArticulatedObject, colors: Mapping[str, ColorAt], *, over: PaintOver | None = None
) -> tuple[ArticulatedObject, TextureSet]:
    """The object with one surface for all parts, and its image; `colors` by part name, `over`
    painted over them.

    The metric coordinates become those of the atlas, at the scale that keeps lengths right in the
    mean, so that GLB and USD show the image that OBJ shows.
    """
    image = _image(obj, colors, over)
    side = _meters_across(obj)
    images = TextureSet(color=image)
    skin = picture_surface("skin", images, tile=(side, side), roughness=ROUGHNESS)
    parts = tuple(
        dataclasses.replace(
            part,
            mesh=dataclasses.replace(
                part.mesh,
                uv=np.asarray(part.mesh.atlas) * side,
                slot=None,
            ),
        )
        for part in obj.parts
    )
    return dataclasses.replace(obj, parts=parts, surfaces=(skin,)), images


def _image(obj: ArticulatedObject, colors: Mapping[str, ColorAt], over: PaintOver | None) -> Image:
    atlas = np.concatenate([np.asarray(part.mesh.atlas) for part in obj.parts])
    corners = np.concatenate([part.mesh.triangles for part in obj.parts])
    owner = np.repeat(np.arange(len(obj.parts)), [len(part.mesh.faces) for part in obj.parts])
    texels = touched_texels(atlas, SIZE)
    place = np.einsum("nc,nck->nk", texels.weights, corners[texels.triangle])
    a, b, c = corners.transpose(1, 0, 2)
    normals = unit(np.cross(b - a, c - a))[texels.triangle]
    light = np.zeros((len(place), 3))
    for k, part in enumerate(obj.parts):
        own = owner[texels.triangle] == k
        if own.any():
            rgb = colors[part.name](place[own])
            if over is not None:
                rgb = over(part.name, place[own], normals[own], rgb)
            light[own] = linear(rgb)
    return framed(texels, light, SIZE)


def linear(rgb: Floats) -> Floats:
    """Linear light of sRGB in [0, 1], by the table of 256 steps, between them evenly."""
    place = np.clip(rgb, 0.0, 1.0) * 255.0
    low = np.minimum(place.astype(np.int64), 254)
    share = place - low
    return np.asarray(LINEAR[low] * (1.0 - share) + LINEAR[low + 1] * share)


def _meters_across(obj: ArticulatedObject) -> float:
    """Side of the atlas, m, at which its triangles are as large as those of the parts."""
    flat = solid = 0.0
    for part in obj.parts:
        u, v = (
            np.asarray(part.mesh.atlas)[:, k] - np.asarray(part.mesh.atlas)[:, 0] for k in (1, 2)
        )
        flat += float(np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum())
        a, b, c = part.mesh.triangles.transpose(1, 0, 2)
        solid += float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())
    return float(np.sqrt(solid / max(flat, 1e-12)))
