"""Whatever a manifest holds, validation reports; it never raises."""

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.export.layout import MANIFEST
from artgen.validate import validate_bundle
from artgen.validate.report import Report
from tests.unit.validate.cabinet import cupboard, write_quick_bundle

JUNK: list[object] = [None, -1, 0, 1e300, float("nan"), "", "door", [], {}, [None], True]
HARMLESS = {
    *("asset_id", "bounds", "bytes", "category", "center", "conventions", "densities", "index"),
    *("label", "license", "mass", "params", "provenance", "radius", "rule", "seed", "surfaces"),
    "versions",
}
"""Keys whose change alone need not make a bundle invalid."""


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_quick_bundle(cupboard(), tmp_path_factory.mktemp("fuzz") / "bundle")


def paths(value: object, at: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """The address of every value inside a JSON document."""
    items: list[tuple[Any, Any]] = []
    if isinstance(value, dict):
        items = list(value.items())
    elif isinstance(value, list):
        items = list(enumerate(value))
    return [path for key, item in items for path in ((*at, key), *paths(item, (*at, key)))]


@settings(deadline=None, max_examples=200)
@given(data=st.data())
def test_junk_in_a_manifest_is_reported_not_raised(bundle: Path, data: st.DataObject) -> None:
    original = (bundle / MANIFEST).read_text()
    document = json.loads(original)
    path = data.draw(st.sampled_from(paths(document)))
    junk = data.draw(st.sampled_from(JUNK))
    holder = document
    for step in path[:-1]:
        holder = holder[step]
    before = holder[path[-1]]
    holder[path[-1]] = junk
    try:
        (bundle / MANIFEST).write_text(json.dumps(document))
        report = validate_bundle(bundle)
    finally:
        (bundle / MANIFEST).write_text(original)
    assert isinstance(report, Report)
    if not same(junk, before) and not HARMLESS.intersection(map(str, path)):
        assert not report.ok, f"{path} = {junk!r} instead of {before!r} passed"


def same(junk: object, before: object) -> bool:
    """Equal but for roundings: 0 in place of a product of inertia of 1e-18 kg m2 is no defect."""
    numbers = isinstance(junk, int | float) and isinstance(before, int | float)
    return junk == before or (numbers and abs(junk - before) < 1e-12)  # type: ignore[operator]


def test_an_empty_folder_is_reported(tmp_path: Path) -> None:
    report = validate_bundle(tmp_path)
    assert {finding.part for finding in report.findings} == {MANIFEST, "asset.urdf", "asset.xml"}
    assert report.asset == tmp_path.name


@pytest.mark.parametrize("cut", [0, 10, 400, 4000])
def test_a_bundle_cut_anywhere_is_reported(bundle: Path, tmp_path: Path, cut: int) -> None:
    """Every file in turn shortened to its first bytes."""
    for file in sorted(path for path in bundle.rglob("*") if path.is_file()):
        if cut >= file.stat().st_size:
            continue
        folder = tmp_path / "copy"
        shutil.copytree(bundle, folder)
        place = folder / file.relative_to(bundle)
        place.write_bytes(place.read_bytes()[:cut])
        assert not validate_bundle(folder).ok
        shutil.rmtree(folder)
