"""Defects built into an object and exported faithfully: all files agree, the object is wrong."""

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from artgen.articulation.types import ArticulatedObject, Joint, Limit, Mass, Part, Precondition
from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.solid import rotation_about, slab
from artgen.rules import Band
from artgen.validate import validate_bundle
from artgen.validate.semantics import band_findings
from tests.strategies import Corners, piece
from tests.unit.validate.cabinet import (
    CARCASS,
    DOOR,
    DRAWER,
    HINGE,
    SLIDE,
    cupboard,
    write_quick_bundle,
)


def moved(boards: tuple[Corners, ...], x: float, y: float, z: float) -> tuple[Corners, ...]:
    """Boards shifted by (x, y, z) m."""
    shift = np.array((x, y, z))
    both = (
        tuple(np.round(np.add(corner, shift), 7).tolist()) for pair in boards for corner in pair
    )
    return tuple(zip(*[iter(both)] * 2, strict=True))


def scaled(obj: ArticulatedObject, factor: float) -> ArticulatedObject:
    """Lengths times `factor`, as when a unit is mistaken; masses stay."""

    def mesh(old: TriMesh) -> TriMesh:
        return dataclasses.replace(old, vertices=old.vertices * factor)

    parts = tuple(
        dataclasses.replace(
            part,
            mesh=mesh(part.mesh),
            collision=tuple(mesh(one) for one in part.collision),
            mass=Mass(
                mass=part.mass.mass,
                center=part.mass.center * factor,
                inertia=part.mass.inertia * factor**2,
            ),
        )
        for part in obj.parts
    )
    joints = (dataclasses.replace(HINGE, origin=tuple(np.multiply(HINGE.origin, factor))), SLIDE)
    return dataclasses.replace(obj, parts=parts, joints=joints)


def with_part(name: str, change: Callable[[Part], Part]) -> ArticulatedObject:
    """The cabinet with one part changed."""
    obj = cupboard()
    parts = tuple(change(part) if part.name == name else part for part in obj.parts)
    return dataclasses.replace(obj, parts=parts)


def with_mass(name: str, change: Callable[[Mass], Mass]) -> ArticulatedObject:
    """The cabinet with the mass properties of one part changed."""
    return with_part(name, lambda part: dataclasses.replace(part, mass=change(part.mass)))


def with_collision(name: str, *pieces: TriMesh) -> ArticulatedObject:
    """The cabinet with other collision pieces on one part."""
    return with_part(name, lambda part: dataclasses.replace(part, collision=pieces))


def about_the_pivot(mass: Mass) -> Mass:
    """The tensor taken about the hinge instead of the center of mass."""
    arm = mass.center - HINGE.origin
    shift = mass.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return dataclasses.replace(mass, inertia=mass.inertia + shift)


def clipped(mass: Mass) -> Mass:
    """Negative products of inertia lost, as an exporter once did."""
    return dataclasses.replace(mass, inertia=mass.inertia.clip(min=0.0))


def half_open_door() -> ArticulatedObject:
    """Rest with the door 0.3 rad open, and its joint starting there."""
    turn = rotation_about("z", -0.3, HINGE.origin)

    def turned(old: TriMesh) -> TriMesh:
        points = old.vertices @ turn[:3, :3].T + turn[:3, 3]
        return dataclasses.replace(old, vertices=np.round(points, 7))

    def part(old: Part) -> Part:
        rotation: Floats = turn[:3, :3]
        center = rotation @ old.mass.center + turn[:3, 3]
        tensor = rotation @ old.mass.inertia @ rotation.T
        mass = Mass(mass=old.mass.mass, center=center, inertia=(tensor + tensor.T) / 2.0)
        collision = tuple(turned(one) for one in old.collision)
        # Rounding the turned vertices moves the integrals by 1e-6, so densities are left out.
        return dataclasses.replace(
            old, mesh=turned(old.mesh), collision=collision, mass=mass, densities=None
        )

    return with_part("door", part)


L_SHAPE = piece(
    slab((-0.3, -0.18, 0.0), (-0.282, 0.2, 0.7)) | slab((-0.3, 0.19, 0.0), (0.3, 0.2, 0.7))
)
ONE_BLOCK = piece(slab((-0.3, -0.18, 0.0), (0.3, 0.205, 0.7)))
STICKS_OUT = piece(slab((-0.298, -0.23, 0.002), (0.298, -0.182, 0.498)))

FLAP = dataclasses.replace(
    HINGE,
    axis=(1.0, 0.0, 0.0),
    origin=(0.0, -0.182, 0.002),  # behind the center of mass, so that gravity opens it
    friction=0.0,
    limit=Limit(lower=0.0, upper=1.5),
)
NARROW: tuple[Corners, ...] = (((-0.278, -0.2, 0.502), (0.278, -0.182, 0.698)), *DRAWER[1:])
BEHIND = moved(NARROW, 0.0, 0.022, -0.4)
"""A drawer inside the carcass, behind the door."""


def slide(**changes: object) -> Joint:
    """The drawer's joint with changes."""
    return dataclasses.replace(SLIDE, **changes)  # type: ignore[arg-type]


def hinge(**changes: object) -> Joint:
    """The door's joint with changes."""
    return dataclasses.replace(HINGE, **changes)  # type: ignore[arg-type]


DEFECTS: dict[str, tuple[str, str, Callable[[], ArticulatedObject]]] = {
    "slide axis reversed": (
        "motion.overlap",
        "base, drawer",
        lambda: cupboard(slide=slide(axis=(0.0, 1.0, 0.0))),
    ),
    "slide axis tilted by 3 degrees": (
        "motion.overlap",
        "base, drawer",
        lambda: cupboard(slide=slide(axis=(math.sin(0.052), -math.cos(0.052), 0.0))),
    ),
    "hinge axis reversed": (
        "motion.overlap",
        "base, door",
        lambda: cupboard(hinge=hinge(axis=(0.0, 0.0, 1.0))),
    ),
    "hinge axis reversed, for collision": (
        "motion.collision",
        "base, door",
        lambda: cupboard(hinge=hinge(axis=(0.0, 0.0, 1.0))),
    ),
    "pivot on the wrong face": (
        "motion.overlap",
        "base, door",
        lambda: cupboard(hinge=hinge(origin=(0.298, -0.2, 0.0))),
    ),
    "pivot off the edge": (
        "semantics.hinge",
        "hinge",
        lambda: cupboard(hinge=hinge(origin=(-0.24, -0.2, 0.0))),
    ),
    "drawer 8 mm too wide": (
        "motion.overlap",
        "base, drawer",
        lambda: cupboard(
            drawer=(*DRAWER[:1], ((-0.286, -0.182, 0.51), (0.286, 0.17, 0.52)), *DRAWER[2:])
        ),
    ),
    "parts overlap at rest": (
        "motion.overlap",
        "door, drawer",
        lambda: cupboard(drawer=moved(DRAWER, 0.0, 0.0, -0.005)),
    ),
    "drawer behind a door without precondition": (
        "motion.overlap",
        "door, drawer",
        lambda: cupboard(drawer=BEHIND, order=(0, 2, 1)),
    ),
    "one block closes the carcass": (
        "motion.collision",
        "base, drawer",
        lambda: with_collision("base", ONE_BLOCK),
    ),
    "concave collision piece": (
        "mesh.convex",
        "base, piece 0",
        lambda: with_collision("base", L_SHAPE),
    ),
    "collision in the air": (
        "mesh.reach",
        "door, piece 0",
        lambda: with_collision("door", STICKS_OUT),
    ),
    "drawer rests half open": (
        "semantics.closed",
        "drawer",
        lambda: cupboard(
            drawer=moved(DRAWER, 0.0, -0.12, 0.0), slide=slide(limit=Limit(lower=0.0, upper=0.18))
        ),
    ),
    "door rests half open": ("semantics.closed", "door", half_open_door),
    "parts out of order": ("semantics.order", "door", lambda: cupboard(order=(0, 2, 1))),
    "object in the air": (
        "semantics.ground",
        "object",
        lambda: cupboard(
            carcass=moved(CARCASS, 0.0, 0.0, 0.01),
            drawer=moved(DRAWER, 0.0, 0.0, 0.01),
            door=moved(DOOR, 0.0, 0.0, 0.01),
        ),
    ),
    "drawer leaves its rails": (
        "semantics.travel",
        "slide",
        lambda: cupboard(slide=slide(limit=Limit(lower=0.0, upper=0.5))),
    ),
    "flap falls open": ("dynamics.settle", "hinge", lambda: cupboard(hinge=FLAP)),
    "millimeters read as meters": ("mesh.size", "base", lambda: scaled(cupboard(), 1000.0)),
    "meters read as millimeters": ("mesh.size", "base", lambda: scaled(cupboard(), 0.001)),
    "grams read as kilograms": (
        "inertia.density",
        "door",
        lambda: with_mass(
            "door", lambda m: Mass(mass=m.mass * 1e3, center=m.center, inertia=m.inertia * 1e3)
        ),
    ),
    "inertia about the pivot": (
        "inertia.integral",
        "door",
        lambda: with_mass("door", about_the_pivot),
    ),
    "inertia ten times too large": (
        "inertia.extent",
        "door",
        lambda: with_mass("door", lambda m: dataclasses.replace(m, inertia=m.inertia * 10.0)),
    ),
    "products of inertia clipped": ("inertia.integral", "door", lambda: with_mass("door", clipped)),
    "center of mass at the origin": (
        "inertia.center",
        "door",
        lambda: with_mass("door", lambda m: dataclasses.replace(m, center=np.zeros(3))),
    ),
}


@pytest.mark.parametrize("name", DEFECTS)
def test_a_built_in_defect_is_named(name: str, tmp_path: Path) -> None:
    check, part, make = DEFECTS[name]
    report = validate_bundle(write_quick_bundle(make(), tmp_path / "bundle"))
    assert (check, part) in {(f.check, f.part) for f in report.findings}, report.findings


def test_a_precondition_clears_the_drawer_behind_the_door(tmp_path: Path) -> None:
    rule = Precondition(joint="slide", requires="hinge", at_least=math.radians(95))
    obj = cupboard(drawer=BEHIND, order=(0, 2, 1), preconditions=(rule,))
    report = validate_bundle(write_quick_bundle(obj, tmp_path / "bundle"))
    assert [str(f) for f in report.findings] == []


def test_a_precondition_that_opens_too_little_is_found(tmp_path: Path) -> None:
    rule = Precondition(joint="slide", requires="hinge", at_least=math.radians(20))
    obj = cupboard(drawer=BEHIND, order=(0, 2, 1), preconditions=(rule,))
    report = validate_bundle(write_quick_bundle(obj, tmp_path / "bundle"))
    overlaps = [f for f in report.findings if f.check == "motion.overlap"]
    assert [f.part for f in overlaps] == ["door, drawer"]
    assert "with hinge = 0.3491" in overlaps[0].cause


def test_an_inset_drawer_with_a_handle_is_closed(tmp_path: Path) -> None:
    """Only its handle comes nearer when it is pushed, so 45 mm of free play behind do not count."""
    inset: tuple[Corners, ...] = (
        ((-0.278, -0.18, 0.502), (0.278, -0.162, 0.68)),
        ((-0.27, -0.162, 0.51), (0.27, 0.15, 0.52)),
        ((-0.27, -0.162, 0.52), (-0.258, 0.15, 0.64)),
        ((0.258, -0.162, 0.52), (0.27, 0.15, 0.64)),
        ((-0.05, -0.205, 0.6), (0.05, -0.18, 0.61)),
    )
    bundle = write_quick_bundle(cupboard(drawer=inset), tmp_path / "bundle")
    assert [str(finding) for finding in validate_bundle(bundle).findings] == []


def test_bands_name_the_measure_and_the_rule() -> None:
    allowed = {"width": Band(0.3, 0.5), "mass": Band(1.0, 2.0)}
    (finding,) = band_findings("rules/x.toml", {"width": 0.51, "mass": 2.0}, allowed)
    assert (finding.check, finding.value) == ("semantics.width", 0.51)
    assert "[band.width] of rules/x.toml" in finding.cause


def test_an_overlap_is_measured_exactly(tmp_path: Path) -> None:
    """The drawer's front reaches 3 mm into the door over 0.596 x 0.018 m."""
    obj = cupboard(drawer=moved(DRAWER, 0.0, 0.0, -0.007))
    report = validate_bundle(write_quick_bundle(obj, tmp_path / "bundle"))
    (finding,) = [f for f in report.findings if f.part == "door, drawer" and "overlap" in f.check]
    assert isinstance(finding.value, float)
    assert finding.value == pytest.approx(0.003 * 0.596 * 0.018, rel=1e-6)  # vertices on 1e-7 m.
