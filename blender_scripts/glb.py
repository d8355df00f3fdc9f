"""The two chunks of a GLB file: a JSON document and its binary (glTF 2.0, section 4)."""

import json
import struct
from pathlib import Path
from typing import Any

MAGIC, VERSION = 0x46546C67, 2
JSON, BINARY = 0x4E4F534A, 0x004E4942


def read_glb(path: Path) -> tuple[dict[str, Any], bytes]:
    """The document and the binary chunk of a GLB that Blender wrote."""
    data = path.read_bytes()
    length, _ = struct.unpack_from("<II", data, 12)
    return json.loads(data[20 : 20 + length]), data[20 + length + 8 :]


def write_glb(path: Path, document: dict[str, Any], binary: bytes) -> None:
    """Both chunks, padded to four bytes."""
    text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    total = 12 + 8 + len(text) + 8 + len(binary)
    header = struct.pack("<III", MAGIC, VERSION, total)
    chunks = struct.pack("<II", len(text), JSON) + text
    chunks += struct.pack("<II", len(binary), BINARY) + binary
    path.write_bytes(header + chunks)
