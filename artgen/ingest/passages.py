"""Passages: which joints may move only while others are open, as no foreign format says so."""

import dataclasses
import tempfile
from collections.abc import Sequence
from pathlib import Path

from artgen.articulation.types import ArticulatedObject, Precondition
from artgen.export.files import write_meshes
from artgen.export.layout import URDF
from artgen.export.urdf import urdf_text
from artgen.validate.bounds import shipped_bounds
from artgen.validate.subject import Source
from artgen.validate.urdf_subject import UrdfSubject


def with_passages(obj: ArticulatedObject) -> ArticulatedObject:
    """The object with a precondition for each joint whose part meets another that can be moved out
    of its way: a bin in a door, a drawer behind one. Found by MuJoCo with the collision pieces.

    Raises:
        ValueError: MuJoCo refuses the object, which the validation of its bundle tells.
    """
    if len(obj.joints) < 2:
        return obj
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        write_meshes(obj, root)
        (root / URDF).write_text(urdf_text(obj), encoding="utf-8")
        source = Source(format="urdf", file=root / URDF, root=root)
        found = UrdfSubject(source=source, bounds=shipped_bounds()).passages
    return dataclasses.replace(obj, preconditions=acyclic(found))


def acyclic(rules: Sequence[Precondition]) -> tuple[Precondition, ...]:
    """The rules but for those that ask of a joint, by way of others, what asks for itself: parts
    that touch at rest would each wait for the other."""
    kept: list[Precondition] = []
    for rule in rules:
        asked, waiting = set[str](), [rule.requires]
        while waiting:
            name = waiting.pop()
            if name not in asked:
                asked.add(name)
                waiting += [own.requires for own in kept if own.joint == name]
        if rule.joint not in asked:
            kept.append(rule)
    mutual = {(rule.requires, rule.joint) for rule in rules}
    return tuple(rule for rule in kept if (rule.joint, rule.requires) not in mutual)
