"""What lies in a box is counted exactly, and its points hold all that a surface encloses there."""

import numpy as np

from artgen.core.mesh import Floats, TriMesh
from artgen.core.stream import Stream
from artgen.geometry.distance import turns_about
from artgen.geometry.solid import Solid, cylinder, hull, slab
from model.reconstruct.clipping import clipped, points_within

RING = cylinder(0.3, 0.4, segments=48) - cylinder(0.2, 0.4, segments=48)
CELL = np.array([[-0.1, -0.25, 0.1], [0.5, 0.26, 0.3]])


def area(triangles: Floats) -> float:
    a, b, c = triangles.transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2.0


def test_faces_in_a_side_of_a_box_do_not_reach_into_it() -> None:
    """The ring's ends lie in the planes of the cell above and of the one below."""
    for low, high in ((0.4, 0.5), (-0.1, 0.0)):
        cell = np.array([[-1.0, -1.0, low], [1.0, 1.0, high]])
        assert len(clipped(RING.trimesh().triangles, cell)) == 0


def test_boxes_that_fill_space_share_a_surface_out() -> None:
    """Sums of a few hundred areas of 1e-3 m2; roundings stay below 1e-15 each."""
    triangles = RING.trimesh().triangles
    steps = np.linspace(RING.bounds[0] - 0.01, RING.bounds[1] + 0.01, 4)
    total = sum(
        area(clipped(triangles, np.stack([steps[cell, axes], steps[np.add(cell, 1), axes]])))
        for axes in [np.arange(3)]
        for cell in map(list, np.ndindex(3, 3, 3))
    )
    assert abs(total - area(triangles)) <= 1e-12


def test_what_is_clipped_lies_in_its_box_and_on_its_planes() -> None:
    """Cut corners are put on the plane itself, so no rounding is allowed for across it; cuts along
    the other axes lie between inner points."""
    found = clipped(RING.trimesh().triangles, CELL).reshape(-1, 3)
    assert (found >= CELL[0] - 1e-15).all()
    assert (found <= CELL[1] + 1e-15).all()


def test_a_surface_goes_once_around_what_it_encloses() -> None:
    """An inverse tangent of each of 400 triangles, each to 1e-16 of a turn or a few."""
    points = np.array([[0.25, 0.0, 0.2], [0.0, 0.0, 0.2], [0.0, 0.25, 0.39], [0.4, 0.0, 0.2]])
    found = turns_about(points, RING.trimesh().triangles)
    assert np.abs(found - [1.0, 0.0, 1.0, 0.0]).max() <= 1e-12


def test_a_convex_solid_is_told_by_its_points_as_by_booleans() -> None:
    """Both hulls, and the exact intersection, are the same solid: 1e-2 m3, to roundings."""
    whole = cylinder(0.3, 0.4, segments=48)
    found = hull(points_within(whole.trimesh(), CELL))
    truth = whole & slab(CELL[0].tolist(), CELL[1].tolist())
    assert abs(found.volume - truth.volume) <= 1e-12
    assert (truth - found).volume <= 1e-12


def test_a_box_within_a_solid_is_all_of_it() -> None:
    """No surface passes there; its corners alone tell."""
    cell = np.array([[-0.1, -0.1, 0.1], [0.1, 0.1, 0.2]])
    found = points_within(cylinder(0.3, 0.4, segments=48).trimesh(), cell)
    assert abs(hull(found).volume - 0.2 * 0.2 * 0.1) <= 1e-15
    assert len(points_within(RING.trimesh(), cell)) == 0


def test_corners_on_the_surface_count_for_the_side_that_is_full() -> None:
    """A tray's hollow and a piece of its floor meet in the hollow's corner."""
    tray = slab((0.0, 0.0, 0.0), (0.5, 0.5, 0.2)) - slab((0.1, 0.1, 0.1), (0.4, 0.4, 0.2))
    hollow = np.array([[0.1, 0.1, 0.1], [0.4, 0.4, 1.0]])
    assert len(points_within(tray.trimesh(), hollow)) == 0
    floor = np.array([[-1.0, -1.0, -1.0], [0.1, 0.1, 0.1]])
    assert abs(hull(points_within(tray.trimesh(), floor)).volume - 1e-3) <= 1e-15


def test_nothing_of_a_surface_that_crosses_itself_is_lost() -> None:
    """Two bars that pass through each other as one surface, turned any way: all points of them
    that lie in a box lie in the hull, which a box around the middle shows at random."""
    bar = slab((-0.3, -0.02, -0.05), (0.3, 0.02, 0.05))
    mesh = _joined([bar, bar.turned("z", 1.1)])
    generator = Stream(0, "clipping").generator()
    for _ in range(20):
        lower, upper = np.sort(generator.uniform(-0.25, 0.25, (2, 3)), axis=0)
        tight = points_within(mesh, np.stack([lower, upper]))
        points = generator.uniform(lower, upper, (200, 3))
        inside = points[np.abs(turns_about(points, mesh.triangles)) > 0.5]
        if len(inside):
            around = hull(np.concatenate([tight, inside]))
            assert around.volume - hull(tight).volume <= 1e-15


def _joined(solids: list[Solid]) -> TriMesh:
    meshes = [solid.trimesh() for solid in solids]
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    faces = [mesh.faces + start for mesh, start in zip(meshes, starts, strict=True)]
    return TriMesh(
        vertices=np.concatenate([mesh.vertices for mesh in meshes]),
        faces=np.concatenate(faces),
    )
