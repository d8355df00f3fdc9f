"""Grips of foreign parts: where words or shape say, facing out, pulled as the joint opens."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from artgen.articulation.types import ArticulatedObject
from artgen.ingest.build import build
from artgen.ingest.grips import STANDS_OUT, with_grips
from artgen.ingest.options import Options
from artgen.ingest.partnet.folder import read_partnet
from artgen.validate.grips import way_of
from tests.unit.ingest.folders import cabinet


@pytest.fixture(scope="module")
def read(tmp_path_factory: pytest.TempPathFactory) -> ArticulatedObject:
    root: Path = cabinet().write(tmp_path_factory.mktemp("pm") / "45940")
    return build(read_partnet(root), Options(), asset_id="a", category="c").obj


def without_words(obj: ArticulatedObject) -> ArticulatedObject:
    return dataclasses.replace(obj, provenance={**obj.provenance, "fragments": {}})


def test_what_the_source_calls_a_handle_is_gripped(read: ArticulatedObject) -> None:
    obj = with_grips(read)
    door = next(part for part in obj.parts if part.label == "door")
    (grip,) = door.grips
    assert (grip.name, grip.kind) == (f"{door.name}_handle", "handle")
    assert grip.outward == pytest.approx((0.0, -1.0, 0.0))
    assert obj.provenance["grips_read"][grip.name] == "the source calls it a handle"


def test_without_words_what_stands_out_before_the_front_is_gripped(
    read: ArticulatedObject,
) -> None:
    """The same place as by the word."""
    named, bare = with_grips(read), with_grips(without_words(read))
    for one, other in zip(named.parts, bare.parts, strict=True):
        for by_word, by_shape in zip(one.grips, other.grips, strict=False):
            assert by_word.position == pytest.approx(by_shape.position, abs=1e-9)
    assert sum(len(part.grips) for part in bare.parts) >= 1


def test_a_grip_is_pulled_the_way_its_joint_opens(read: ArticulatedObject) -> None:
    obj = with_grips(read)
    joints = {joint.child: joint for joint in obj.joints}
    for part in obj.parts:
        for grip in part.grips:
            way = way_of(joints[part.name], grip)
            assert np.dot(way, grip.pull) / np.linalg.norm(way) == pytest.approx(1.0, abs=1e-9)


def test_parts_that_close_without_a_handle_are_told(read: ArticulatedObject) -> None:
    """A drawer of a front alone has nothing that stands out by 8 mm."""
    assert STANDS_OUT == 0.008
    obj = with_grips(without_words(read))
    for part in obj.parts[1:]:
        assert part.grips or "nothing" in obj.provenance["grips_read"][part.name]
