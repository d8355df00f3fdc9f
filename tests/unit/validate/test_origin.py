"""Bundles of foreign sources: what the manifest says to be open is excused, and nothing else."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from artgen.articulation.types import ArticulatedObject
from artgen.core.mesh import TriMesh
from artgen.validate import Report, load_bounds, validate_asset
from artgen.validate.levels import Selection
from artgen.validate.origin import Origin, origin_of
from artgen.validate.subject import Source
from tests.unit.validate.cabinet import cupboard, write_quick_bundle

FOREIGN = {"source": {"dataset": "partnet-mobility", "id": "1"}}


def opened(provenance: Mapping[str, object]) -> ArticulatedObject:
    """The cupboard with one triangle of its base's first body missing."""
    obj = cupboard()
    mesh = obj.base.mesh
    left = slice(1, None)
    holed = TriMesh(
        vertices=mesh.vertices,
        faces=mesh.faces[left],
        uv=None if mesh.uv is None else mesh.uv[left],
        atlas=None if mesh.atlas is None else mesh.atlas[left],
        slot=np.asarray(mesh.slot)[left],
        body=np.asarray(mesh.body)[left],
    )
    base = dataclasses.replace(obj.base, mesh=holed, densities=None)
    return dataclasses.replace(obj, parts=(base, *obj.parts[1:]), provenance=provenance)


def verdict(obj: ArticulatedObject, folder: Path) -> Report:
    bundle = write_quick_bundle(obj, folder / "bundle")
    source = Source(format="bundle", file=bundle / "manifest.json", root=bundle)
    names = ("mesh.closed", "mesh.volume", "mesh.manifest", "inertia.density", "inertia.center")
    return validate_asset(source, Selection(names=names), load_bounds(None))


def found(report: Report) -> set[str]:
    return {finding.check for finding in report.findings}


def shells(bodies: list[int]) -> dict[str, object]:
    return {**FOREIGN, "shells": {"thickness": 0.004, "bodies": {"base": bodies}}}


def test_a_body_that_is_listed_need_not_be_closed(tmp_path: Path) -> None:
    report = verdict(opened(shells([0])), tmp_path)
    assert found(report) == set()
    assert any("has open surfaces" in skip.reason for skip in report.skipped)


@pytest.mark.parametrize(
    "provenance",
    [
        FOREIGN,
        shells([1]),
        {"shells": {"thickness": 0.004, "bodies": {"base": [0]}}},
        {**shells([0]), "source": {"dataset": "artgen"}},
    ],
    ids=["not listed", "another listed", "no source", "ours"],
)
def test_an_open_body_is_found_unless_a_foreign_source_lists_it(
    provenance: Mapping[str, object], tmp_path: Path
) -> None:
    assert "mesh.closed" in found(verdict(opened(provenance), tmp_path))


@pytest.mark.parametrize(
    "manifest",
    [
        {},
        {"source": 3},
        {"source": {"dataset": "x"}, "shells": []},
        {"source": {"dataset": "x"}, "shells": {"bodies": [1], "thickness": "2"}},
        {"source": {"dataset": "x"}, "shells": {"bodies": {"a": [[1], None]}}},
    ],
)
def test_junk_in_a_manifest_excuses_nothing(manifest: dict[str, object]) -> None:
    assert not any(origin_of(manifest).shells.values())


def test_a_manifest_that_names_no_source_is_ours() -> None:
    assert origin_of({}) == Origin()
    assert origin_of(FOREIGN).foreign
