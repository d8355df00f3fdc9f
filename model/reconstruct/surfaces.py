"""What a field says of one object, as a guess: a surface a part, and its color anywhere."""

import dataclasses

import torch

from artgen.core.mesh import Floats
from model.batch import Articulation
from model.field.extract import colors_at, part_meshes
from model.field.plane_field import Field
from model.reconstruct.guess import ColorAt, ObjectGuess, Surface, object_guess
from model.reconstruct.shapes import boxed


def field_guess(
    field: Field | None, articulation: Articulation, number: int, *, resolution: int, radius: float
) -> ObjectGuess:
    """Object `number` of a batch, `radius` m wide from its middle.

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
        parts.append(shaded if part.slot in surfaces else boxed(shaded))
    text = "its field holds no surface; a rounded box of the predicted size stands for it"
    told = tuple((part.slot, text) for part in parts if part.boxed)
    return dataclasses.replace(guess, parts=tuple(parts), told=told)


def _shade(
    field: Field, articulation: Articulation, number: int, slot: int, radius: float
) -> ColorAt:
    """The field's color of a part at points in m."""

    def shade(points: Floats) -> Floats:
        device = articulation.center_BP3.device
        at = torch.as_tensor(points / radius, dtype=torch.float32, device=device)
        return colors_at(field, articulation, slot, at, index=number).double().cpu().numpy()

    return shade
