"""The color images inside a GLB that artgen wrote, by the name of their material."""

import json
import struct
from pathlib import Path
from typing import Any

from artgen.core.errors import ExportError

HEADER = 20
"""Bytes before the JSON chunk's content; 8 more stand before the binary chunk's."""


def color_images(path: Path) -> dict[str, bytes]:
    """Surface name to the content of its image file; surfaces of one color are not named.

    Raises:
        ExportError: the file is missing or damaged.
    """
    try:
        content = path.read_bytes()
        (size,) = struct.unpack_from("<I", content, 12)
        document: dict[str, Any] = json.loads(content[HEADER : HEADER + size])
        binary = content[HEADER + size + 8 :]
        found = {}
        for material in document.get("materials", ()):
            texture = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
            if texture is not None:
                source = document["textures"][texture["index"]]["source"]
                view = document["bufferViews"][document["images"][source]["bufferView"]]
                start = view.get("byteOffset", 0)
                found[str(material["name"])] = binary[start : start + view["byteLength"]]
        return found
    except (OSError, KeyError, IndexError, TypeError, ValueError, struct.error) as error:
        raise ExportError(f"{path} cannot be read ({error!r}); generate the asset anew") from error
