"""OpenEXR in memory, in the one layout that samples use: scanlines, ZIP, half or float channels.

OpenImageIO's Python module writes and reads files only; samples pass through bytes. The header has
the eight required attributes and nothing else, so equal arrays give equal bytes. Layout: "OpenEXR
File Layout", openexr.com; the ZIP predictor is that of the library's `ImfZip.cpp`.
"""

import struct
import zlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from artgen.core.errors import ShardError

Pixels = NDArray[np.float16] | NDArray[np.float32]

_MAGIC = struct.pack("<ii", 20000630, 2)
_LINES = 16
"""Scanlines of one ZIP block."""
_TYPES: Mapping[int, type[np.float16] | type[np.float32]] = {1: np.float16, 2: np.float32}
_ZIP, _INCREASING_Y = 3, 0


def exr(image: Pixels, channels: Sequence[str]) -> bytes:
    """(H, W, C) float16 or float32 as OpenEXR; `channels` names the last axis."""
    height, width, _ = image.shape
    planes = _planes(image, channels)
    blocks = [_block(y, planes[y : y + _LINES]) for y in range(0, height, _LINES)]
    header = _header(height, width, sorted(channels), half=image.dtype == np.float16)
    first = len(header) + 8 * len(blocks)
    starts = np.cumsum([first, *map(len, blocks[:-1])], dtype=np.uint64)
    return b"".join([header, starts.astype("<u8").tobytes(), *blocks])


def read_exr(data: bytes, channels: Sequence[str]) -> Pixels:
    """(H, W, C) the bits that `exr` was given.

    Raises:
        ShardError: it is no EXR, or one of another layout or with other channels.
    """
    if data[:8] != _MAGIC:
        raise ShardError("an EXR image does not begin as one; pack again")
    attributes, at = _attributes(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    height, width = bottom - top + 1, right - left + 1
    kinds = _channel_types(attributes["channels"])
    if sorted(channels) != list(kinds) or len({*kinds.values()}) != 1:
        raise ShardError(f"an EXR image has channels {list(kinds)}, expected {sorted(channels)}")
    if attributes["compression"][0] != _ZIP or attributes["lineOrder"][0] != _INCREASING_Y:
        raise ShardError("an EXR image is not ZIP-compressed scanlines; write it with artgen")
    dtype = np.dtype(_TYPES[next(iter(kinds.values()))]).newbyteorder("<")
    lines = []
    at += 8 * -(-height // _LINES)
    for y in range(0, height, _LINES):
        (size,) = struct.unpack_from("<i", data, at + 4)
        count = min(_LINES, height - y) * len(channels) * width * dtype.itemsize
        lines.append(_unpacked(data[at + 8 : at + 8 + size], count))
        at += 8 + size
    planes = np.frombuffer(b"".join(lines), dtype).reshape(height, len(channels), width)
    order = [sorted(channels).index(name) for name in channels]
    pixels: Pixels = np.ascontiguousarray(planes[:, order].transpose(0, 2, 1))
    return pixels


def _planes(image: Pixels, channels: Sequence[str]) -> NDArray[Any]:
    """(H, C, W) little-endian, channels in alphabetic order, as lines lie in the file."""
    order = [list(channels).index(name) for name in sorted(channels)]
    return image[..., order].transpose(0, 2, 1).astype(image.dtype.newbyteorder("<"))


def _header(height: int, width: int, names: Sequence[str], *, half: bool) -> bytes:
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    listed = b"".join(
        name.encode() + b"\0" + struct.pack("<iB3xii", 1 if half else 2, 0, 1, 1) for name in names
    )
    attributes = (
        ("channels", "chlist", listed + b"\0"),
        ("compression", "compression", bytes([_ZIP])),
        ("dataWindow", "box2i", window),
        ("displayWindow", "box2i", window),
        ("lineOrder", "lineOrder", bytes([_INCREASING_Y])),
        ("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        ("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0)),
        ("screenWindowWidth", "float", struct.pack("<f", 1.0)),
    )
    parts = [
        name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
        for name, kind, value in attributes
    ]
    return b"".join([_MAGIC, *parts, b"\0"])


def _block(y: int, planes: NDArray[Any]) -> bytes:
    """One chunk: its first line, its size, and the lines; stored as they are where ZIP gains
    nothing."""
    raw = np.frombuffer(planes.tobytes(), np.uint8)
    sorted_bytes = np.concatenate([raw[0::2], raw[1::2]])
    delta = sorted_bytes.copy()
    delta[1:] -= sorted_bytes[:-1]
    delta[1:] += np.uint8(128)
    packed = zlib.compress(delta.tobytes(), 6)
    kept = packed if len(packed) < raw.size else raw.tobytes()
    return struct.pack("<ii", y, len(kept)) + kept


def _unpacked(packed: bytes, count: int) -> bytes:
    if len(packed) == count:
        return packed
    delta = np.frombuffer(zlib.decompress(packed), np.uint8).copy()
    delta[1:] -= np.uint8(128)
    sorted_bytes = np.cumsum(delta, dtype=np.uint8)
    raw = np.zeros_like(sorted_bytes)
    half = -(-raw.size // 2)
    raw[0::2], raw[1::2] = sorted_bytes[:half], sorted_bytes[half:]
    return raw.tobytes()


def _attributes(data: bytes) -> tuple[dict[str, bytes], int]:
    """Values by name, and where the header ends."""
    found, at = {}, len(_MAGIC)
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        found[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return found, at + 1


def _channel_types(listed: bytes) -> dict[str, int]:
    kinds, at = {}, 0
    while listed[at]:
        name, at = _text(listed, at)
        (kinds[name],) = struct.unpack_from("<i", listed, at)
        at += 16
    return kinds


def _text(data: bytes, at: int) -> tuple[str, int]:
    end = data.index(0, at)
    return data[at:end].decode("ascii"), end + 1
