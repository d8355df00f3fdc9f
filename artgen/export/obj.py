"""OBJ: one file per part in the object frame at rest, with atlas coordinates and corner normals."""

import numpy as np

from artgen.core.conventions import NORMAL_DECIMALS
from artgen.core.errors import ExportError
from artgen.core.mesh import Floats, Ints, TriMesh
from artgen.export.numbers import rows
from artgen.geometry.normals import corner_normals

MATERIAL = "atlas"
FACE = "f {}/{}/{} {}/{}/{} {}/{}/{}"
BODY = "# body "
"""Starts a closed body. A comment, as MuJoCo 4.0 takes the faces of the first `g` or `o` alone."""


def obj_text(mesh: TriMesh, *, mtl: str) -> str:
    """The part's triangles, body after body: `v`, `vt` (atlas set), `vn`, `f v/vt/vn`.

    Args:
        mesh: a finished mesh; bodies share no vertices.
        mtl: file name of the material library, relative to the OBJ.

    Raises:
        ExportError: the mesh has no atlas coordinates.
    """
    if mesh.atlas is None:
        raise ExportError(
            "a mesh without atlas coordinates cannot be written as OBJ; finish it first"
        )
    texture, texture_index = distinct(mesh.atlas.reshape(-1, 2))
    normals = np.round(corner_normals(mesh), NORMAL_DECIMALS)
    normal, normal_index = distinct(normals.reshape(-1, 3))
    corner = np.stack([mesh.faces.reshape(-1), texture_index, normal_index], axis=1) + 1
    lines = [f"mtllib {mtl}", *rows("v", mesh.vertices), *rows("vt", texture), *rows("vn", normal)]
    lines.append(f"usemtl {MATERIAL}")
    faces, bodies = corner.reshape(-1, 9), np.asarray(mesh.body)
    for body in range(int(bodies.max()) + 1):
        lines.append(f"{BODY}{body}")
        own = faces[bodies == body].tolist()
        lines += [FACE.format(*face) for face in own]
    return "\n".join(lines) + "\n"


def hull_text(mesh: TriMesh) -> str:
    """A collision piece: vertices and triangles alone."""
    faces = (f"f {a} {b} {c}" for a, b, c in (mesh.faces + 1).tolist())
    return "\n".join([*rows("v", mesh.vertices), *faces]) + "\n"


def mtl_text(image: str) -> str:
    """The one material: the baked color image at a path relative to the MTL."""
    return f"newmtl {MATERIAL}\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {image}\n"


def distinct(values: Floats) -> tuple[Floats, Ints]:
    """(M, K) different rows in order of first use, and for each of N rows its index."""
    packed = np.ascontiguousarray(values + 0.0)  # + 0.0 makes -0.0 and 0.0 the same bytes
    keys = packed.view([("", np.float64)] * packed.shape[1]).reshape(-1)
    _, first, index = np.unique(keys, return_index=True, return_inverse=True)
    order = np.argsort(first, kind="stable")
    rank = np.zeros(len(order), np.int32)
    rank[order] = np.arange(len(order), dtype=np.int32)
    return packed[first[order]], rank[index.reshape(-1)]


def read_obj(text: str) -> TriMesh:
    """What `obj_text` or `hull_text` wrote, bit for bit, but for UV in meters and slots.

    Raises:
        ExportError: a line is not one that artgen writes.
    """
    found: dict[str, list[str]] = {"v": [], "vt": [], "vn": [], "f": []}
    starts = []
    for line in text.splitlines():
        keyword, _, rest = line.partition(" ")
        if keyword in found:
            found[keyword].append(rest)
        elif line.startswith(BODY):
            starts.append(len(found["f"]))
        elif keyword not in ("mtllib", "usemtl"):
            raise ExportError(
                f"OBJ line {line!r} is not one that artgen writes; export the asset anew"
            )
    return _assembled(found, starts)


def _assembled(found: dict[str, list[str]], starts: list[int]) -> TriMesh:
    vertices = _table(found["v"], 3)
    texture = _table(found["vt"], 2)
    count = len(found["f"])
    words = " ".join(found["f"]).replace("/", " ").split()
    corner = np.array(words, np.int32).reshape(count, 3, -1) - 1
    body = np.searchsorted(np.array(starts), np.arange(count), side="right") - 1 if starts else None
    return TriMesh(
        vertices=vertices,
        faces=corner[:, :, 0],
        atlas=texture[corner[:, :, 1]] if len(texture) else None,
        body=body,
    )


def _table(lines: list[str], columns: int) -> Floats:
    return np.array(" ".join(lines).split(), np.float64).reshape(-1, columns)
