"""L5: the object is what its category says: its parts, their order, its size and weight."""

from collections.abc import Iterator, Mapping
from functools import cache

import numpy as np

from artgen.articulation.canonical import canonical_order
from artgen.articulation.roles import ROLES
from artgen.core.errors import RuleError, did_you_mean
from artgen.core.mesh import Floats
from artgen.rules import Band, CategoryRule, load_rule
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.report import Finding, Skipped
from artgen.validate.subject import Subject


def order(subject: Subject) -> Iterator[Finding]:
    """Parts stand in canonical order: low to high, front to back, left to right."""
    parts = subject.parts
    expected = canonical_order([subject.boxes[part.name] for part in parts])
    for place, index in enumerate(expected):
        if place != index:
            yield _finding(
                "semantics.order",
                parts[index].name,
                f"place {index}",
                f"place {place}",
                "training targets follow this order",
                "canonicalize before finishing",
            )


def roles(subject: BundleSubject) -> Iterator[Finding]:
    """Every part's label is a word of the vocabulary; the base alone is called base."""
    for place, part in enumerate(subject.bundle.parts):
        if part.label in ROLES and (part.label == "base") == (place == 0):
            continue
        yield _finding(
            "semantics.role",
            part.name,
            part.label,
            "base" if place == 0 else "a word of artgen.articulation.roles but base",
            "nobody can tell what such a part does",
            f"choose a role{did_you_mean(part.label, list(ROLES))}, or add one to the table",
        )


def _finding(
    check: str, part: str, value: float | str, bound: str, cause: str, remedy: str
) -> Finding:
    return Finding(check=check, part=part, value=value, bound=bound, cause=cause, remedy=remedy)


def ground(subject: Subject) -> Iterator[Finding]:
    """The object stands on z = 0, centered in x and y."""
    lower, upper = object_bounds(subject)
    middle = (lower + upper) / 2.0
    allowed = subject.bounds.ground.value
    for axis, value in (("x", middle[0]), ("y", middle[1]), ("z", lower[2])):
        if abs(value) > allowed:
            yield _finding(
                "semantics.ground",
                "object",
                float(value),
                f"0 within {allowed:g} m along {axis}",
                "cameras and simulators expect it there",
                "canonicalize before finishing",
            )


def together(subject: Subject) -> Iterator[Finding]:
    """No part floats far from all others at rest; the diagonal is that of the others together."""
    allowed = subject.bounds.apart
    boxes = subject.boxes
    for name, box in boxes.items():
        others = [other for rest, other in boxes.items() if rest != name]
        if not others:
            return
        gaps = [np.maximum(box[0] - other[1], other[0] - box[1]).clip(min=0.0) for other in others]
        nearest = min(float(np.linalg.norm(gap)) for gap in gaps)
        lower, upper = np.min(others, axis=0)[0], np.max(others, axis=0)[1]
        share = nearest / float(np.linalg.norm(upper - lower))
        if not share <= allowed.value:
            yield _finding(
                "semantics.apart",
                name,
                share,
                allowed.at_most(),
                f"{nearest:.3g} m of air lie between it and all other parts at rest",
                "look for a pivot in another unit, or a mesh that was not moved to its frame",
            )


def object_bounds(subject: Subject) -> Floats:
    """(2, 3) bounds of all visual meshes at rest, m."""
    boxes = np.array(list(subject.boxes.values()))
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def bands(subject: BundleSubject) -> Iterator[Finding | Skipped]:
    """Width, depth, height and mass lie in the category's bands."""
    if subject.origin.foreign:
        yield Skipped(name="semantics.band", reason="no rule of ours made it")
        return
    category = subject.bundle.category
    try:
        rule = packaged_rule(category)
    except RuleError as error:
        yield Skipped(name="semantics.band", reason=f"no bands for {category!r}: {error}")
        return
    width, depth, height = np.diff(object_bounds(subject), axis=0)[0].tolist()
    mass = sum(part.mass.mass for part in subject.bundle.parts)
    found = {"width": width, "depth": depth, "height": height, "mass": mass}
    yield from band_findings(rule.file, found, rule.bands)


@cache
def packaged_rule(category: str) -> CategoryRule:
    """The rule that comes with the package; it cannot change while a process runs."""
    return load_rule(category)


def band_findings(
    file: str, found: Mapping[str, float], allowed: Mapping[str, Band]
) -> Iterator[Finding]:
    """Each measure against its band (m, kg)."""
    for name, band in allowed.items():
        if found[name] not in band:
            unit = "kg" if name == "mass" else "m"
            yield _finding(
                f"semantics.{name}",
                "object",
                found[name],
                f"{band.lower:g} to {band.upper:g} {unit}",
                f"outside [band.{name}] of {file}",
                "narrow the ranges that it follows from",
            )
