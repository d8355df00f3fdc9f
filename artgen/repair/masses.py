"""Mass properties: the float64 integral over the closed visual mesh."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence

import numpy as np

from artgen.core.errors import ArtgenError
from artgen.core.mesh import Floats, TriMesh
from artgen.repair.change import Change, Left, Outcome
from artgen.repair.draft import Draft, link_element, link_visual, unsound, vector_text
from artgen.validate.inertia import centers, densities, rigid, uniform, weighed
from artgen.validate.report import Finding
from artgen.validate.subject import body_volumes
from artgen.validate.urdf_subject import UrdfSubject

DENSITY = 700.0
"""kg/m3 where no plausible mass is stated: wood, or plastic and sheet metal with air inside."""
TENSOR = (("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2))


def rigid_masses(draft: Draft) -> Iterator[Outcome]:
    """Links whose stated mass properties are those of no rigid body."""
    subject = draft.subject()
    labels = {body.label: body.name for body in subject.stated_bodies}
    reasons: dict[str, str] = {}
    for finding in rigid(subject):
        reasons.setdefault(labels[finding.part], f"{finding.check}: {finding.cause}")
    yield from _weighed_anew(draft, subject, reasons)


def fitting_masses(draft: Draft) -> Iterator[Outcome]:
    """Parts without mass properties, or with those of another body than the one that is seen."""
    subject = draft.subject()
    reasons: dict[str, str] = {}
    judged = all(float(volumes.sum()) > 0.0 for volumes in subject.volumes.values())
    said = [*densities(subject), *centers(subject), *uniform(subject)] if judged else []
    for part in subject.parts:
        own = [f for f in said if isinstance(f, Finding) and f.part == part.name]
        if part.mass is None and part.name in subject.meshes:
            why = "no mass properties were stated"
        elif own:
            why = f"{own[0].check}: {own[0].cause}"
        else:
            continue
        reasons |= {name: why for name, link in subject.links.items() if link.part == part.name}
    yield from _weighed_anew(draft, subject, reasons)


def _weighed_anew(draft: Draft, subject: UrdfSubject, reasons: dict[str, str]) -> Sequence[Outcome]:
    robot, outcomes = subject.robot, list[Outcome]()
    stated = {body.name: body.mass for body in subject.stated_bodies}
    for name, why in reasons.items():
        try:
            mesh = link_visual(subject, name)
        except (ArtgenError, OSError) as error:
            outcomes.append(Left(subject=name, why=f"{why}; its mesh cannot be read: {error}"))
            continue
        if mesh is None and name not in stated:
            continue
        doubt = unsound(mesh, draft.bounds)
        if mesh is None or doubt is not None:
            outcomes.append(Left(subject=name, why=f"{why}; not weighed anew, as {doubt}"))
            continue
        outcomes.append(_integrated(draft, link_element(robot, name), mesh, stated.get(name), why))
    draft.save_if_changed(robot)
    return outcomes


def _integrated(
    draft: Draft, link: ET.Element, mesh: TriMesh, stated: float | None, why: str
) -> Change:
    """State the mass properties of a uniform solid; its mass is the stated one if plausible."""
    volumes = body_volumes(mesh)
    low, high = draft.bounds.density_low.value, draft.bounds.density_high.value
    density = (math.nan if stated is None else stated) / float(volumes.sum())
    kept = low <= density <= high
    density = density if kept else DENSITY
    mass, center, tensor = weighed(mesh, np.full(len(volumes), density))
    _write_inertial(link, mass, center, (tensor + tensor.T) / 2.0)
    source = "the stated mass is kept" if kept else f"{DENSITY:g} kg/m3 is assumed"
    return Change(
        subject=link.get("name", ""),
        what="inertial",
        before="nothing" if stated is None else f"mass {stated:.6g} kg",
        after=f"mass {mass:.6g} kg, integrated over the visual mesh",
        why=f"{why}; {source}",
    )


def _write_inertial(link: ET.Element, mass: float, center: Floats, tensor: Floats) -> None:
    for old in link.findall("inertial"):
        link.remove(old)
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=vector_text(center), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=vector_text(mass))
    ET.SubElement(inertial, "inertia", {key: vector_text(tensor[i, j]) for key, i, j in TENSOR})
