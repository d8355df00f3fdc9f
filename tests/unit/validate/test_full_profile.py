"""What only the full profile asks: open interiors, parts within reach, an object let go."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from artgen.articulation.types import ArticulatedObject, Limit
from artgen.core.mesh import Floats
from artgen.export.layout import MANIFEST
from artgen.geometry.solid import slab
from artgen.validate import validate_asset
from artgen.validate.bounds import shipped_bounds
from artgen.validate.interior import (
    View,
    hollow_points,
    inside_any,
    within_reach,
)
from artgen.validate.levels import Selection
from artgen.validate.read import read_subject
from artgen.validate.report import Report
from artgen.validate.subject import Source
from tests.strategies import mesh_of, piece
from tests.unit.validate.cabinet import CARCASS, DOOR, HINGE, SLIDE, cupboard, write_quick_bundle

BOX = (0.6, 0.4, 0.7)


def verdict(made: ArticulatedObject, folder: Path) -> Report:
    write_quick_bundle(made, folder)
    source = Source(format="bundle", file=folder / MANIFEST, root=folder)
    return validate_asset(source, Selection(profile="full"), shipped_bounds())


def test_a_sound_cabinet_passes_in_full(tmp_path: Path) -> None:
    report = verdict(cupboard(), tmp_path / "b")
    assert [str(finding) for finding in report.findings] == []
    assert {"semantics.interior", "semantics.reach", "dynamics.free"} <= set(report.judged)


def filled_carcass() -> ArticulatedObject:
    """The lower half of the carcass is one block to a simulator; nothing that moves goes there."""
    made = cupboard()
    block = piece(slab((-0.28, -0.15, 0.02), (0.28, 0.19, 0.68)))
    parts = tuple(
        dataclasses.replace(part, collision=(*part.collision, block))
        if part.name == "base"
        else part
        for part in made.parts
    )
    return dataclasses.replace(made, parts=parts)


def test_a_hollow_that_collision_fills_is_named(tmp_path: Path) -> None:
    (found,) = (
        finding
        for finding in verdict(filled_carcass(), tmp_path / "b").findings
        if finding.check == "semantics.interior"
    )
    assert found.part == "base"
    assert float(found.value) < 0.5


def test_the_share_of_every_container_is_noted(tmp_path: Path) -> None:
    notes = [note.text for note in verdict(cupboard(), tmp_path / "b").notes]
    assert [text for text in notes if "open to contact" in text] == [
        "base: 100.0% of a hollow of 141 l is open to contact",
        "drawer: 100.0% of a hollow of 21.1 l is open to contact",
    ]


def test_a_part_that_is_walled_in_is_out_of_reach(tmp_path: Path) -> None:
    """An inner box that slides a little, shut in by the carcass and a front that is part of it."""
    front = ((-0.3, -0.21, 0.0), (0.3, -0.2, 0.7))
    roof = ((-0.3, -0.21, 0.69), (0.3, 0.205, 0.7))
    floor = ((-0.3, -0.21, -0.01), (0.3, 0.205, 0.0))
    box = (((-0.2, -0.1, 0.53), (0.2, 0.1, 0.63)),)
    slide = dataclasses.replace(SLIDE, limit=Limit(lower=0.0, upper=0.05))
    made = cupboard(
        carcass=(*CARCASS[:3], CARCASS[4], front, roof, floor),
        drawer=box,
        slide=slide,
        door=(((-0.2, -0.1, 0.1), (0.2, -0.08, 0.4)),),
        hinge=dataclasses.replace(
            HINGE, origin=(-0.2, -0.1, 0.0), limit=Limit(lower=0.0, upper=0.1)
        ),
    )
    state: dict[str, float] = {}
    write_quick_bundle(made, tmp_path / "b")
    source = Source(format="bundle", file=tmp_path / "b" / MANIFEST, root=tmp_path / "b")
    subject = read_subject(source, shipped_bounds())
    assert View.at(subject, state).seen(None) == {"base"}
    assert {finding.part for finding in within_reach(subject)} == {"door", "drawer"}


def test_an_object_that_stands_on_nothing_below_its_weight_tilts(tmp_path: Path) -> None:
    """Only the back board reaches the floor; all else begins 5 cm above it."""
    back = CARCASS[-1]
    lifted = [((*low[:2], low[2] + 0.05), high) for low, high in CARCASS if high[2] - low[2] > 0.1]
    bottom = ((-0.282, -0.18, 0.05), (0.282, 0.195, 0.068))
    carcass = (*lifted[:2], bottom, CARCASS[3], back)
    door = tuple(((*low[:2], low[2] + 0.06), (*high[:2], high[2])) for low, high in DOOR)
    report = verdict(cupboard(carcass=carcass, door=door), tmp_path / "b")
    assert ("dynamics.free", "tilt") in {(f.check, f.part) for f in report.findings}, (
        report.findings
    )


@pytest.mark.parametrize("closed", [False, True])
def test_only_what_is_open_counts_as_hollow(closed: bool) -> None:
    """An open box encloses its inside but for the mouth; a shut one is of no use to hands."""
    mesh = mesh_of(CARCASS + ((((-0.282, -0.18, 0.018), (0.282, -0.17, 0.682)),) if closed else ()))
    points = hollow_points(mesh)
    assert (len(points) == 0) == closed
    walls = tuple(piece(slab(low, high)) for low, high in CARCASS)
    assert not inside_any(points, walls, 0.0).any()


def test_points_inside_convex_pieces_are_told_from_those_outside() -> None:
    cube = (piece(slab((0, 0, 0), (1, 1, 1))),)
    points: Floats = np.random.default_rng(0).uniform(-1, 2, size=(500, 3))
    inside = ((points > 0.1) & (points < 0.9)).all(axis=1)
    np.testing.assert_array_equal(inside_any(points, cube, 0.1), inside)
