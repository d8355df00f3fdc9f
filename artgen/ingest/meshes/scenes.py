"""GLB, DAE, STL, PLY and OFF: the meshes of a file's scene, with materials where it holds any."""

import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from artgen.core.errors import GeometryError, IngestError
from artgen.core.mesh import Floats
from artgen.core.surface import srgb_from_linear
from artgen.ingest.meshes.objfile import read_obj_soup
from artgen.ingest.meshes.soup import Look, Soup, joined_soups
from artgen.validate.places import read_capped

SCENES = (".glb", ".dae", ".stl", ".ply", ".off")
MESHES = (".obj", *SCENES)
MOST_BYTES = 256 * 2**20
MOST_MESHES = 2000
"""Instances of meshes in one file."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Instance:
    """One mesh of a scene where the scene puts it; `name` is its node's."""

    name: str
    soup: Soup


def read_soup(path: Path, root: Path) -> Soup:
    """All triangles of a mesh file.

    Raises:
        IngestError, GeometryError: it cannot be read. OSError: it cannot be opened.
    """
    if path.suffix.lower() == ".obj":
        return read_obj_soup(path, root)
    return joined_soups([instance.soup for instance in read_scene(path)])


def read_scene(path: Path) -> list[Instance]:
    """Instances of meshes, in the order of the file's nodes; images are read where they are inside
    the file alone.

    Raises:
        IngestError: it is of no known kind, or holds no triangle.
        GeometryError: it cannot be read. OSError: it cannot be opened.
    """
    kind = path.suffix.lower()
    if kind not in SCENES:
        raise IngestError(f"{path.name}: no mesh file that is read; known: {', '.join(MESHES)}")
    data = read_capped(path, MOST_BYTES)
    try:
        scene = trimesh.load_scene(io.BytesIO(data), file_type=kind[1:], process=False)
        nodes = list(scene.graph.nodes_geometry)[: MOST_MESHES + 1]
        found = [_instance(scene, node, linear=kind == ".glb") for node in nodes]
    except Exception as error:  # trimesh passes on whatever its many parsers raise.
        raise GeometryError(f"{path.name}: trimesh cannot read it: {error!r}") from error
    if len(nodes) > MOST_MESHES:
        raise IngestError(f"{path.name}: more than {MOST_MESHES} meshes")
    kept = [instance for instance in found if instance is not None]
    if not kept:
        raise IngestError(f"{path.name}: it has no triangle")
    if not all(np.isfinite(instance.soup.vertices).all() for instance in kept):
        raise IngestError(f"{path.name}: a vertex is not finite")
    return kept


def _instance(scene: Any, node: str, *, linear: bool) -> Instance | None:
    """The mesh at a node, None for points and lines; `linear` tells how the file states colors."""
    pose, name = scene.graph.get(node)
    mesh = scene.geometry[name]
    faces = getattr(mesh, "faces", None)
    if faces is None or not len(faces):
        return None
    vertices = np.asarray(mesh.vertices, np.float64) @ pose[:3, :3].T + pose[:3, 3]
    faces = np.asarray(faces, np.int64)
    if np.linalg.det(pose[:3, :3]) < 0.0:
        faces = faces[:, ::-1]
    uv = _uv(mesh, faces)
    soup = Soup(
        vertices=vertices,
        faces=faces,
        uv=uv,
        look=np.zeros(len(faces), np.int64),
        looks=(_look(mesh, linear=linear),),
    )
    return Instance(name=str(node), soup=soup)


def _uv(mesh: Any, faces: Any) -> Floats:
    """(F, 3, 2), v up as trimesh has it; nan where the mesh has none."""
    stated = getattr(mesh.visual, "uv", None)
    if stated is None or len(stated) != len(mesh.vertices):
        return np.full((len(faces), 3, 2), np.nan)
    uv = np.asarray(stated, np.float64)[:, :2][faces]
    uv[~np.isfinite(uv).all(axis=(1, 2))] = np.nan
    return np.asarray(uv)


def _look(mesh: Any, *, linear: bool) -> Look:
    """Color, opacity and image of a mesh's material, as far as trimesh tells: glTF's factor is
    linear, and white where it is not stated; other formats state sRGB."""
    material = getattr(mesh.visual, "material", None)
    if material is None:
        return Look()
    color = getattr(material, "baseColorFactor", None)
    color = getattr(material, "diffuse", None) if color is None else color
    plain = [1.0, 1.0, 1.0, 1.0] if linear else [0.8, 0.8, 0.8, 1.0]
    *stated, opacity = plain if color is None else _unit(color)
    red, green, blue = (srgb_from_linear(v) if linear else v for v in stated)
    picture = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
    rough, metal = (getattr(material, f"{w}Factor", None) for w in ("roughness", "metallic"))
    return Look(
        color=(red, green, blue),
        opacity=opacity,
        roughness=0.6 if rough is None else float(np.clip(rough, 0.0, 1.0)),
        metallic=float(metal is not None and metal > 0.5),
        image=None if picture is None else _png(picture),
    )


def _unit(color: Sequence[float]) -> list[float]:
    """RGBA in [0, 1]; trimesh keeps bytes or shares."""
    values = np.asarray(color, np.float64).reshape(-1)
    values = values / 255.0 if np.asarray(color).dtype == np.uint8 else values
    return [*values[:3].tolist(), float(values[3]) if len(values) > 3 else 1.0]


def _png(picture: Any) -> bytes:
    stream = io.BytesIO()
    picture.convert("RGB").save(stream, "PNG")
    return stream.getvalue()
