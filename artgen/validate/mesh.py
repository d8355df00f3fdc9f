"""L1: visual meshes are closed, outward, of sensible size; the other files show the same parts."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from artgen.core.errors import GeometryError
from artgen.core.mesh import Ints, TriMesh
from artgen.export.layout import GLB
from artgen.geometry.convex import convexity_gap
from artgen.geometry.measure import closed as edges_close
from artgen.geometry.measure import open_edges
from artgen.validate.bounds import Bound
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.files import EXPORT_ANEW
from artgen.validate.glb import node_bounds, read_gltf
from artgen.validate.report import Finding
from artgen.validate.subject import Subject

MOST_VERTICES = 2_000_000
"""Beyond, three indices do not fit into one number of 64 bits."""


def readable(subject: Subject) -> Iterator[Finding]:
    """Visual OBJ and collision pieces can be read: finite vertices, triangles that name them."""
    read = (*subject.mesh_files.items(), *subject.collision_files.items())
    for label, mesh in read:
        if isinstance(mesh, str):
            yield Finding(
                check="mesh.readable",
                part=label,
                value=mesh,
                bound="readable triangles",
                cause="MuJoCo refuses such a mesh too",
                remedy=EXPORT_ANEW,
            )


def closed(subject: Subject) -> Iterator[Finding]:
    """Every body is an oriented closed 2-manifold (manifold3d accepts it), but those of a stranger
    that the manifest says to be open."""
    for name, shape in subject.shapes.items():
        if (count := repeated(subject.meshes[name].faces)) > 0:
            yield Finding(
                check="mesh.closed",
                part=name,
                value=float(count),
                bound="0 triangles twice",
                cause="triangles stand on the same three vertices, so volumes count them twice",
                remedy="keep one of each",
            )
        elif edges_close(subject.meshes[name].faces):
            continue  # Nothing else keeps manifold3d from accepting finite triangles.
        shells = subject.origin.shells.get(name, frozenset())
        for index, body in enumerate(shape.bodies):
            if index not in shells and (status := body.status().name) != "NoError":
                value, cause = _diagnosis(subject.meshes[name], index)
                yield Finding(
                    check="mesh.closed",
                    part=f"{name}, body {index}",
                    value=value,
                    bound="0 edges",
                    cause=f"manifold3d says {status}: {cause}",
                    remedy="check the solid and its bevel",
                )


def repeated(faces: Ints) -> int:
    """How many triangles stand on the same three vertices as another."""
    low, middle, high = np.sort(faces, axis=1).astype(np.int64).T
    span = int(high.max()) + 1
    if span > MOST_VERTICES:
        return len(faces) - len(np.unique(np.sort(faces, axis=1), axis=0))
    keys = np.sort((low * span + middle) * span + high)
    return int((keys[1:] == keys[:-1]).sum())


def _diagnosis(mesh: TriMesh, body: int) -> tuple[float | str, str]:
    """How many directed edges lack their twin, and what that tells."""
    faces = mesh.faces[mesh.body == body]
    unpaired = open_edges(faces)
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    counts = np.unique(edges, axis=0, return_counts=True)[1]
    if unpaired == 0:
        return "0 open edges", "faces meet in a way that has no inside"
    if (counts % 2 == 0).all():
        return float(unpaired), "neighboring triangles wind against each other"
    return float(unpaired), "the surface has a hole"


def volumes(subject: Subject) -> Iterator[Finding]:
    """Every body encloses a positive volume: outward normals."""
    for name, found in subject.volumes.items():
        shells = subject.origin.shells.get(name, frozenset())
        for index, volume in enumerate(found.tolist()):
            if volume <= 0.0 and index not in shells:
                yield Finding(
                    check="mesh.volume",
                    part=f"{name}, body {index}",
                    value=volume,
                    bound="> 0 m3",
                    cause="its triangles wind inward, so mass comes out negative",
                    remedy="flip them",
                )


def sizes(subject: Subject) -> Iterator[Finding]:
    """Parts are neither crumbs nor houses."""
    for name, box in subject.boxes.items():
        longest = float(np.diff(box, axis=0).max())
        if not subject.bounds.smallest.value <= longest <= subject.bounds.largest.value:
            yield Finding(
                check="mesh.size",
                part=name,
                value=longest,
                bound=f"{subject.bounds.smallest.value:g} to {subject.bounds.largest.value:g} m",
                cause="the longest side is out of range",
                remedy="write lengths in meters",
            )


def triangles(subject: Subject) -> Iterator[Finding]:
    """No triangle has collapsed; renderers get no normal from it."""
    for name, mesh in subject.meshes.items():
        a, b, c = mesh.triangles.transpose(1, 0, 2)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
        if (count := int((areas < subject.bounds.min_area.value).sum())) > 0:
            yield Finding(
                check="mesh.triangle",
                part=name,
                value=float(areas.min()),
                bound=subject.bounds.min_area.at_least(),
                cause=f"{count} triangles have no area",
                remedy="weld or dissolve them while finishing",
            )


def atlas(subject: Subject) -> Iterator[Finding]:
    """Texture coordinates lie inside the unit square."""
    for name, mesh in subject.meshes.items():
        if mesh.atlas is None:
            continue
        outside = float(np.maximum(-mesh.atlas, mesh.atlas - 1.0).max())
        if not outside <= subject.bounds.uv_edge.value:
            yield Finding(
                check="mesh.atlas",
                part=name,
                value=outside,
                bound=subject.bounds.uv_edge.at_most(),
                cause="the baked image does not reach there",
                remedy="unwrap anew",
            )


def stated(subject: BundleSubject) -> Iterator[Finding]:
    """Bounds, counts and volume are those that the manifest states."""
    for part in subject.bundle.parts:
        mesh = subject.meshes[part.name]
        found = {
            "bounds": (
                float(np.abs(subject.boxes[part.name] - part.bounds).max()),
                subject.bounds.bounds_match.value,
            ),
            "triangles": (abs(len(mesh.faces) - part.triangles), 0),
            "bodies": (abs(int(mesh.body.max()) + 1 - part.bodies), 0),  # type: ignore[union-attr]
            "volume": (
                relative_difference(_closed_volume(subject, part.name), part.volume),
                subject.bounds.integral.value,
            ),
        }
        for what, (value, bound) in found.items():
            if not value <= bound:
                yield Finding(
                    check="mesh.manifest",
                    part=part.name,
                    value=float(value),
                    bound=f"{what} within {bound:g} of the manifest's",
                    cause="the OBJ is of another export",
                    remedy=EXPORT_ANEW,
                )


def _closed_volume(subject: BundleSubject, part: str) -> float:
    """m3 of all bodies of a part that are closed."""
    found = subject.volumes[part]
    shells = subject.origin.shells.get(part, frozenset())
    return float(found[[body not in shells for body in range(len(found))]].sum())


def relative_difference(one: float, other: float) -> float:
    """|one - other| over the larger of the two; 0 when equal."""
    return 0.0 if one == other else abs(one - other) / max(abs(one), abs(other))


def glb(subject: BundleSubject) -> Iterator[Finding]:
    """The GLB has a node for every part, with the OBJ's bounds at rest."""
    try:
        found = node_bounds(
            read_gltf(subject.folder / GLB), frozenset(part.name for part in subject.bundle.parts)
        )
    except (GeometryError, LookupError) as error:
        yield _glb_finding(GLB, str(error), "a readable GLB")
        return
    for part in subject.bundle.parts:
        if part.name not in found:
            yield _glb_finding(part.name, "no node with geometry", "a node of the part's name")
            continue
        worst = float(np.abs(found[part.name] - subject.boxes[part.name]).max())
        if not worst <= subject.bounds.glb_bounds.value:
            yield _glb_finding(
                part.name, worst, f"bounds of the OBJ within {subject.bounds.glb_bounds.value:g} m"
            )


def _glb_finding(part: str, value: float | str, bound: str) -> Finding:
    return Finding(
        check="mesh.glb",
        part=part,
        value=value,
        bound=bound,
        cause="the GLB shows another object than the other files",
        remedy=EXPORT_ANEW,
    )


def collision(subject: Subject) -> Iterator[Finding]:
    """Collision pieces are convex and stay within the part; MuJoCo fills what is not convex."""
    reach, flat = subject.bounds.collision_reach, subject.bounds.hull_gap
    margin = np.array([[-1.0], [1.0]]) * reach.value
    for part, pieces in subject.collision.items():
        boxes = are_boxes(pieces)
        for index, piece in enumerate(pieces):
            label = f"{part}, piece {index}"
            if part in subject.meshes:
                lower, upper = subject.boxes[part] + margin
                low, high = piece.bounds
                out = float(max((lower - low).max(), (high - upper).max()))
                if out > 0.0:
                    cause, remedy = "contact would happen in the air", "fit the piece to its solid"
                    yield _piece_finding(
                        "mesh.reach", label, out + reach.value, reach, cause, remedy
                    )
            if boxes[index]:
                continue
            if (gap := convexity_gap(piece)) > flat.value:
                cause = "simulators take its hull and fill the hollow"
                yield _piece_finding("mesh.convex", label, gap, flat, cause, "author convex pieces")


def are_boxes(pieces: Sequence[TriMesh]) -> NDArray[np.bool_]:
    """(P,) which pieces have the eight corners of their own bounds for vertices."""
    found = np.zeros(len(pieces), bool)
    eight = [k for k, piece in enumerate(pieces) if len(piece.vertices) == 8]
    if eight:
        corners = np.array([pieces[k].vertices for k in eight])
        lower, upper = corners.min(axis=1, keepdims=True), corners.max(axis=1, keepdims=True)
        at_corner = (corners == lower) | (corners == upper)
        octant = np.sort((corners == upper) @ (4, 2, 1), axis=1)
        found[eight] = at_corner.all(axis=(1, 2)) & (octant == np.arange(8)).all(axis=1)
    return found


def _piece_finding(
    check: str, part: str, value: float, bound: Bound, cause: str, remedy: str
) -> Finding:
    return Finding(
        check=check, part=part, value=value, bound=bound.at_most(), cause=cause, remedy=remedy
    )
