"""Any URDF: fixed joints make one part, shapes are read as the validator reads them."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import ParseError

import numpy as np

from artgen.articulation.targets import TYPE_IDS
from artgen.articulation.types import Joint
from artgen.core.errors import ArtgenError, ModelError
from artgen.core.mesh import Floats, TriMesh
from artgen.validate.bounds import shipped_bounds
from artgen.validate.meshfile import as_bodies
from artgen.validate.stated import StatedJoint
from artgen.validate.subject import Source
from artgen.validate.urdf_subject import UrdfSubject
from model.evaluation.adapters.of_joints import layout_of_joints
from model.evaluation.layout import Layout
from model.evaluation.reshape import turned

FRONT_IS_X = np.array([(0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
"""Turns a front along +x, as URDFormer's cabinets have it, to our front along -y."""


def layout_of_urdf(file: Path, *, root: Path | None = None) -> Layout:
    """The layout of a URDF at q = 0; a part without any readable shape is left out.

    Args:
        root: the folder outside of which no mesh is read; the file's own if None.

    Raises:
        ModelError: the file cannot be read, or no part has a shape.
    """
    source = Source(format="urdf", file=file, root=root or file.parent)
    subject = UrdfSubject(source=source, bounds=shipped_bounds())
    try:
        if subject.robot.find("link") is None:
            raise ModelError(f"{file} has no <link>; is it a robot description?")
        for joint in subject.stated_joints:
            _check_axis(joint)
        with np.errstate(invalid="ignore"):  # An axis of zeros has no direction: nan.
            parts, joints = subject.parts, subject.joints
        meshes = {part.name: _shape(subject, part.name) for part in parts}
    except (ArtgenError, OSError, ValueError, ParseError) as error:
        raise ModelError(f"{file} states no object that can be scored: {error}") from error
    if strange := sorted({joint.type for joint in joints} - set(TYPE_IDS)):
        known = ", ".join(sorted(TYPE_IDS))
        raise ModelError(f"{file}: joint type {strange[0]!r} is none of fixed, {known}")
    seen = {name: mesh for name, mesh in meshes.items() if mesh is not None}
    if not seen:
        raise ModelError(f"{file}: no part has a shape that can be read; are its meshes beside it?")
    boxes: dict[str, Floats] = {name: mesh.bounds for name, mesh in seen.items()}
    base = parts[0].name
    if base not in boxes:  # A bare root, such as a frame that everything hangs on.
        middle = np.mean([box.mean(axis=0) for box in boxes.values()], axis=0)
        boxes[base] = np.stack([middle, middle])
    names = [part.name for part in parts if part.name in boxes]
    kept = _rehung(joints, set(names), base)
    return layout_of_joints(
        file.stem, "", [(name, name) for name in names], kept, boxes=boxes, meshes=seen
    )


def layout_of_urdformer(file: Path) -> Layout:
    """The layout of one of URDFormer's files: meshes lie beside its folder, the front is +x."""
    return turned(layout_of_urdf(file, root=file.parent.parent), FRONT_IS_X)


def _check_axis(joint: StatedJoint) -> None:
    if len(joint.axis) != 3 or not np.isfinite(joint.axis).all():
        raise ModelError(f"axis {joint.axis} of joint {joint.name} is not three finite numbers")


def _shape(subject: UrdfSubject, part: str) -> TriMesh | None:
    """What is seen of a part, or what it touches with where nothing is seen."""
    if part in subject.meshes:
        return subject.meshes[part]
    pieces = subject.collision.get(part, ())
    if not pieces:
        return None
    starts = np.cumsum([0, *(len(piece.vertices) for piece in pieces[:-1])])
    faces = [piece.faces + start for piece, start in zip(pieces, starts, strict=True)]
    return as_bodies(np.concatenate([p.vertices for p in pieces]), np.concatenate(faces))


def _rehung(joints: tuple[Joint, ...], kept: set[str], base: str) -> list[Joint]:
    """Joints of the kept parts, hung on the nearest kept part above."""
    parents: Mapping[str, str] = {joint.child: joint.parent for joint in joints}
    found = []
    for joint in joints:
        if joint.child not in kept:
            continue
        above = joint.parent
        while above not in kept and above != base:
            above = parents[above]
        found.append(replace(joint, parent=above))
    return found
