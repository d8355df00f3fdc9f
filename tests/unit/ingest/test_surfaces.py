"""Materials of strangers as surfaces: tiles from gradients, images once, panes clear."""

import io

import numpy as np
import pytest
from PIL import Image

from artgen.ingest.meshes.clean import Body
from artgen.ingest.meshes.soup import Look, Soup
from artgen.ingest.surfaces import SIDE, decoded, gradients, surfaces_of


def png(width: int, height: int) -> bytes:
    stream = io.BytesIO()
    Image.new("RGB", (width, height), (200, 100, 50)).save(stream, "PNG")
    return stream.getvalue()


def body(looks: tuple[Look, ...], look: list[int], uv_per_m: tuple[float, float]) -> Body:
    corners = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], float)
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    uv = corners[faces][..., :2] * uv_per_m
    soup = Soup(vertices=corners, faces=faces, uv=uv, look=np.array(look), looks=looks)
    return Body(soup=soup, leaf="x", closed=False)


def test_a_tile_is_as_large_as_one_copy_of_the_image() -> None:
    """u grows by 1 over 0.5 m, v over 0.25 m."""
    image = Look(image=png(8, 8))
    (spec,) = surfaces_of([body((image,), [0, 0], (2.0, 4.0))]).specs
    assert spec.recipe == "picture"
    np.testing.assert_allclose(spec.tile, (0.5, 0.25), rtol=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_gradients_are_those_of_an_affine_map(seed: int) -> None:
    """A triangle anywhere, uv = A x + b along two orthonormal directions: lengths 1 / |row|."""
    rng = np.random.default_rng(seed)
    frame = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    flat = rng.uniform(-1, 1, (4, 3, 2))
    corners = flat @ frame[:, :2].T + rng.normal(size=3)
    matrix = rng.normal(size=(2, 2))
    found = gradients(corners, flat @ matrix.T + rng.normal(size=2))
    expected = 1.0 / np.linalg.norm(matrix, axis=1)
    # Thin triangles lose digits by their shape, up to 1e3 here.
    np.testing.assert_allclose(found[:, :2], np.tile(expected, (4, 1)), rtol=1e-9)


def test_equal_looks_share_a_surface_whatever_their_names_were() -> None:
    red, same, blue = Look(color=(1, 0, 0)), Look(color=(1, 0, 0)), Look(color=(0, 0, 1))
    found = surfaces_of([body((red, blue), [0, 1], (1, 1)), body((same,), [0, 0], (1, 1))])
    assert len(found.specs) == 2
    assert found.slots[red.digest] == found.slots[same.digest] == 0


def test_what_lets_light_through_is_a_pane() -> None:
    (spec,) = surfaces_of([body((Look(opacity=0.2, image=png(4, 4)),), [0, 0], (1, 1))]).specs
    assert (spec.recipe, spec.transmission) == ("plain", 1.0)


def test_broken_and_bomb_images_are_counted_and_plain_colors_stand_for_them() -> None:
    found = surfaces_of([body((Look(image=b"no image"),), [0, 0], (1, 1))])
    assert (found.unreadable, found.specs[0].recipe) == (1, "plain")


def test_large_images_are_made_smaller() -> None:
    assert decoded(png(3 * SIDE, 10)).shape == (3, SIDE, 3)


def test_images_that_claim_too_much_are_not_decoded() -> None:
    """A PNG header of 30000 by 30000 px on a few bytes."""
    content = bytearray(png(4, 4))
    content[16:24] = (30000).to_bytes(4, "big") * 2
    assert decoded(bytes(content)) is None
