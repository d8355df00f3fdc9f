"""Rounded bodies stay closed, keep their size, and lose about the volume that rounding takes."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from artgen.core.jsonio import plain
from artgen.core.mesh import Floats, Ints
from artgen.finish_jobs import RoundJob, read_bodies, write_bodies
from artgen.geometry.measure import moments, open_edges, welded
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, box, chamfered_box, cylinder, prism, tube, union
from artgen.worker import BlenderWorker

pytestmark = pytest.mark.blender

Rounded = tuple[list[tuple[Floats, Ints]], list[int]]


def rounded(
    blender: BlenderWorker, folder: Path, solids: list[Solid], radii: list[float]
) -> Rounded:
    meshes = [solid.trimesh() for solid in solids]
    write_bodies(folder / "in.npz", [(m.vertices, m.faces) for m in meshes], radius=radii)
    job = RoundJob(input=str(folder / "in.npz"), output=str(folder / "out.npz"))
    report = blender.run(plain(job), timeout_s=60)
    return read_bodies(folder / "out.npz")[0], report["kept_sharp"]


def volume(body: tuple[Floats, Ints]) -> float:
    return moments(body[0][body[1]]).volume


SHAPES: dict[str, Callable[[], Solid]] = {
    "cube": lambda: box((0.1, 0.1, 0.1)),
    "plate with a hole": lambda: box((0.4, 0.3, 0.02)) - box((0.2, 0.1, 0.05), at=(0, 0, -0.01)),
    "step": lambda: box((0.1, 0.1, 0.1)) - box((0.1, 0.1, 0.1), at=(0.05, 0.05, 0.05)),
    "open box": lambda: box((0.4, 0.3, 0.2)) - box((0.36, 0.26, 0.2), at=(0, 0, 0.02)),
    "rod": lambda: cylinder(0.02, 0.1),
    "pipe": lambda: tube(0.02, 0.015, 0.1),
    "crossed bore": lambda: cylinder(0.05, 0.1) - cylinder(0.02, 0.2, axis="x").at(-0.1, 0, 0.05),
    "key": lambda: chamfered_box((0.015, 0.015, 0.003), 0.0008),
    "cross": lambda: box((0.1, 0.02, 0.02)) | box((0.02, 0.1, 0.02)),
    "two lumps": lambda: union([box((0.1, 0.1, 0.1)), box((0.1, 0.1, 0.1), at=(0.3, 0, 0))]),
    "rounded plate": lambda: prism(rounded_rectangle(0.3, 0.2, 0.02), 0.02),
    "sheet": lambda: box((0.5, 0.0005, 0.3)),
}


@pytest.mark.parametrize("name", SHAPES)
def test_a_rounded_body_is_closed_within_its_old_bounds_and_smaller(
    name: str, blender: BlenderWorker, tmp_path: Path
) -> None:
    """Blender's float32 moves a face by 3e-8 of the body's half size: below 1e-8 m here."""
    solid = SHAPES[name]().at(0.3, -0.2, 0.1)
    (body,), kept = rounded(blender, tmp_path, [solid], [0.002])
    vertices, faces = welded(np.round(body[0], 7), body[1])
    assert kept == []
    assert open_edges(body[1]) == 0
    assert open_edges(faces) == 0
    assert len(faces) > len(solid.trimesh().faces)
    bounds = np.stack([vertices.min(axis=0), vertices.max(axis=0)])
    np.testing.assert_allclose(bounds, solid.bounds, rtol=0, atol=2e-7)
    assert 0.9 * solid.volume < volume((vertices, faces)) < solid.volume


@given(
    size=st.tuples(*[st.floats(0.02, 0.5)] * 3),
    radius=st.floats(0.0009, 0.004),
)
@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
def test_a_rounded_box_loses_the_volume_of_two_segment_rounds(
    size: tuple[float, float, float],
    radius: float,
    blender: BlenderWorker,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    """An edge of length L loses (1 - sin 45deg) r^2 L up to its corners: the square r^2 minus the
    fan of two triangles. Corners differ by less than r^3 each, of which there are eight."""
    solid = box(size)
    (body,), _ = rounded(blender, tmp_path_factory.mktemp("box"), [solid], [radius])
    lost = solid.volume - volume(body)
    expected = (1.0 - math.sin(math.pi / 4)) * radius**2 * 4.0 * sum(size)
    assert lost == pytest.approx(expected, abs=8.0 * radius**3 + 1e-6 * solid.volume)


def test_twins_in_other_places_come_back_as_twins(blender: BlenderWorker, tmp_path: Path) -> None:
    places = [(0.0183 * k, 0.05 * k, 0.7) for k in range(80)]
    keys = [box((0.015, 0.015, 0.003)).at(*place) for place in places]
    bodies, _ = rounded(blender, tmp_path, keys, [0.0005] * 80)
    first = bodies[0]
    for place, (vertices, faces) in zip(places, bodies, strict=True):
        assert np.array_equal(faces, first[1])
        # One rounding to 1e-9 before, float64 after.
        np.testing.assert_allclose(vertices - place, first[0] - places[0], rtol=0, atol=2e-9)


def test_a_body_that_cannot_be_rounded_comes_back_as_it_was(
    blender: BlenderWorker, tmp_path: Path
) -> None:
    """Edges of 0.05 mm leave no room for 2 mm anywhere on this rod; it stays sharp."""
    rod = cylinder(0.0001, 0.0002, segments=12)
    (body,), kept = rounded(blender, tmp_path, [rod], [0.02])
    mesh = rod.trimesh()
    if kept:
        assert np.array_equal(body[0], mesh.vertices)
        assert np.array_equal(body[1], mesh.faces)
    assert open_edges(body[1]) == 0
