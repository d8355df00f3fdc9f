"""What a field says of one object, as a guess: a surface a part, and its color anywhere."""

import dataclasses

import numpy as np
import torch

from artgen.core.mesh import Floats
from model.batch import Articulation
from model.field.extract import colors_at, part_meshes
from model.field.plane_field import Field
from model.reconstruct.guess import ColorAt, ObjectGuess, PartGuess, Surface, object_guess
from model.reconstruct.shapes import LEAST_SIDE, boxed


def field_guess(
    field: Field | None, articulation: Articulation, number: int, *, resolution: int, radius: float
) -> ObjectGuess:
    """Object `number` of a batch, `radius` m wide from its middle.

    Surfaces of moving parts fill their predicted boxes: the heads know better where a drawer ends
    than a field does, of which it has learned little.

    Args:
        field: None for a network without planes, whose parts are boxes.
        resolution: of marching cubes; 0 stands boxes for parts.
    """
    if field is None or not resolution:
        return object_guess(articulation, number, {}, radius=radius)
    meshes = part_meshes(field, articulation, resolution=resolution, index=number, radius=radius)
    surfaces: dict[int, Surface] = {
        mesh.slot: (mesh.vertices, mesh.faces, mesh.rgb.astype(float))
        for mesh in meshes
        if not mesh.from_box
    }
    guess = object_guess(articulation, number, surfaces, radius=radius)
    parts = []
    for part in guess.parts:
        shade = _shade(field, articulation, number, part.slot, radius)
        shaded = dataclasses.replace(part, shade=shade)
        if part.slot not in surfaces:
            parts.append(boxed(shaded))
        else:
            parts.append(filling(shaded) if part.slot else shaded)
    text = "its field holds no surface; a rounded box of the predicted size stands for it"
    told = tuple((part.slot, text) for part in parts if part.boxed)
    return dataclasses.replace(guess, parts=tuple(parts), told=told)


def filling(part: PartGuess) -> PartGuess:
    """The part stretched along the axes until its surface reaches all sides of its box; a flat one
    stays flat, in the middle."""
    low, high = part.vertices.min(axis=0), part.vertices.max(axis=0)
    wide = high - low
    sides = np.maximum(np.ptp(part.box, axis=0), LEAST_SIDE)
    scale = np.where(wide > 0.0, sides / np.where(wide > 0.0, wide, 1.0), 1.0)
    middle, target = (low + high) / 2.0, part.box.mean(axis=0)
    shade = part.shade
    return dataclasses.replace(
        part,
        vertices=target + (part.vertices - middle) * scale,
        shade=None if shade is None else lambda points: shade(middle + (points - target) / scale),
    )


def _shade(
    field: Field, articulation: Articulation, number: int, slot: int, radius: float
) -> ColorAt:
    """The field's color of a part at points in m."""

    def shade(points: Floats) -> Floats:
        device = articulation.center_BP3.device
        at = torch.as_tensor(points / radius, dtype=torch.float32, device=device)
        return colors_at(field, articulation, slot, at, index=number).double().cpu().numpy()

    return shade
