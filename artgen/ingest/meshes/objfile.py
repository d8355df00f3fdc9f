"""OBJ with MTL: triangles, texture coordinates and materials, whole columns at once."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np

from artgen.core.errors import ArtgenError, IngestError
from artgen.core.mesh import Floats
from artgen.ingest.meshes.soup import Faces, Look, Soup
from artgen.validate.places import inside, read_capped

MAX_IMAGE_BYTES = 32 * 2**20
METAL = 0.4
"""Mean of `Ks` above which a surface without an image is taken to be a metal."""
IMAGES = (".png", ".jpg", ".jpeg", ".bmp", ".tga", ".gif", ".tif", ".tiff", ".webp")


@dataclass(kw_only=True)
class _Lines:
    """The lines of an OBJ by what they state."""

    v: list[str] = field(default_factory=list)
    vt: list[str] = field(default_factory=list)
    f: list[str] = field(default_factory=list)
    counts: list[tuple[int, int]] = field(default_factory=list)
    """How many `v` and `vt` came before each `f`: negative numbers count back from there."""
    uses: list[tuple[int, str]] = field(default_factory=list)
    """First face of each `usemtl`."""
    libraries: list[str] = field(default_factory=list)


def read_obj_soup(path: Path, root: Path) -> Soup:
    """The OBJ at `path` with the materials of its MTL and their images, none from outside `root`.

    Raises:
        IngestError: a line is malformed, or a number is missing or not finite.
        ExportError, OSError: it cannot be read.
    """
    lines = _sorted_lines(read_capped(path).decode("utf-8", "replace"))
    try:
        vertices = _table(lines.v, 3)
        texture = _table(lines.vt, 2)
        corners, owner = _corners(lines)
    except (ValueError, IndexError, OverflowError) as error:
        raise IngestError(f"{path.name}: a line is malformed ({error})") from error
    if not np.isfinite(vertices).all():
        raise IngestError(f"{path.name}: a vertex is not finite")
    if not len(corners):
        raise IngestError(f"{path.name}: it has no face")
    if corners[..., 0].min() < 0 or corners[..., 0].max() >= len(vertices):
        raise IngestError(f"{path.name}: a face names a vertex that is not there")
    uv = np.full((len(corners), 3, 2), np.nan)
    named = (corners[..., 1] >= 0) & (corners[..., 1] < len(texture))
    whole = named.all(axis=1)
    uv[whole] = texture[corners[whole][..., 1]] if len(texture) else uv[whole]
    uv[~np.isfinite(uv).all(axis=(1, 2))] = np.nan
    looks, look = _looks(lines, owner, path, root)
    return Soup(vertices=vertices, faces=corners[..., 0], uv=uv, look=look, looks=looks)


def _sorted_lines(text: str) -> _Lines:
    lines = _Lines()
    for line in text.replace("\r\n", "\n").replace("\\\n", " ").splitlines():
        key, rest = worded(line)
        if key == "v":
            lines.v.append(rest)
        elif key == "vt":
            lines.vt.append(rest)
        elif key == "f":
            lines.f.append(rest)
            lines.counts.append((len(lines.v), len(lines.vt)))
        elif key == "usemtl":
            lines.uses.append((len(lines.f), rest))
        elif key == "mtllib":
            lines.libraries.append(rest)
    return lines


def worded(line: str) -> tuple[str, str]:
    """The first word of a line and the rest, whatever blanks lie before and between them."""
    words = line.split(maxsplit=1)
    return (words[0], words[1].rstrip()) if len(words) == 2 else ("".join(words), "")


def _table(lines: Sequence[str], columns: int) -> Floats:
    """(N, columns); colors or weights behind are passed over."""
    flat = " ".join(lines).split()
    if len(flat) == columns * len(lines):
        return np.array(flat, np.float64).reshape(-1, columns)
    return np.array([line.split()[:columns] for line in lines], np.float64).reshape(-1, columns)


def _corners(lines: _Lines) -> tuple[Faces, Faces]:
    """(F, 3, 2) zero-based vertex and texture indices (-1 for none), and the line of each
    triangle; polygons become fans."""
    words = [line.split() for line in lines.f]
    plain = all(len(own) == 3 for own in words)
    flat = " ".join(lines.f).replace("//", "/0/")
    if plain and "-" not in flat and (table := _uniform(flat, 3 * len(words))) is not None:
        return table.reshape(-1, 3, 2) - 1, np.arange(len(words))
    corners, owner = [], []
    for number, (own, counts) in enumerate(zip(words, lines.counts, strict=True)):
        points = [_corner(word, counts) for word in own]
        fans = [(points[0], *pair) for pair in pairwise(points[1:])]
        corners += fans
        owner += [number] * len(fans)
    return np.array(corners, np.int64).reshape(-1, 3, 2), np.array(owner, np.int64)


def _uniform(flat: str, count: int) -> Faces | None:
    """(count, 2) of corners that all have as many slashes; 0 for no texture point."""
    slashes = flat.count("/")
    if slashes % max(count, 1):
        return None
    columns = slashes // max(count, 1) + 1
    values = np.array(flat.replace("/", " ").split(), np.int64)
    if len(values) != columns * count or (values < 0).any() or not count:
        return None
    table = values.reshape(count, columns)
    return table[:, :2] if columns > 1 else np.concatenate([table, np.zeros_like(table)], axis=1)


def _corner(word: str, counts: tuple[int, int]) -> tuple[int, int]:
    """Zero-based indices of `v`, `v/vt`, `v//vn` or `v/vt/vn`; negative ones count back."""
    parts = [int(part) if part else 0 for part in word.split("/")[:2]]
    parts += [0] * (2 - len(parts))
    return (
        parts[0] - 1 if parts[0] >= 0 else counts[0] + parts[0],
        parts[1] - 1 if parts[1] >= 0 else counts[1] + parts[1],
    )


def _looks(lines: _Lines, owner: Faces, path: Path, root: Path) -> tuple[tuple[Look, ...], Faces]:
    """Materials of the faces by content, and (F,) which one each has."""
    library: dict[str, Look] = {}
    for name in lines.libraries:
        try:
            library |= read_mtl(inside(root, path.parent, name), root)
        except (ArtgenError, OSError):
            continue  # An OBJ without its materials is gray.
    starts = np.array([start for start, _ in lines.uses], np.int64)
    use = np.searchsorted(starts, owner, side="right") - 1
    named = [library.get(name, Look()) for _, name in lines.uses]
    looks = [*named, Look()]
    return tuple(looks), np.where(use >= 0, use, len(named))


def read_mtl(path: Path, root: Path) -> dict[str, Look]:
    """Materials by name; a number that is none keeps its default, an image that is not there is
    left out."""
    found: dict[str, dict[str, str]] = {}
    own: dict[str, str] = {}
    for line in read_capped(path).decode("utf-8", "replace").splitlines():
        key, rest = worded(line)
        if key == "newmtl":
            own = found.setdefault(rest, {})
        elif key:
            own[key] = rest
    return {name: _look(stated, path, root) for name, stated in found.items()}


def _look(stated: dict[str, str], path: Path, root: Path) -> Look:
    color = _numbers(stated.get("Kd", ""), 3)
    shine = _numbers(stated.get("Ns", ""), 1)
    opacity = _numbers(stated.get("d", ""), 1)
    clear = _numbers(stated.get("Tr", ""), 1)
    plain = Look()
    red, green, blue = plain.color if color is None else color
    gloss = _numbers(stated.get("Ks", ""), 3)
    shiny = gloss is not None and sum(gloss) > 3.0 * METAL and "map_Kd" not in stated
    return Look(
        color=(red, green, blue),
        opacity=1.0 - clear[0] if clear and opacity is None else (opacity or (1.0,))[0],
        roughness=plain.roughness if shine is None else (2.0 / (max(shine[0], 0.0) + 2.0)) ** 0.5,
        metallic=float(shiny),
        image=_image(stated.get("map_Kd"), path, root),
    )


def _numbers(text: str, count: int) -> tuple[float, ...] | None:
    try:
        values = tuple(float(word) for word in text.split()[:count])
    except ValueError:
        return None
    return values if len(values) == count and np.isfinite(values).all() else None


def _image(text: str | None, path: Path, root: Path) -> bytes | None:
    """The image that `map_Kd` names, whole or behind its options; None where it is not there."""
    if not text:
        return None
    for name in (text, text.split()[-1]):
        try:
            place = inside(root, path.parent, name)
            return read_capped(place, MAX_IMAGE_BYTES) if _is_image(place) else None
        except (ArtgenError, OSError):
            continue
    return None


def _is_image(path: Path) -> bool:
    return path.suffix.lower() in IMAGES
