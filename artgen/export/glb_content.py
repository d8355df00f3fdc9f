"""What a GLB that artgen wrote shows: triangles with texture coordinates, and images by surface."""

import json
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.errors import ExportError
from artgen.core.mesh import Floats

TURN = Y_UP_FROM_Z_UP[:3, :3]
COMPONENT: Mapping[int, np.dtype[Any]] = {
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
ImageKind = Literal["color", "orm", "normal", "emission"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Skin:
    """Triangles of one part that share a surface.

    Attributes:
        part: name of the part.
        surface: name of the surface.
        vertices: (N, 3) m, object frame at rest; float32 numbers.
        normals: (N, 3) unit.
        uv: (N, 2) in copies of the surface's images; v points **down**, as glTF stores it.
        faces: (F, 3) int32.
    """

    part: str
    surface: str
    vertices: Floats
    normals: Floats
    uv: Floats
    faces: NDArray[np.int32]


@dataclass(frozen=True, kw_only=True, eq=False)
class GlbContent:
    """A GLB as arrays.

    Attributes:
        skins: in the order of the file.
        images: by surface name, the content of its image files; those of one number are not named.
    """

    skins: tuple[Skin, ...]
    images: Mapping[str, Mapping[ImageKind, bytes]]


def read_glb(path: Path) -> GlbContent:
    """Triangles and images of `path`.

    Raises:
        ExportError: the file is missing, damaged, or not one that artgen wrote.
    """
    try:
        reader = _Reader(path.read_bytes())
        materials = reader.document.get("materials", ())
        images = {str(material["name"]): reader.images(material) for material in materials}
        return GlbContent(skins=tuple(reader.skins()), images=images)
    except (OSError, KeyError, IndexError, TypeError, ValueError, struct.error) as error:
        raise ExportError(f"{path} cannot be read ({error!r}); generate the asset anew") from error


class _Reader:
    """The JSON chunk and the binary chunk of one file (glTF 2.0, section 4.4)."""

    def __init__(self, content: bytes) -> None:
        magic, _, length = struct.unpack_from("<4sII", content)
        if magic != b"glTF" or length != len(content):
            raise ValueError(f"{len(content)} bytes are no whole GLB")
        size = struct.unpack_from("<I", content, 12)[0]
        self.document: dict[str, Any] = json.loads(content[20 : 20 + size])
        self.binary = memoryview(content)[28 + size :]

    def skins(self) -> Iterator[Skin]:
        """Triangles of all nodes, from the root on."""
        materials = self.document.get("materials", [])
        waiting = [(root, np.zeros(3)) for root in self.document["scenes"][0]["nodes"]]
        while waiting:
            index, frame = waiting.pop(0)
            node = self.document["nodes"][index]
            if node.keys() & {"rotation", "scale", "matrix"}:
                raise ValueError(f"node {node['name']} is turned; only translations are read")
            origin = frame + np.array(node.get("translation", (0.0, 0.0, 0.0)))
            waiting += [(child, origin) for child in node.get("children", ())]
            if "mesh" in node:
                for primitive in self.document["meshes"][node["mesh"]]["primitives"]:
                    surface = materials[primitive["material"]]["name"]
                    yield self._skin(primitive, node["name"], surface, origin)

    def _skin(self, primitive: dict[str, Any], part: str, surface: str, origin: Floats) -> Skin:
        own = primitive["attributes"]
        vertices = self._table(own["POSITION"]).astype(np.float64) + origin
        return Skin(
            part=part,
            surface=surface,
            vertices=vertices @ TURN,
            normals=self._table(own["NORMAL"]).astype(np.float64) @ TURN,
            uv=self._table(own["TEXCOORD_0"]).astype(np.float64),
            faces=self._table(primitive["indices"]).reshape(-1, 3).astype(np.int32),
        )

    def _table(self, index: int) -> NDArray[Any]:
        accessor = self.document["accessors"][index]
        view = self.document["bufferViews"][accessor["bufferView"]]
        kind, columns = COMPONENT[accessor["componentType"]], COLUMNS[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        if view.get("byteStride", kind.itemsize * columns) != kind.itemsize * columns:
            raise ValueError("interleaved arrays are not read")
        flat = np.frombuffer(self.binary, kind, accessor["count"] * columns, start)
        return flat.reshape(-1, columns)

    def images(self, material: dict[str, Any]) -> dict[ImageKind, bytes]:
        """The content of a material's image files."""
        physical = material.get("pbrMetallicRoughness", {})
        textures: dict[ImageKind, dict[str, Any] | None] = {
            "color": physical.get("baseColorTexture"),
            "orm": physical.get("metallicRoughnessTexture"),
            "normal": material.get("normalTexture"),
            "emission": material.get("emissiveTexture"),
        }
        return {kind: self._file(own) for kind, own in textures.items() if own is not None}

    def _file(self, texture: dict[str, Any]) -> bytes:
        source = self.document["textures"][texture["index"]]["source"]
        view = self.document["bufferViews"][self.document["images"][source]["bufferView"]]
        start = view.get("byteOffset", 0)
        return bytes(self.binary[start : start + view["byteLength"]])
