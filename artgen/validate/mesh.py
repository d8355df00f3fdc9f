"""L1: visual meshes are closed, outward, of sensible size; the other files show the same parts."""

from collections.abc import Iterator

import numpy as np

from artgen.core.errors import GeometryError
from artgen.core.mesh import TriMesh
from artgen.export.layout import GLB
from artgen.geometry.convex import convexity_gap
from artgen.geometry.measure import open_edges
from artgen.validate import bounds
from artgen.validate.bounds import Bound
from artgen.validate.glb import node_bounds, read_gltf
from artgen.validate.report import Finding
from artgen.validate.subject import Subject


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
                message="MuJoCo refuses such a mesh too; export the asset anew",
            )


def closed(subject: Subject) -> Iterator[Finding]:
    """Every body is an oriented closed 2-manifold (manifold3d accepts it)."""
    for name, shape in subject.shapes.items():
        for index, body in enumerate(shape.bodies):
            if (status := body.status().name) != "NoError":
                value, cause = _diagnosis(subject.meshes[name], index)
                yield Finding(
                    check="mesh.closed",
                    part=f"{name}, body {index}",
                    value=value,
                    bound="0 edges",
                    message=f"manifold3d says {status}: {cause}; check the solid and its bevel",
                )


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
        for index, volume in enumerate(found.tolist()):
            if volume <= 0.0:
                yield Finding(
                    check="mesh.volume",
                    part=f"{name}, body {index}",
                    value=volume,
                    bound="> 0 m3",
                    message="its triangles wind inward, so mass comes out negative; flip them",
                )


def sizes(subject: Subject) -> Iterator[Finding]:
    """Parts are neither crumbs nor houses."""
    for name, mesh in subject.meshes.items():
        longest = float(np.diff(mesh.bounds, axis=0).max())
        if not bounds.SMALLEST.value <= longest <= bounds.LARGEST.value:
            yield Finding(
                check="mesh.size",
                part=name,
                value=longest,
                bound=f"{bounds.SMALLEST.value:g} to {bounds.LARGEST.value:g} m",
                message="the longest side is out of range; lengths are meters",
            )


def triangles(subject: Subject) -> Iterator[Finding]:
    """No triangle has collapsed; renderers get no normal from it."""
    for name, mesh in subject.meshes.items():
        a, b, c = mesh.triangles.transpose(1, 0, 2)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
        if (count := int((areas < bounds.MIN_AREA.value).sum())) > 0:
            yield Finding(
                check="mesh.triangle",
                part=name,
                value=float(areas.min()),
                bound=bounds.MIN_AREA.at_least(),
                message=f"{count} triangles have no area; weld or dissolve them while finishing",
            )


def atlas(subject: Subject) -> Iterator[Finding]:
    """Texture coordinates lie inside the unit square."""
    for name, mesh in subject.meshes.items():
        if mesh.atlas is None:
            continue
        outside = float(np.maximum(-mesh.atlas, mesh.atlas - 1.0).max())
        if not outside <= bounds.UV_EDGE.value:
            yield Finding(
                check="mesh.atlas",
                part=name,
                value=outside,
                bound=bounds.UV_EDGE.at_most(),
                message="the baked image does not reach there; unwrap anew",
            )


def stated(subject: Subject) -> Iterator[Finding]:
    """Bounds, counts and volume are those that the manifest states."""
    for part in subject.bundle.parts:
        mesh = subject.meshes[part.name]
        found = {
            "bounds": (float(np.abs(mesh.bounds - part.bounds).max()), bounds.BOUNDS_MATCH.value),
            "triangles": (abs(len(mesh.faces) - part.triangles), 0),
            "bodies": (abs(int(mesh.body.max()) + 1 - part.bodies), 0),  # type: ignore[union-attr]
            "volume": (
                relative_difference(float(subject.volumes[part.name].sum()), part.volume),
                bounds.INTEGRAL.value,
            ),
        }
        for what, (value, bound) in found.items():
            if not value <= bound:
                yield Finding(
                    check="mesh.manifest",
                    part=part.name,
                    value=float(value),
                    bound=f"{what} within {bound:g} of the manifest's",
                    message="the OBJ is of another export; export the asset anew",
                )


def relative_difference(one: float, other: float) -> float:
    """|one - other| over the larger of the two; 0 when equal."""
    return 0.0 if one == other else abs(one - other) / max(abs(one), abs(other))


def glb(subject: Subject) -> Iterator[Finding]:
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
        worst = float(np.abs(found[part.name] - subject.meshes[part.name].bounds).max())
        if not worst <= bounds.GLB_BOUNDS.value:
            yield _glb_finding(
                part.name, worst, f"bounds of the OBJ within {bounds.GLB_BOUNDS.value:g} m"
            )


def _glb_finding(part: str, value: float | str, bound: str) -> Finding:
    message = "the GLB shows another object than the other files; export the asset anew"
    return Finding(check="mesh.glb", part=part, value=value, bound=bound, message=message)


def collision(subject: Subject) -> Iterator[Finding]:
    """Collision pieces are convex and stay within the part; MuJoCo fills what is not convex."""
    margin = np.array([[-1.0], [1.0]]) * bounds.COLLISION_REACH.value
    for part in subject.bundle.parts:
        lower, upper = subject.meshes[part.name].bounds + margin
        for index, piece in enumerate(subject.collision[part.name]):
            label = f"{part.name}, piece {index}"
            low, high = piece.bounds
            out = float(max((lower - low).max(), (high - upper).max()))
            if out > 0.0:
                excess = out + bounds.COLLISION_REACH.value
                message = "contact would happen in the air; fit the piece to what it stands for"
                yield _piece_finding("mesh.reach", label, excess, bounds.COLLISION_REACH, message)
            if len(piece.vertices) == 8:
                continue
            if (gap := convexity_gap(piece)) > bounds.HULL_GAP.value:
                message = "simulators take its hull and fill the hollow; author convex pieces"
                yield _piece_finding("mesh.convex", label, gap, bounds.HULL_GAP, message)


def _piece_finding(check: str, part: str, value: float, bound: Bound, message: str) -> Finding:
    return Finding(check=check, part=part, value=value, bound=bound.at_most(), message=message)
