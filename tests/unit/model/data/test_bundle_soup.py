"""A bundle is seen as the draft that it was finished from."""

import json
from dataclasses import replace

import numpy as np
import pytest
import torch

from artgen.core.errors import ExportError
from artgen.core.stream import Stream
from artgen.core.surface import linear_from_srgb
from artgen.export import layout
from model.data.bundle_soup import bundle_soup
from model.data.cameras import state_cameras
from model.data.scene import drawn_scene
from model.data.soup import Soup, draft_soup
from model.data.stage import photographs, staged
from tests.made import drafted, finished
from tests.strategies import box_part, drawer_unit
from tests.unit.model.data.small import CONFIG, written_bundle

CPU = torch.device("cpu")


def _plain(color: tuple[int, int, int]) -> np.ndarray:
    return np.full((16, 16, 3), color, np.uint8)


def _masks(soup: Soup) -> np.ndarray:
    scene = drawn_scene(soup, CONFIG, Stream(4))
    cameras = state_cameras([scene.inputs], CPU)
    return photographs(staged([scene], CPU), cameras, size=64)[..., 3].numpy()


def test_a_bundle_shows_the_outline_of_its_draft(tmp_path):
    folder = written_bundle(finished("cabinet", 0), tmp_path, _plain((200, 100, 50)))
    found = bundle_soup(folder, tolerance=0.0)
    draft = draft_soup(drafted("cabinet", 0), asset_id="cabinet_000000", tolerance=0.0)
    assert found.parts == draft.parts
    assert found.joints == draft.joints
    # The finished object's vertices are rounded to 1e-7 m.
    np.testing.assert_allclose(found.bounds, draft.bounds, atol=1e-6)
    off = (_masks(found) != _masks(draft)).sum()
    assert off <= 3  # Rays within 1e-6 of an outline.


def test_a_body_of_one_color_is_simplified_and_has_it(tmp_path):
    folder = written_bundle(finished("laptop", 0), tmp_path, _plain((200, 100, 50)))
    exact, coarse = (bundle_soup(folder, tolerance=x) for x in (0.0, 0.01))
    assert len(coarse.faces) < 0.8 * len(exact.faces)
    expected = [linear_from_srgb(c / 255) for c in (200, 100, 50)]
    np.testing.assert_allclose(coarse.looks[:, :3], [expected], atol=1e-6)


def test_faces_have_the_color_of_their_place_on_the_atlas(tmp_path):
    """The left half of the atlas is red, the right half blue."""
    atlas = _plain((255, 0, 0))
    atlas[:, 8:] = (0, 0, 255)
    obj = drawer_unit()
    soup = bundle_soup(written_bundle(obj, tmp_path, atlas), tolerance=0.0)
    for p, part in enumerate(obj.parts):
        middle = part.mesh.triangles.mean(axis=1)
        shown = soup.vertices[soup.faces].mean(axis=1)[soup.part == p]
        color = soup.looks[soup.surface[soup.part == p], :3]
        for place, uv in zip(middle, part.mesh.atlas, strict=True):
            if (uv[:, 0] < 0.5).all() or (uv[:, 0] > 0.5).all():
                k = np.abs(shown - place).sum(axis=1).argmin()
                assert color[k].tolist() == ([1, 0, 0] if uv[0, 0] < 0.5 else [0, 0, 1])


def test_donors_are_kept(tmp_path):
    folder = written_bundle(drawer_unit(), tmp_path, _plain((9, 9, 9)))
    path = folder / layout.MANIFEST
    path.write_text(json.dumps({**json.loads(path.read_text()), "donors": ["a_1", "b_2"]}))
    assert bundle_soup(folder).donors == ("a_1", "b_2")


def test_the_family_of_a_foreign_object_decides_its_split(tmp_path):
    folder = written_bundle(drawer_unit(), tmp_path, _plain((9, 9, 9)))
    path = folder / layout.MANIFEST
    source = {"dataset": "urdf", "id": "a", "family": "urdf:a"}
    path.write_text(json.dumps({**json.loads(path.read_text()), "source": source}))
    assert bundle_soup(folder).donors == ("urdf:a",)


def test_a_folder_that_is_no_bundle_is_refused(tmp_path):
    with pytest.raises(ExportError, match=r"manifest\.json"):
        bundle_soup(tmp_path)


BOXES = [
    ((-0.2, -0.2, 0.4), (0.2, 0.2, 0.44)),
    ((-0.2, -0.2, 0.0), (-0.16, -0.16, 0.4)),
    ((0.16, -0.2, 0.0), (0.2, -0.16, 0.4)),
    ((-0.2, 0.16, 0.0), (0.2, 0.2, 0.4)),
]
RUNS = [
    {"leaf": "0_seat", "bodies": [0, 1]},
    {"leaf": "1_legs", "bodies": [1, 2]},
    {"leaf": "2_panel", "bodies": [3, 1]},
]


def _stool(dataset):
    """Four bodies in one rigid part, of which the source makes three."""
    provenance = {"source": {"dataset": dataset, "id": "stool"}, "fragments": {"base": RUNS}}
    parts = (box_part("base", BOXES),)
    return replace(drawer_unit(), parts=parts, joints=(), preconditions=(), provenance=provenance)


def test_the_parts_of_a_static_mesh_are_those_that_its_file_names(tmp_path):
    """They lay in the manifest alone, so that static pre-training saw one part an object. They
    fill slots as fixed parts; the control is an object of which leaves are no parts."""
    soup = bundle_soup(written_bundle(_stool("static"), tmp_path / "a"), tolerance=0.0)
    assert soup.parts == ("base", "1_legs", "2_panel")
    legs = np.array([np.min(BOXES[1:3], axis=(0, 1)), np.max(BOXES[1:3], axis=(0, 1))])
    np.testing.assert_allclose(soup.bounds, [BOXES[0], legs, BOXES[3]], atol=1e-6)
    assert np.bincount(soup.part).tolist() == [12, 24, 12]
    for motion in ("rest", "states"):
        scene = drawn_scene(soup, replace(CONFIG, motion=motion), Stream(4))
        truth = scene.truth.arrays
        assert truth["valid_P"].sum() == 3
        assert not truth["type_P"].any()
        assert np.array_equal(scene.poses, np.broadcast_to(np.eye(4), scene.poses.shape))
    other = bundle_soup(written_bundle(_stool("urdf"), tmp_path / "b"), tolerance=0.0)
    assert other.parts == ("base",)
    np.testing.assert_array_equal(other.vertices, soup.vertices)
