"""Reading back GLB files: arrays, frames and images, as the one who wrote them meant them."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from artgen.core.errors import ExportError
from artgen.export.glb_content import read_glb

CORNERS = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]], "<f4")
UP = np.tile(np.array([[0.0, 0.0, 1.0]], "<f4"), (3, 1))
UV = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.25]], "<f4")
FACE = np.array([0, 1, 2], "<u2")
IMAGE = b"an image file"


def glb(path: Path, child: dict[str, Any] | None = None) -> Path:
    """A triangle of the part `lid` below a root that stands off by (0.5, 0, 0), y up."""
    blocks = [CORNERS.tobytes(), UP.tobytes(), UV.tobytes(), FACE.tobytes(), IMAGE]
    starts = np.cumsum([0, *map(len, blocks)])[:-1].tolist()
    views = [{"byteOffset": s, "byteLength": len(b)} for s, b in zip(starts, blocks, strict=True)]
    kinds = [(5126, "VEC3"), (5126, "VEC3"), (5126, "VEC2"), (5123, "SCALAR")]
    primitive = {
        "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
        "indices": 3,
        "material": 0,
    }
    document = {
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"name": "root", "translation": [0.5, 0.0, 0.0], "children": [1]},
            {"name": "lid", "mesh": 0, "translation": [0.0, 0.0, 0.25], **(child or {})},
        ],
        "meshes": [{"primitives": [primitive]}],
        "materials": [
            {"name": "wood", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
        ],
        "textures": [{"source": 0}],
        "images": [{"bufferView": 4}],
        "accessors": [
            {"bufferView": k, "componentType": kind, "type": shape, "count": 3}
            for k, (kind, shape) in enumerate(kinds)
        ],
        "bufferViews": views,
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary = b"".join(blocks)
    length = 12 + 8 + len(text) + 8 + len(binary)
    head = struct.pack("<4sII", b"glTF", 2, length)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    path.write_bytes(head + chunks)
    return path


def test_triangles_come_back_z_up_where_their_nodes_put_them(tmp_path: Path) -> None:
    """glTF's (x, y, z) is our (x, -z, y); all numbers are exact in float32."""
    (skin,) = read_glb(glb(tmp_path / "a.glb")).skins
    assert (skin.part, skin.surface) == ("lid", "wood")
    expected = [[0.5, -0.25, 0.0], [1.5, -0.25, 0.0], [0.5, -0.25, 2.0]]
    np.testing.assert_array_equal(skin.vertices, expected)
    np.testing.assert_array_equal(skin.normals, [[0.0, -1.0, 0.0]] * 3)
    np.testing.assert_array_equal(skin.uv, UV)
    np.testing.assert_array_equal(skin.faces, [[0, 1, 2]])


def test_images_come_back_byte_for_byte(tmp_path: Path) -> None:
    assert read_glb(glb(tmp_path / "a.glb")).images == {"wood": {"color": IMAGE}}


@pytest.mark.parametrize("keep", [0, 11, 200, -1])
def test_a_damaged_file_is_told(tmp_path: Path, keep: int) -> None:
    path = glb(tmp_path / "cut.glb")
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(ExportError, match=r"cut\.glb cannot be read.*generate the asset anew"):
        read_glb(path)


def test_a_turned_node_is_refused(tmp_path: Path) -> None:
    path = glb(tmp_path / "a.glb", {"rotation": [0.0, 0.0, 0.0, 1.0]})
    with pytest.raises(ExportError, match="only translations are read"):
        read_glb(path)
