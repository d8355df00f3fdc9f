"""Parts that become part of what carries them."""

import numpy as np
import pytest

from artgen.core.errors import IngestError
from artgen.ingest.foreign import ForeignJoint, ForeignObject, ForeignPart, ForeignShape
from artgen.ingest.reduce import bounded_slides, capped, without_still_joints


def unread() -> None:
    raise AssertionError("nothing is read here")


def chain(count: int, *, still: tuple[int, ...] = ()) -> ForeignObject:
    """Part k hangs on part k - 1; each has one shape called after it, and weighs k kg."""
    parts = tuple(
        ForeignPart(name=f"p{k}", word="w", mass=float(k) or None,
                    shapes=(ForeignShape(leaf=f"p{k}", label="", read=unread),))
        for k in range(count)
    )  # fmt: skip
    joints = tuple(
        ForeignJoint(name=f"j{k}", type="prismatic", parent=f"p{k - 1}", child=f"p{k}",
                     axis=(1.0, 0.0, 0.0), origin=(0.0, 0.0, 0.0), lower=0.0,
                     upper=0.0 if k in still else 1.0)
        for k in range(1, count)
    )  # fmt: skip
    return ForeignObject(dataset="d", id="i", category="c", digest="", parts=parts, joints=joints,
                         object_from_source=np.eye(3))  # fmt: skip


def shapes(obj: ForeignObject) -> dict[str, list[str]]:
    return {part.name: [shape.leaf for shape in part.shapes] for part in obj.parts}


def test_joints_without_range_are_fixed_and_told() -> None:
    found = without_still_joints(chain(4, still=(1, 2)))
    assert shapes(found) == {"p0": ["p0", "p1", "p2"], "p3": ["p3"]}
    assert [(j.parent, j.child) for j in found.joints] == [("p0", "p3")]
    assert len(found.doubts) == 2
    assert found.parts[0].mass == 3.0


def test_the_smallest_parts_that_carry_none_are_fixed_first() -> None:
    obj = chain(4)
    found = capped(obj, {"p0": 1.0, "p1": 0.1, "p2": 0.2, "p3": 0.9}, most=2)
    assert shapes(found) == {"p0": ["p0"], "p1": ["p1", "p2", "p3"]}
    assert found.doubts == ("2 of 4 parts, the smallest, are fixed: at most 2 are kept",)


def test_an_object_of_few_parts_is_left_alone() -> None:
    obj = chain(3)
    assert capped(obj, {}, most=3) is obj
    with pytest.raises(IngestError, match="at least one part"):
        capped(obj, {}, most=0)


def test_slides_without_stops_get_half_their_length() -> None:
    joint = ForeignJoint(name="j", type="prismatic", parent="a", child="b", axis=(1.0, 0.0, 0.0),
                         origin=(0.0, 0.0, 0.0), lower=None, upper=None)  # fmt: skip
    (found,), doubts = bounded_slides([joint], {"b": 0.6})
    assert (found.lower, found.upper) == (0.0, 0.3)
    assert "slides without stops" in doubts[0]
