"""A perfect prediction becomes an object that passes every check and opens in MuJoCo."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import torch

from artgen.articulation.canonical import canonical_order
from artgen.core.errors import ModelError
from artgen.export import read_bundle, write_bundle
from artgen.geometry.solid import slab
from artgen.textures.atlas import LINEAR
from artgen.textures.library import TextureLibrary
from artgen.validate import validate_bundle
from artgen.worker import BlenderWorker
from model.batch import Articulation
from model.reconstruct.assemble import Assembled, Wishes, assemble
from model.reconstruct.guess import ObjectGuess, object_guess
from tests.unit.model.reconstruct.perfect import COLORS, RADIUS, cabinet, joint, part


@pytest.fixture(scope="module")
def done() -> Assembled:
    """The cabinet, its door and drawer 4 mm too large on every side."""
    return assemble(cabinet(overlap=0.004), Wishes(asset_id="perfect"))


def test_parts_stand_in_canonical_order_on_the_ground(done: Assembled) -> None:
    boxes = [part.mesh.bounds for part in done.object.parts]
    assert canonical_order(boxes) == [0, 1, 2]
    assert done.names == {0: "base", 1: "part_1", 2: "part_2"}
    low, high = np.min(boxes, axis=0)[0], np.max(boxes, axis=0)[1]
    assert low[2] == 0.0
    assert np.abs(low[:2] + high[:2]).max() <= 2e-7  # Vertices are rounded to 1e-7 m.


def test_the_joints_are_those_that_were_predicted(done: Assembled) -> None:
    door, drawer = done.object.joints
    assert (door.type, door.axis, drawer.type, drawer.axis) == (
        *("revolute", (0.0, 0.0, -1.0)),
        *("prismatic", (0.0, -1.0, 0.0)),
    )
    assert door.limit is not None
    assert door.limit.upper == np.pi / 2.0
    assert drawer.limit is not None
    assert drawer.limit.upper == 0.35
    hinge = np.array([-0.3, -0.27, 0.0]) + done.shift
    assert np.abs(np.array(door.origin)[:2] - hinge[:2]).max() <= 1e-12
    assert done.states == (
        {"part_1_joint": 0.3, "part_2_joint": 0.2},
        {"part_1_joint": 1.2, "part_2_joint": 0.1},
    )


def test_every_part_weighs_its_volume(done: Assembled) -> None:
    """A door of 0.6 x 0.028 x 0.53 m at 300 kg/m3; nothing was cut from it."""
    mass = done.object.parts[1].mass.mass
    assert abs(mass - 300.0 * 0.6 * 0.028 * 0.53) <= 1e-5 * mass


def test_texels_have_the_color_of_their_part(done: Assembled) -> None:
    """One color a part survives interpolation, linear light and back within a step of sRGB."""
    image, slots = done.color, {name: slot for slot, name in done.names.items()}
    side = len(image)
    for own in done.object.parts:
        middles = np.asarray(own.mesh.atlas).mean(axis=1)
        column, row = (middles[:, 0] * side).astype(int), ((1 - middles[:, 1]) * side).astype(int)
        expected = 255.0 * np.array(COLORS[slots[own.name]])
        assert np.abs(image[row, column] - expected).max() <= 1.0


def test_the_surface_is_named_by_its_image(done: Assembled, tmp_path: Path) -> None:
    library = TextureLibrary(tmp_path)
    (skin,) = done.object.surfaces
    library.keep(skin, done.images)
    assert np.array_equal(np.asarray(library.images(skin).color), done.color)
    mean = LINEAR[done.color].mean(axis=(0, 1))
    assert np.abs(np.array(skin.color) - mean).max() <= 1e-12


@pytest.mark.blender
def test_the_bundle_passes_every_check(
    done: Assembled, tmp_path: Path, blender: BlenderWorker
) -> None:
    """Closed, weighed, disjoint along all ways; MuJoCo loads, settles, opens and closes it."""
    folder = tmp_path / "bundle"
    folder.mkdir()
    library = TextureLibrary(tmp_path / "textures")
    library.keep(done.object.surfaces[0], done.images)
    write_bundle(done.object, folder, library=library, worker=blender, thumbnail=b"png")
    report = validate_bundle(folder)
    assert [str(finding) for finding in report.findings] == []
    assert {"dynamics.open", "dynamics.close", "motion.overlap"} <= set(report.judged)
    bundle = read_bundle(folder)
    assert bundle.surfaces == done.object.surfaces
    assert bundle.manifest["changes"] == list(done.changes)


def test_the_same_prediction_makes_the_same_object(done: Assembled) -> None:
    again = assemble(cabinet(overlap=0.004), Wishes(asset_id="perfect"))
    assert np.array_equal(again.color, done.color)
    for one, other in zip(again.object.parts, done.object.parts, strict=True):
        assert np.array_equal(one.mesh.vertices, other.mesh.vertices)
        assert np.array_equal(one.mesh.faces, other.mesh.faces)


def test_a_part_that_does_not_move_becomes_a_piece_of_the_base() -> None:
    guess = cabinet()
    foot = part(3, slab((-0.3, -0.25, -0.45), (0.3, 0.25, -0.4)))
    found = assemble(dataclasses.replace(guess, parts=(*guess.parts, foot)), Wishes())
    assert [own.name for own in found.object.parts] == ["base", "part_1", "part_2"]
    assert any("slot 3: it does not move" in change for change in found.changes)


def test_a_part_without_a_surface_shows_its_box() -> None:
    guess = cabinet()
    hollow = dataclasses.replace(
        guess.parts[1], vertices=np.zeros((0, 3)), faces=np.zeros((0, 3), np.int32)
    )
    found = assemble(
        dataclasses.replace(guess, parts=(guess.parts[0], hollow, guess.parts[2])), Wishes()
    )
    box = guess.parts[1].box + found.shift
    assert np.abs(found.object.parts[1].mesh.bounds - box).max() <= 1e-7
    assert any("predicted box stands for it" in change for change in found.changes)


def test_without_a_base_there_is_no_object() -> None:
    guess = cabinet()
    with pytest.raises(ModelError, match="no base in slot 0"):
        assemble(dataclasses.replace(guess, parts=guess.parts[1:]), Wishes())


def test_articulation_alone_becomes_boxes_in_meters() -> None:
    """Two filled slots of three; motions are shares of a turn."""
    articulation = Articulation(
        valid_BP=torch.tensor([[True, True, False]]),
        center_BP3=torch.tensor([[[0.0, 0.0, 0.0], [0.0, -0.5, 0.0], [0.0, 0.0, 0.0]]]),
        size_BP3=torch.tensor([[[1.0, 0.9, 1.2], [1.0, 0.04, 1.2], [0.0, 0.0, 0.0]]]),
        type_BP=torch.tensor([[0, 1, 0]]),
        axis_BP3=torch.tensor([[[0.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, 0.0]]]),
        origin_BP3=torch.tensor([[[0.0, 0.0, 0.0], [-0.5, -0.52, 0.0], [0.0, 0.0, 0.0]]]),
        motion_BTP=torch.tensor([[[0.0, 0.05, 0.0], [0.0, 0.2, 0.0]]]),
        limits_BP2=torch.tensor([[[0.0, 0.0], [0.0, 0.25], [0.0, 0.0]]]),
        parent_BP=torch.tensor([[-1, 0, -1]]),
    )
    guess: ObjectGuess = object_guess(articulation, 0, {}, radius=RADIUS)
    assert [own.slot for own in guess.parts] == [0, 1]
    (hinge,) = guess.joints
    expected = joint(1, "revolute", axis=(0.0, 0.0, -1.0), upper=np.pi / 2.0)
    assert np.abs(hinge.observed - 2.0 * np.pi * np.array([0.05, 0.2])).max() <= 1e-6
    assert abs(hinge.upper - expected.upper) <= 1e-6
    assert np.abs(hinge.origin - RADIUS * np.array([-0.5, -0.52, 0.0])).max() <= 1e-6
    assert (
        np.abs(np.ptp(guess.parts[0].box, axis=0) - RADIUS * np.array([1.0, 0.9, 1.2])).max() < 1e-6
    )
    found = assemble(guess, Wishes())
    assert [own.name for own in found.object.parts] == ["base", "part_1"]
