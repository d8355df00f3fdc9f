"""Coverage: equal objects are twins, others are not; names do not matter; draws have addresses."""

import dataclasses
from pathlib import Path

import numpy as np

from artgen.articulation.types import Body, Draft, DraftPart, Joint, Limit
from artgen.core.surface import SurfaceSpec
from artgen.coverage_study.cli import study
from artgen.coverage_study.drawn import Drawn, depth, drawn, structure, topology
from artgen.coverage_study.neighbours import STEP, differing, neighbours
from artgen.coverage_study.rows import Coverage, ParameterRow
from artgen.coverage_study.views import MISS, PIXELS, views_of
from artgen.geometry.solid import slab
from artgen.studies.table import read_table
from tests.made import drafted

EXTENT = 2.0


def crate(height: float = 0.6, *, names: tuple[str, str] = ("lid", "hinge")) -> Draft:
    """A block with a lid."""
    base = Body(solid=slab((-0.3, -0.3, 0.0), (0.3, 0.3, height)), surface="wood", density=500.0)
    top = slab((-0.3, -0.3, height + 0.01), (0.3, 0.3, height + 0.03))
    hinge = Joint(
        name=names[1], type="revolute", parent="base", child=names[0], axis=(-1.0, 0.0, 0.0),
        origin=(0.0, 0.3, height + 0.01), limit=Limit(lower=0.0, upper=1.5),
        friction=0.6, damping=0.1, effort=9.0,
    )  # fmt: skip
    return Draft(
        category="crate",
        parts=(
            DraftPart(name="base", label="base", bodies=(base,)),
            DraftPart(name=names[0], label="lid", bodies=(dataclasses.replace(base, solid=top),)),
        ),
        joints=(hinge,),
        surfaces=(SurfaceSpec(name="wood", recipe="plain"),),
    )


def seen(draft: Draft, index: int) -> Drawn:
    return Drawn(
        category="crate", index=index, params={}, tries=1, topology="", structure="", roles={},
        kinds={}, depth=1, views=views_of(draft, extent=EXTENT),
    )  # fmt: skip


def test_equal_objects_are_twins_and_others_are_not() -> None:
    """A crate 40 mm higher is a pixel higher in every map but that from above: more than 5 %."""
    found = neighbours([seen(crate(), 0), seen(crate(), 1), seen(crate(0.64), 2)])
    assert [n.other for n in found[:2]] == [1, 0]
    assert [n.differing for n in found[:2]] == [0.0, 0.0]
    assert [n.twin for n in found] == [True, True, False]
    assert found[2].differing > 0.05


def test_the_front_map_is_the_silhouette_with_its_depth() -> None:
    """The front face is flat, so its map is one number over the area of the face."""
    front = views_of(crate(), extent=EXTENT)[0, 0]
    met = front[front != MISS]
    pixel = EXTENT / PIXELS
    assert np.ptp(met) < 1e-6  # float32 of distances near 1.
    # A pixel counts if its middle is covered: at most one row and column more or less.
    assert abs(met.size * pixel**2 - 0.6 * 0.62) <= (0.6 + 0.63) * pixel
    assert np.isclose(met[0] * EXTENT, EXTENT - 0.3, atol=1e-5)


def test_depths_count_from_the_stated_step() -> None:
    one = np.array([0.5, 0.5, MISS, MISS], np.float32)
    near, far = one + np.float32(0.9 * STEP), one + np.float32(1.1 * STEP)
    near[2:], far[2:] = MISS, MISS
    far[2] = 0.5
    assert differing(one, np.stack([one, near, far])).tolist() == [0.0, 0.0, 1.0]


def test_names_change_no_topology_but_joints_do() -> None:
    plain, renamed = crate(), crate(names=("cover", "pin"))
    assert topology(plain) == topology(renamed)
    assert structure(plain) == structure(renamed)
    sliding = dataclasses.replace(
        plain, joints=(dataclasses.replace(plain.joints[0], type="prismatic"),)
    )
    assert topology(sliding) != topology(plain)
    assert depth(drafted("dishwasher", 0)) == 2


def test_a_drawing_depends_on_its_address_alone() -> None:
    first, again = drawn("cabinet", 4, 7), drawn("cabinet", 4, 7)
    assert np.array_equal(first.views, again.views)
    assert first.params == again.params
    assert not np.array_equal(first.views, drawn("cabinet", 4, 8).views)


def test_the_study_writes_its_tables_and_pictures(tmp_path: Path) -> None:
    words = ["--categories", "cabinet", "--count", "3", "--workers", "1", "--out", str(tmp_path)]
    words += ["--kept", str(tmp_path / "kept")]
    assert study(words) == 0
    first = (tmp_path / "coverage.md").read_bytes()
    (kept,) = (tmp_path / "kept").glob("*.json")
    drawn_at = kept.stat().st_mtime_ns
    picture = (tmp_path / "coverage/cabinet.png").read_bytes()
    (tmp_path / "coverage/cabinet.png").unlink()
    assert study(words) == 0
    assert kept.stat().st_mtime_ns == drawn_at  # Nothing is drawn again.
    assert (tmp_path / "coverage.md").read_bytes() == first
    assert (tmp_path / "coverage/cabinet.png").read_bytes() == picture
    (row,) = read_table(tmp_path / "coverage.csv", Coverage)
    assert (row.category, row.objects, row.twins) == ("cabinet", 3, 0)
    parameters = read_table(tmp_path / "coverage_parameters.csv", ParameterRow)
    assert len(parameters) == row.numbers + row.choices
    assert (tmp_path / "coverage/cabinet.png").stat().st_size > 1000
    assert "| cabinet |" in (tmp_path / "coverage.md").read_text()
