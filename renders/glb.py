"""The GLB of a bundle as arrays: what each part's triangles look like, texture by texture."""

import io
import json
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.errors import RenderError
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec

Bytes = NDArray[np.uint8]
TURN = Y_UP_FROM_Z_UP[:3, :3]
COMPONENT: Mapping[int, np.dtype[Any]] = {
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass(frozen=True, kw_only=True, eq=False)
class Skin:
    """Triangles of one part that share a surface.

    Attributes:
        part: name of the part.
        surface: name of the surface.
        vertices: (N, 3) m, object frame at rest.
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
class Look:
    """Images of one surface, row 0 at v = 0; None where the surface's number holds.

    Attributes:
        color: (H, W, 3) sRGB.
        orm: (H, W, 3) linear; G = roughness, B = metallic.
        normal: (H, W, 3) tangent space, y up.
        emission: (H, W, 3) sRGB.
    """

    color: Bytes | None = None
    orm: Bytes | None = None
    normal: Bytes | None = None
    emission: Bytes | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Appearance:
    """All that can be seen of an asset.

    Attributes:
        skins: in the order of the file.
        looks: by surface name.
    """

    skins: tuple[Skin, ...]
    looks: Mapping[str, Look]


def read_appearance(path: Path) -> Appearance:
    """Triangles, texture coordinates and images of `path`.

    Raises:
        RenderError: the file is missing, damaged, or not one that artgen wrote.
    """
    try:
        return _Reader(path.read_bytes()).appearance()
    except (OSError, KeyError, IndexError, TypeError, ValueError, struct.error) as error:
        raise RenderError(f"{path} cannot be read ({error!r}); generate the asset anew") from error


def surfaces_by_name(
    surfaces: Sequence[SurfaceSpec], appearance: Appearance
) -> dict[str, SurfaceSpec]:
    """The surfaces of a manifest for a GLB that uses no other.

    Raises:
        RenderError: the GLB uses one that the manifest does not state.
    """
    known = {surface.name: surface for surface in surfaces}
    if strange := {skin.surface for skin in appearance.skins} - set(known):
        raise RenderError(
            f"the GLB uses surfaces {', '.join(sorted(strange))}, the manifest states "
            f"{', '.join(known)}; generate the asset anew"
        )
    return known


class _Reader:
    """The JSON chunk and the binary chunk of one file (glTF 2.0, section 4.4)."""

    def __init__(self, content: bytes) -> None:
        magic, _, length = struct.unpack_from("<4sII", content)
        if magic != b"glTF" or length != len(content):
            raise ValueError(f"{len(content)} bytes are no whole GLB")
        size = struct.unpack_from("<I", content, 12)[0]
        self.document: dict[str, Any] = json.loads(content[20 : 20 + size])
        self.binary = memoryview(content)[28 + size :]

    def appearance(self) -> Appearance:
        materials = self.document.get("materials", [])
        skins, waiting = [], [(root, np.zeros(3)) for root in self.document["scenes"][0]["nodes"]]
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
                    skins.append(self._skin(primitive, node["name"], surface, origin))
        looks = {material["name"]: self._look(material) for material in materials}
        return Appearance(skins=tuple(skins), looks=looks)

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

    def _look(self, material: dict[str, Any]) -> Look:
        physical = material.get("pbrMetallicRoughness", {})
        return Look(
            color=self._image(physical.get("baseColorTexture")),
            orm=self._image(physical.get("metallicRoughnessTexture")),
            normal=self._image(material.get("normalTexture")),
            emission=self._image(material.get("emissiveTexture")),
        )

    def _image(self, texture: dict[str, Any] | None) -> Bytes | None:
        if texture is None:
            return None
        source = self.document["textures"][texture["index"]]["source"]
        view = self.document["bufferViews"][self.document["images"][source]["bufferView"]]
        start = view.get("byteOffset", 0)
        with Image.open(io.BytesIO(self.binary[start : start + view["byteLength"]])) as image:
            return np.asarray(image.convert("RGB"))
