"""The triangles of a GLB that artgen wrote: UV and surface of each, part by part."""

import json
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.errors import ExportError
from artgen.core.mesh import Floats

TURN = Y_UP_FROM_Z_UP[:3, :3]
KINDS: Mapping[int, np.dtype[Any]] = {
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass(frozen=True, kw_only=True, eq=False)
class Primitive:
    """Triangles of one part that share a surface, in the order of the file.

    Attributes:
        corners: (F, 3, 3) m, object frame at rest; float32 numbers.
        uv: (F, 3, 2) in copies of the surface's images, v up.
    """

    part: str
    surface: str
    corners: Floats
    uv: Floats


def read_primitives(path: Path) -> list[Primitive]:
    """All primitives of a GLB.

    Raises:
        ExportError: it is missing, damaged, or none that artgen wrote.
    """
    try:
        content = path.read_bytes()
        magic, _, length = struct.unpack_from("<4sII", content)
        if magic != b"glTF" or length != len(content):
            raise ValueError(f"{len(content)} bytes are no whole GLB")
        size = struct.unpack_from("<I", content, 12)[0]
        document: dict[str, Any] = json.loads(content[20 : 20 + size])
        return _primitives(document, content[28 + size :])
    except (OSError, KeyError, IndexError, TypeError, ValueError, struct.error) as error:
        raise ExportError(f"{path} cannot be read ({error!r}); export the asset anew") from error


def _primitives(document: dict[str, Any], binary: bytes) -> list[Primitive]:
    found = []
    waiting = [(root, np.zeros(3)) for root in document["scenes"][0]["nodes"]]
    while waiting:
        index, frame = waiting.pop(0)
        node = document["nodes"][index]
        origin = frame + np.array(node.get("translation", (0.0, 0.0, 0.0)))
        waiting += [(child, origin) for child in node.get("children", ())]
        for entry in document["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            points = _table(document, binary, entry["attributes"]["POSITION"])
            uv = _table(document, binary, entry["attributes"]["TEXCOORD_0"]).astype(np.float64)
            faces = _table(document, binary, entry["indices"]).reshape(-1, 3)
            found.append(
                Primitive(
                    part=node["name"],
                    surface=document["materials"][entry["material"]]["name"],
                    corners=((points.astype(np.float64) + origin) @ TURN)[faces],
                    uv=(uv * (1.0, -1.0) + (0.0, 1.0))[faces],
                )
            )
    return found


def _table(document: dict[str, Any], binary: bytes, index: int) -> NDArray[Any]:
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    kind, columns = KINDS[accessor["componentType"]], COLUMNS[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    flat = np.frombuffer(binary, kind, accessor["count"] * columns, start)
    return flat.reshape(-1, columns)
