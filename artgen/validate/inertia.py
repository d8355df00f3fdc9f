"""L2: masses, centers and inertia tensors are those of rigid bodies, and of these very meshes."""

import math
from collections.abc import Iterator

import numpy as np

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.measure import inertia
from artgen.validate.bounds import Bounds
from artgen.validate.report import Finding, Skipped
from artgen.validate.stated import StatedBody
from artgen.validate.subject import Subject, SubjectPart


def rigid(subject: Subject) -> Iterator[Finding]:
    """As stated in each file: mass > 0, tensor positive definite, A + B >= C."""
    for body in subject.stated_bodies:
        if not (math.isfinite(body.mass) and body.mass > 0.0):
            cause = "MuJoCo refuses it and others divide by it"
            remedy = "give its bodies a density"
            yield _finding("inertia.mass", body.label, body.mass, "> 0 kg", cause, remedy)
        if not (np.isfinite(body.inertia).all() and np.isfinite(body.center).all()):
            cause = "an element is missing or no number"
            remedy = "integrate the tensor about the center of mass"
            yield _finding(
                "inertia.tensor", body.label, "not finite", "finite numbers", cause, remedy
            )
        elif (problem := _tensor_problem(body, subject.bounds)) is not None:
            yield problem


def _tensor_problem(body: StatedBody, bounds: Bounds) -> Finding | None:
    """What makes a finite tensor impossible for a rigid body, or None."""
    with np.errstate(over="ignore", invalid="ignore"):
        low, middle, high = np.linalg.eigvalsh(body.inertia).tolist()
    cause = "no rigid body has such a tensor"
    remedy = "integrate about the center of mass and keep signed products"

    def finding(value: float, bound: str) -> Finding:
        return _finding("inertia.tensor", body.label, value, bound, cause, remedy)

    if not low > 0.0:
        return finding(low, "principal moments > 0 kg m2")
    if not low + middle >= high * (1.0 - bounds.triangle.value):
        return finding((low + middle) / high, "(A + B) / C >= 1")
    if not high / low <= bounds.inertia_ratio.value:
        return finding(high / low, bounds.inertia_ratio.at_most())
    return None


def _finding(
    check: str, part: str, value: float | str, bound: str, cause: str, remedy: str
) -> Finding:
    return Finding(check=check, part=part, value=value, bound=bound, cause=cause, remedy=remedy)


def _solid_volume(subject: Subject, part: SubjectPart) -> float | None:
    """Volume of a part's bodies, m3; None where it has no mesh or no mass, or where one is open."""
    if part.mass is None or part.name not in subject.volumes or part.name in subject.origin.shells:
        return None
    return float(subject.volumes[part.name].sum())


def densities(subject: Subject) -> Iterator[Finding | Skipped]:
    """Mass over volume of each part, and the density of each of its bodies, is that of a solid."""
    low, high = subject.bounds.density_low.value, subject.bounds.density_high.value
    allowed = f"{low:g} to {high:g} kg/m3"
    cause = "grams for kilograms, millimeters for meters, or a forgotten density"
    for part in subject.parts:
        volume = _solid_volume(subject, part)
        if volume is None or part.mass is None:
            why = (
                "has open surfaces"
                if part.name in subject.origin.shells
                else "states no mass or no mesh"
            )
            yield Skipped(name="inertia.density", reason=f"{part.name} {why}")
            continue
        bodies = len(subject.volumes[part.name])
        if part.densities is not None and len(part.densities) != bodies:
            value, bound = float(len(part.densities)), f"{bodies} densities, one a body"
            wrong, remedy = "the densities are those of another mesh", "export the asset anew"
            yield _finding("inertia.density", part.name, value, bound, wrong, remedy)
        for value in (part.mass.mass / volume, *(part.densities or ())):
            if not low <= value <= high:
                remedy = "weigh the mesh with its material's density"
                yield _finding("inertia.density", part.name, value, allowed, cause, remedy)


def centers(subject: Subject) -> Iterator[Finding]:
    """The center of mass lies inside the part's box, and no mass further out than the box: along
    each axis its variance is at most (upper - center)(center - lower) (Bhatia, Davis 2000)."""
    for part in subject.parts:
        if part.mass is None or part.name not in subject.meshes:
            continue  # Told by `densities`.
        lower, upper = subject.boxes[part.name] + _sheet(subject, part)
        inside = np.minimum(upper - part.mass.center, part.mass.center - lower)
        if inside.min() <= 0.0:
            cause = "the center is stated in another frame"
            remedy = "state it in the object frame in a manifest, in the link's in a URDF"
            yield _finding(
                "inertia.center", part.name, float(inside.min()), "> 0 m inside the box", cause,
                remedy,
            )  # fmt: skip
            continue
        tensor = part.mass.inertia
        variance = np.trace(tensor) / 2.0 - np.diag(tensor)
        room = part.mass.mass * (upper - part.mass.center) * (part.mass.center - lower)
        worst = float((variance / room).max())
        if not (worst <= 1.0 + subject.bounds.integral.value and variance.min() > 0.0):
            cause = "the tensor needs mass outside the part"
            remedy = "integrate about its center of mass"
            yield _finding("inertia.extent", part.name, worst, "0 to 1 of the box's", cause, remedy)


def _sheet(subject: Subject, part: SubjectPart) -> Floats:
    """(2, 1) m by which sheets, which weigh as if they had a thickness, stand out of their box."""
    half = subject.origin.thickness / 2.0 if part.name in subject.origin.shells else 0.0
    return np.array([[-half], [half]])


def ratio(subject: Subject) -> Iterator[Finding]:
    """The heaviest part is not so much heavier than the lightest that solvers lose the latter."""
    bound = subject.bounds.mass_ratio
    masses = {part.name: part.mass.mass for part in subject.parts if part.mass is not None}
    if not masses:
        return
    light, heavy = min(masses, key=masses.__getitem__), max(masses, key=masses.__getitem__)
    if masses[heavy] / masses[light] > bound.value:
        cause, remedy = f"{heavy} outweighs it", "make it part of what carries it"
        value = masses[heavy] / masses[light]
        yield _finding("inertia.ratio", light, value, bound.at_most(), cause, remedy)


def uniform(subject: Subject) -> Iterator[Finding]:
    """Where no densities are stated: principal moments are like those of a uniform solid."""
    bound = subject.bounds.uniform_ratio
    for part in subject.parts:
        volume = _solid_volume(subject, part)
        if part.densities is not None or part.mass is None or volume is None:
            continue
        mesh = subject.meshes[part.name]
        bodies = int(np.asarray(mesh.body).max()) + 1
        _, _, tensor = weighed(mesh, np.full(bodies, part.mass.mass / volume))
        ratio = np.linalg.eigvalsh(part.mass.inertia) / np.linalg.eigvalsh(tensor)
        worst = float(max(ratio.max(), 1.0 / ratio.min()))
        if not worst <= bound.value:
            cause = "the tensor is not that of this mesh with this mass"
            remedy = "integrate it over the mesh about its center of mass"
            yield _finding("inertia.uniform", part.name, worst, bound.at_most(), cause, remedy)


def integrals(subject: Subject) -> Iterator[Finding]:
    """Where body densities are stated: mass, center and tensor equal the exact integral."""
    bound = subject.bounds.integral.value
    for part in subject.parts:
        mesh = subject.meshes[part.name]
        bodies = int(np.asarray(mesh.body).max()) + 1
        if part.densities is None or part.mass is None or len(part.densities) != bodies:
            continue
        for what, value in integral_errors(part, mesh).items():
            if not value <= bound:
                yield _finding(
                    "inertia.integral",
                    part.name,
                    value,
                    f"{what} within {bound:g} of the integral",
                    "it was weighed as another shape, or about another point",
                    "weigh the finished mesh, about its center of mass, in the object frame",
                )


def integral_errors(part: SubjectPart, mesh: TriMesh) -> dict[str, float]:
    """Relative errors of a part's stated mass, center (of the box's diagonal) and tensor."""
    if part.mass is None:
        return {}
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
