"""Fragments: the bodies of a part as the OBJ and MTL files of PartNet-Mobility."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Part
from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec, srgb_from_linear
from artgen.export.numbers import exact, rows
from artgen.export.obj import distinct
from artgen.geometry.normals import corner_normals

HANDLES = ("handle", "knob", "lever")
"""Kinds of grips whose body is called a handle."""
PANE = 0.3
"""`d` of a surface that lets light through."""


@dataclass(frozen=True, kw_only=True)
class Fragment:
    """One OBJ file: a body of a part, and the leaf that it belongs to."""

    stem: str
    part: str
    leaf: str
    body: int


def fragments_of(part: Part, *, first: int) -> list[Fragment]:
    """One a body; `first` is the number of the first file. Bodies where a handle's grip is are
    leaves called `handle`."""
    count = int(np.asarray(part.mesh.body).max()) + 1
    held = _held(part)
    return [
        Fragment(
            stem=f"original-{first + body}",
            part=part.name,
            leaf="handle" if body in held else f"{part.label}_body",
            body=body,
        )
        for body in range(count)
    ]


def _held(part: Part) -> set[int]:
    """Bodies whose box is nearest to a grip; of a part of one body, none."""
    bodies = np.asarray(part.mesh.body)
    count = int(bodies.max()) + 1
    if count == 1:
        return set()
    corners = part.mesh.triangles
    boxes = [(corners[bodies == k].min((0, 1)), corners[bodies == k].max((0, 1)))
             for k in range(count)]  # fmt: skip
    found = set()
    for grip in part.grips:
        if grip.kind in HANDLES:
            at = np.array(grip.position)
            gaps = [float(np.linalg.norm(np.maximum(low - at, at - high).clip(min=0.0)))
                    + 1e-3 * float(np.linalg.norm(high - low)) for low, high in boxes]  # fmt: skip
            found.add(int(np.argmin(gaps)))
    return found


def fragment_obj(
    mesh: TriMesh,
    fragment: Fragment,
    surfaces: Sequence[SurfaceSpec],
    mesh_from_object: Floats,
    *,
    doubled: bool,
) -> str:
    """The OBJ's text: `v`, `vt`, `vn`, and the faces of each material.

    Args:
        mesh_from_object: (3, 4): turn, scale and shift.
        doubled: whether every face stands there a second time, turned around, as it mostly does in
            the data set.
    """
    own = np.asarray(mesh.body) == fragment.body
    turn, shift = mesh_from_object[:, :3], mesh_from_object[:, 3]
    used, faces = np.unique(mesh.faces[own], return_inverse=True)
    faces = faces.reshape(-1, 3)
    slot = np.asarray(mesh.slot)[own]
    uv = np.zeros((len(faces), 3, 2)) if mesh.uv is None else mesh.uv[own]
    uv = uv / np.array([surface.tile for surface in surfaces])[slot][:, None, :]
    normal = corner_normals(mesh)[own] @ (turn / np.linalg.norm(turn, axis=0)).T
    if doubled:
        faces = np.concatenate([faces, faces[:, ::-1]])
        uv = np.concatenate([uv, uv[:, ::-1]])
        normal = np.concatenate([normal, -normal[:, ::-1]])
        slot = np.tile(slot, 2)
    texture, texture_index = distinct(uv.reshape(-1, 2))
    normals, normal_index = distinct(np.round(normal, 6).reshape(-1, 3))
    corner = (np.stack([faces.reshape(-1), texture_index, normal_index], axis=1) + 1).reshape(-1, 9)
    lines = [f"mtllib {fragment.stem}.mtl", f"o {fragment.part}/{fragment.leaf}#{fragment.body}"]
    lines += rows("v", mesh.vertices[used] @ turn.T + shift)
    lines += [*rows("vt", texture), *rows("vn", normals)]
    for number in np.unique(slot).tolist():
        lines.append(f"usemtl {material_name(surfaces, number)}")
        lines += ["f {}/{}/{} {}/{}/{} {}/{}/{}".format(*c) for c in corner[slot == number]]
    return "\n".join(lines) + "\n"


def material_name(surfaces: Sequence[SurfaceSpec], slot: int) -> str:
    """The material of a surface, as one word."""
    return f"material_{slot}_{surfaces[slot].name}".replace(" ", "_")


def fragment_mtl(
    surfaces: Sequence[SurfaceSpec], slots: Sequence[int], images: Mapping[str, str]
) -> str:
    """The MTL's text for the surfaces of a fragment; `images[surface]` is the path of its color,
    relative to the MTL."""
    lines = []
    for slot in slots:
        surface = surfaces[slot]
        clear = surface.transmission > 0.0
        image = images.get(surface.name)
        color = (1.0, 1.0, 1.0) if image else surface.color
        shine = 2.0 / max(surface.roughness, 0.05) ** 2 - 2.0
        gloss = surface.color if surface.metallic > 0.5 else (0.04, 0.04, 0.04)
        lines += [
            f"newmtl {material_name(surfaces, slot)}",
            f"illum {4 if clear else 3}",
            f"d {PANE if clear else 1.0}",
            f"Ns {exact(shine)}",
            f"Kd {exact([srgb_from_linear(value) for value in color])}",
            f"Ks {exact(gloss)}",
        ]
        lines += [f"map_Kd {image}"] if image else []
    return "\n".join(lines) + "\n"
