"""L2: masses, centers and inertia tensors are those of rigid bodies, and of these very meshes."""

import math
from collections.abc import Iterator

import numpy as np

from artgen.core.mesh import Floats, TriMesh
from artgen.export.bundle import BundlePart
from artgen.export.layout import MANIFEST, URDF
from artgen.geometry.measure import inertia
from artgen.validate import bounds
from artgen.validate.report import Finding
from artgen.validate.stated import StatedBody, manifest_bodies, urdf_bodies
from artgen.validate.subject import Subject


def rigid(subject: Subject) -> Iterator[Finding]:
    """As stated in manifest and URDF: mass > 0, tensor positive definite, A + B >= C."""
    bodies = manifest_bodies(MANIFEST, subject.manifest) + urdf_bodies(URDF, subject.urdf)
    for body in bodies:
        if not (math.isfinite(body.mass) and body.mass > 0.0):
            message = "MuJoCo refuses it and others divide by it; give its bodies a density"
            yield _finding("inertia.mass", body.label, body.mass, "> 0 kg", message)
        if not (np.isfinite(body.inertia).all() and np.isfinite(body.center).all()):
            message = "every element must be a number; export the asset anew"
            yield _finding("inertia.tensor", body.label, "not finite", "finite numbers", message)
        elif (problem := _tensor_problem(body)) is not None:
            yield problem


def _tensor_problem(body: StatedBody) -> Finding | None:
    """What makes a finite tensor impossible for a rigid body, or None."""
    low, middle, high = np.linalg.eigvalsh(body.inertia).tolist()
    message = "no rigid body has it; integrate about the center of mass and keep signed products"
    if low <= 0.0:
        return _finding("inertia.tensor", body.label, low, "principal moments > 0 kg m2", message)
    if low + middle < high * (1.0 - bounds.TRIANGLE.value):
        value = (low + middle) / high
        return _finding("inertia.tensor", body.label, value, "(A + B) / C >= 1", message)
    if high / low > bounds.INERTIA_RATIO.value:
        return _finding(
            "inertia.tensor", body.label, high / low, bounds.INERTIA_RATIO.at_most(), message
        )
    return None


def _finding(check: str, part: str, value: float | str, bound: str, message: str) -> Finding:
    return Finding(check=check, part=part, value=value, bound=bound, message=message)


def densities(subject: Subject) -> Iterator[Finding]:
    """Mass over volume of each part, and the density of each of its bodies, is that of a solid."""
    allowed = f"{bounds.DENSITY_LOW.value:g} to {bounds.DENSITY_HIGH.value:g} kg/m3"
    message = "grams for kilograms, millimeters for meters, or a forgotten density"
    for part in subject.bundle.parts:
        if part.densities is not None and len(part.densities) != part.bodies:
            value, bound = float(len(part.densities)), f"{part.bodies} densities, one a body"
            yield _finding("inertia.density", part.name, value, bound, "export the asset anew")
        volume = float(subject.volumes[part.name].sum())
        for value in (part.mass.mass / volume, *(part.densities or ())):
            if not bounds.DENSITY_LOW.value <= value <= bounds.DENSITY_HIGH.value:
                yield _finding("inertia.density", part.name, value, allowed, message)


def centers(subject: Subject) -> Iterator[Finding]:
    """The center of mass lies inside the part's box, and no mass further out than the box: along
    each axis its variance is at most (upper - center)(center - lower) (Bhatia, Davis 2000)."""
    for part in subject.bundle.parts:
        lower, upper = subject.meshes[part.name].bounds
        inside = np.minimum(upper - part.mass.center, part.mass.center - lower)
        if inside.min() <= 0.0:
            message = "the frame is wrong: the manifest states it in the object frame"
            yield _finding(
                "inertia.center", part.name, float(inside.min()), "> 0 m inside the box", message
            )
            continue
        tensor = part.mass.inertia
        variance = np.trace(tensor) / 2.0 - np.diag(tensor)
        room = part.mass.mass * (upper - part.mass.center) * (part.mass.center - lower)
        worst = float((variance / room).max())
        if not (worst <= 1.0 + bounds.INTEGRAL.value and variance.min() > 0.0):
            message = "the tensor needs mass outside the part; integrate about its center of mass"
            yield _finding("inertia.extent", part.name, worst, "0 to 1 of the box's", message)


def integrals(subject: Subject) -> Iterator[Finding]:
    """Where body densities are stated: mass, center and tensor equal the exact integral."""
    for part in subject.bundle.parts:
        if part.densities is None or len(part.densities) != part.bodies:
            continue
        mesh = subject.meshes[part.name]
        for what, value in integral_errors(part, mesh).items():
            if not value <= bounds.INTEGRAL.value:
                yield _finding(
                    "inertia.integral",
                    part.name,
                    value,
                    f"{what} within {bounds.INTEGRAL.value:g} of the integral",
                    "weigh the finished mesh, about its center of mass, in the object frame",
                )


def integral_errors(part: BundlePart, mesh: TriMesh) -> dict[str, float]:
    """Relative errors of a part's stated mass, center (of the box's diagonal) and tensor."""
    mass, center, tensor = weighed(mesh, np.array(part.densities))
    diagonal = float(np.linalg.norm(np.diff(mesh.bounds, axis=0)))
    return {
        "mass": abs(part.mass.mass - mass) / mass,
        "center": float(np.abs(part.mass.center - center).max()) / diagonal,
        "inertia": float(np.abs(part.mass.inertia - tensor).max() / np.abs(tensor).max()),
    }


def weighed(mesh: TriMesh, density: Floats) -> tuple[float, Floats, Floats]:
    """Mass (kg), center (m) and inertia about it (kg m2) with `density[body]` kg/m3 in each body.

    One pass over all triangles about the middle of the box (Blow, Binstock 2004).
    """
    middle = mesh.bounds.mean(axis=0)
    a, b, c = (mesh.triangles - middle).transpose(1, 0, 2)
    weight = np.einsum("ij,ij->i", a, np.cross(b, c)) * density[np.asarray(mesh.body)]
    total = a + b + c
    mass = float(weight.sum() / 6.0)
    center = weight @ total / (24.0 * mass)
    second = sum((weight[:, None] * x).T @ x for x in (a, b, c, total)) / 120.0
    return mass, center + middle, inertia(second - mass * np.outer(center, center))
