"""Cleaning soups: what is doubled goes, what is closed faces outward, what is open is told."""

import numpy as np
import pytest

from artgen.core.mesh import Floats
from artgen.geometry.solid import box
from artgen.ingest.meshes.clean import (
    Body,
    Outside,
    bodies_of,
    pieces_by_edge,
    signed_volume,
    welded_soup,
)
from artgen.ingest.meshes.soup import Look, Soup


def soup_of(vertices: Floats, faces: Floats) -> Soup:
    count = len(faces)
    return Soup(
        vertices=np.asarray(vertices, float),
        faces=np.asarray(faces, np.int64),
        uv=np.arange(6.0 * count).reshape(count, 3, 2),
        look=np.zeros(count, np.int64),
        looks=(Look(),),
    )


def unit_box(size: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Soup:
    mesh = box(size).trimesh()
    return soup_of(mesh.vertices, mesh.faces)


def doubled(soup: Soup) -> Soup:
    """Every face again, turned around, on vertices of its own."""
    count = len(soup.vertices)
    return soup_of(
        np.concatenate([soup.vertices, soup.vertices]),
        np.concatenate([soup.faces, soup.faces[:, ::-1] + count]),
    )


def washed_bodies(soup: Soup) -> list[Body]:
    return bodies_of(welded_soup(soup)[0], "leaf")[0]


def test_doubled_faces_are_left_out_and_counted_and_the_first_copy_is_kept() -> None:
    plain = unit_box()
    found, washed = welded_soup(doubled(plain))
    assert (len(found.faces), washed.doubled, washed.flat) == (12, 12, 0)
    np.testing.assert_array_equal(found.uv, plain.uv)


def test_a_doubled_box_is_one_closed_body_facing_outward() -> None:
    (body,) = washed_bodies(doubled(unit_box((1.0, 2.0, 3.0))))
    assert body.closed
    assert signed_volume(body.soup) == pytest.approx(6.0, rel=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_faces_turned_at_random_are_turned_back(seed: int) -> None:
    soup = unit_box()
    turned = np.random.default_rng(seed).random(12) < 0.5
    faces = np.where(turned[:, None], soup.faces[:, ::-1], soup.faces)
    (body,) = washed_bodies(soup_of(soup.vertices, faces))
    assert body.closed
    assert signed_volume(body.soup) == pytest.approx(1.0, rel=1e-12)


def test_mirrored_winding_is_mended_and_told() -> None:
    soup = unit_box()
    bodies, washed = bodies_of(welded_soup(soup_of(soup.vertices, soup.faces[:, ::-1]))[0], "leaf")
    assert signed_volume(bodies[0].soup) > 0.0
    assert washed.turned == 12


def test_a_turned_face_keeps_its_texture_corner_by_corner() -> None:
    """Corner and texture point belong together, whichever way the face is wound."""
    soup = unit_box()
    pairs = {(*soup.vertices[v], *uv) for face, own in zip(soup.faces, soup.uv, strict=True)
             for v, uv in zip(face, own.tolist(), strict=True)}  # fmt: skip
    inward = Soup(vertices=soup.vertices, faces=soup.faces[:, ::-1], uv=soup.uv[:, ::-1],
                  look=soup.look, looks=soup.looks)  # fmt: skip
    (body,) = washed_bodies(inward)
    own = body.soup
    found = {(*own.vertices[v], *uv) for face, points in zip(own.faces, own.uv, strict=True)
             for v, uv in zip(face, points.tolist(), strict=True)}  # fmt: skip
    assert found == pairs


def test_two_boxes_that_touch_along_an_edge_stay_two_closed_bodies() -> None:
    """They share two vertices and one edge of four faces; pieces are joined by edges there, so
    that manifold3d is asked about all of them."""
    one, other = unit_box(), unit_box()
    shifted = np.add(other.vertices, (1.0, 1.0, 0.0))
    both = soup_of(np.concatenate([one.vertices, shifted]),
                   np.concatenate([one.faces, other.faces + 8]))  # fmt: skip
    bodies = washed_bodies(both)
    total = sum(signed_volume(body.soup) for body in bodies)
    assert total == pytest.approx(2.0, rel=1e-12)


def test_an_open_box_is_a_shell() -> None:
    soup = unit_box()
    bodies = washed_bodies(soup.of(np.arange(12) != 3))
    assert [body.closed for body in bodies] == [False]


def test_closed_and_open_pieces_of_a_fragment_are_told_apart() -> None:
    one = unit_box()
    sheet = np.array([[5.0, 0, 0], [6, 0, 0], [5, 1, 0], [9, 9, 9], [8, 9, 9], [9, 8, 9]])
    both = soup_of(np.concatenate([one.vertices, sheet]),
                   np.concatenate([one.faces, [[8, 9, 10], [11, 12, 13]]]))  # fmt: skip
    bodies = washed_bodies(both)
    assert [(body.closed, len(body.soup.faces)) for body in bodies] == [(True, 12), (False, 2)]


def test_flat_triangles_are_left_out() -> None:
    soup = soup_of([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 1, 3], [0, 0, 3]])
    found, washed = welded_soup(soup)
    assert (len(found.faces), washed.flat) == (1, 2)


def test_shells_are_turned_to_where_rays_go_further() -> None:
    """The five boards of an open case, each wound at random: the inner side sees the case, the
    outer the sky."""
    rng = np.random.default_rng(1)
    soup = unit_box()
    kept = [k for k in range(12) if np.cross(*np.diff(soup.vertices[soup.faces[k]], axis=0))[2] < 1]
    faces = soup.faces[kept]
    flip = rng.random(len(faces)) < 0.5
    loose = np.where(flip[:, None], faces[:, ::-1], faces)
    bodies = washed_bodies(soup_of(soup.vertices, loose))
    facing, _ = Outside(bodies).facing_out(bodies[0])
    a, b, c = facing.soup.vertices[facing.soup.faces].transpose(1, 0, 2)
    away = (a + b + c) / 3.0 - soup.vertices.mean(axis=0)
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), away) > 0.0).all()
    assert facing.certain


def test_a_lone_sheet_may_face_either_way_and_says_so() -> None:
    soup = soup_of([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    bodies = washed_bodies(soup)
    facing, turned = Outside(bodies).facing_out(bodies[0])
    assert (facing.certain, turned) == (False, 0)


def test_pieces_are_joined_by_edges_not_by_corners() -> None:
    faces = np.array([[0, 1, 2], [2, 3, 4], [1, 2, 5]])
    piece = pieces_by_edge(faces)
    assert piece[0] == piece[2] != piece[1]
