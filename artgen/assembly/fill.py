"""One slot filled: a donor's body fitted, a handle mounted, the template's works behind."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.types import Grip, Joint
from artgen.assembly.fit import box_map, fitted, flat_triangles, frame_borders
from artgen.assembly.handles import mounted, place_of, places_on
from artgen.assembly.looks import is_panel
from artgen.assembly.piece import Piece
from artgen.assembly.source import Member
from artgen.assembly.texels import STRETCH, stretch
from artgen.assembly.uv_fix import areas, gradients, quarter_turned, unit_normals
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.export.kinematics import vector

NO_ARM = 0.005
"""m; a grip nearer to its joint's axis is turned and pulled nowhere."""
GROWTH = 0.5
"""A handle grows with this power of its front's scale: hands do not grow with drawers."""
BOARD = 0.6
"""Least share of a front's face that one body covers for its grain to be that of the front."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Fill:
    """What fills a slot.

    Attributes:
        body: fitted; slots are those of the donor.
        scale: (3,) of its box.
        mirrored: left and right were exchanged.
    """

    body: Piece
    scale: Floats
    mirrored: bool


class Misfit(Exception):
    """A donor or a handle does not suit a slot after all, and why."""


def filled(
    slot: Member,
    donor: Member,
    surfaces: Sequence[SurfaceSpec],
    *,
    grain: int | None,
) -> Fill:
    """A donor's body on the box of a slot's.

    Args:
        surfaces: the donor's.
        grain: axis along which the grain of a front is to run, see `with_grain`.

    Raises:
        Misfit: triangles collapse, or texture would be stretched.
    """
    mirrored = donor.side != slot.side
    how = box_map(donor.body, slot.body.bounds, mirrored=mirrored)
    body = fitted(donor.body, how)
    if flat_triangles(body.mesh.vertices, body.mesh.faces):
        raise Misfit("triangles collapse")
    weights = areas(donor.body.mesh.triangles)
    if stretch(body.mesh, weights) > STRETCH * stretch(donor.body.mesh, weights):
        raise Misfit("its texture would be stretched")
    if slot.kind == "front":
        body = with_grain(body, donor.body, grain, panels(surfaces))
    return Fill(body=body, scale=how.scale, mirrored=mirrored)


def grains(members: Sequence[Member], surfaces: Sequence[SurfaceSpec]) -> dict[str, int | None]:
    """Name of each member to the axis along which the grain of its front runs, 0 (x) or 2 (z): that
    of its own board; where it has none, as frames have, that of the most fronts, of equals x."""
    boards = panels(surfaces)
    own = {
        member.name: found[1]
        for member in members
        if member.kind == "front" and (found := main_board(member.body, boards)) is not None
    }
    runs = list(own.values())
    common = max((0, 2), key=runs.count) if runs else None
    return {member.name: own.get(member.name, common) for member in members}


def panels(surfaces: Sequence[SurfaceSpec]) -> list[int]:
    """Places of the surfaces that fronts' panels are made of."""
    return [k for k, surface in enumerate(surfaces) if is_panel(surface)]


def with_grain(body: Piece, donor: Piece, grain: int | None, boards: Sequence[int]) -> Piece:
    """A fitted body whose main board, if it has one, has its grain along an axis, 0 (x) or 2 (z):
    turned by 90 degrees on front and back where it ran the other way. None for an axis keeps it
    along the longer side if it ran so on the donor.

    Args:
        body: fitted; its faces are those of `donor`.
        boards: the donor's surfaces that have a grain, or get one with the object's new looks.
    """
    found = main_board(donor, boards)
    if found is None:
        return body
    own, axis = found
    if grain is None:
        before, after = (np.diff(p.bounds, axis=0)[0] for p in (donor, body))
        changed = (before[0] >= before[2]) != (after[0] >= after[2])
        along = (axis == 0) == (before[0] >= before[2])
        grain = 2 - axis if changed and along else axis
    if axis == grain:
        return body
    flat = own & (np.abs(unit_normals(donor.mesh.triangles)[:, 1]) > 0.99)
    turned = dataclasses.replace(body.mesh, uv=quarter_turned(body.mesh, flat))
    return dataclasses.replace(body, mesh=turned)


def main_board(front: Piece, boards: Sequence[int]) -> tuple[NDArray[np.bool_], int] | None:
    """(F,) which triangles are of the one body that makes up most of a front's face, and the axis
    along which its grain runs, 0 (x) or 2 (z); None where no body does.

    Args:
        boards: slots of surfaces that have a grain.
    """
    mesh, size = front.mesh, np.diff(front.bounds, axis=0)[0]
    normals, weight = unit_normals(mesh.triangles), areas(mesh.triangles)
    face = (normals[:, 1] < -0.99) & np.isin(np.asarray(mesh.slot), boards)
    covered = np.bincount(np.asarray(mesh.body)[face], weights=weight[face])
    if not len(covered) or covered.max() < BOARD * size[0] * size[2]:
        return None
    own = np.asarray(mesh.body) == int(np.argmax(covered))
    u = gradients(mesh.triangles[own & face], np.asarray(mesh.uv)[own & face])[:, 0]
    along = np.abs((u * weight[own & face, None]).sum(axis=0))
    return own, 0 if along[0] >= along[2] else 2


def handle_on(slot: Member, front: Piece, donor: Member, handle: Member) -> Piece:
    """A handle on a fitted front: `donor` gave the front, `handle` is the part that it comes from.

    Raises:
        Misfit: it does not fit, or would hang in the air.
    """
    if handle.handle is None:
        raise Misfit(f"{handle.name} has no handle")
    own, here = (np.diff(p.bounds, axis=0)[0] for p in (handle.body, front))
    scale = float((here[0] * here[2] / (own[0] * own[2])) ** (GROWTH / 2.0))
    place = place_of(slot, donor, front.bounds)
    borders = frame_borders(front)
    for where in places_on(place, slot.side, front.bounds, borders):
        found = mounted(handle.handle, where, front.mesh, scale=scale)
        if found is not None:
            return found
    raise Misfit("the handle does not fit on the front")


def gripped(piece: Piece, name: str, joint: Joint) -> tuple[Grip, ...]:
    """The grips of a new part: named after it, pulled as its joint moves; one in the middle of a
    handle whose source states none."""
    return tuple(
        dataclasses.replace(
            grip,
            name=f"{name}_grip" + (f"_{count}" if count > 1 else ""),
            pull=pull_at(grip, joint),
        )
        for count, grip in enumerate(piece.grips, start=1)
    )


def pull_at(grip: Grip, joint: Joint) -> tuple[float, float, float]:
    """Unit vector along which a grip starts to move as its joint opens; as stated where it has no
    arm."""
    way = np.array(joint.axis)
    if joint.type != "prismatic":
        way = np.cross(joint.axis, np.subtract(grip.position, joint.origin))
    length = float(np.linalg.norm(way))
    return grip.pull if length < NO_ARM else vector(np.round(way / length, 15) + 0.0)


def middle_grip(handle: Piece, name: str) -> Piece:
    """A handle of a source that states no grips, with one at the front of its middle."""
    if handle.grips:
        return handle
    box = handle.bounds
    depth = float(box[0, 1] + 0.25 * (box[1, 1] - box[0, 1]))
    at = (float(box[:, 0].mean()), depth, float(box[:, 2].mean()))
    grip = Grip(
        name=name, kind="handle", position=at, outward=(0.0, -1.0, 0.0), pull=(0.0, -1.0, 0.0)
    )
    return dataclasses.replace(handle, grips=(grip,))
