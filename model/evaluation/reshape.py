"""Layouts placed anew: scaled, stretched, turned, or with some of their parts alone."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from artgen.articulation.targets import PRISMATIC, REVOLUTE
from artgen.core.errors import ModelError
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply
from model.evaluation.boxes import moved_bounds
from model.evaluation.layout import Layout

BY_PART = ("boxes", "types", "endless", "axes", "origins", "limits")


def placed(layout: Layout, *, scale: float = 1.0, shift: ArrayLike = (0.0, 0.0, 0.0)) -> Layout:
    """The layout at `scale * x + shift`, its travels scaled with it."""
    grown = _stretched(layout, np.full(3, scale), np.asarray(shift, float))
    sliding, states = layout.types == PRISMATIC, layout.states
    return replace(
        grown,
        limits=np.where(sliding[:, None], layout.limits * scale, layout.limits),
        states=None if states is None else np.where(sliding, states * scale, states),
    )


def stretched(layout: Layout, factors: ArrayLike) -> Layout:
    """Boxes, origins and surfaces times a factor along each axis; directions and ranges kept.

    This is what SINGAPO's `rescale_object` does before it compares.
    """
    return _stretched(layout, np.asarray(factors, float), np.zeros(3))


def _stretched(layout: Layout, factors: Floats, shift: Floats) -> Layout:
    turning = (layout.types == REVOLUTE)[:, None]
    return replace(
        layout,
        boxes=layout.boxes * factors + shift,
        origins=np.where(turning, layout.origins * factors + shift, 0.0),
        meshes=tuple(_with_vertices(m, lambda v: v * factors + shift) for m in layout.meshes),
    )


def turned(layout: Layout, rotation: Floats) -> Layout:
    """The layout with its axes mapped by one of the 24 rotations that keep boxes upright."""
    corners = layout.boxes @ rotation.T
    return replace(
        layout,
        boxes=np.stack([corners.min(axis=1), corners.max(axis=1)], axis=1),
        axes=layout.axes @ rotation.T,
        origins=layout.origins @ rotation.T,
        meshes=tuple(_with_vertices(m, lambda v: v @ rotation.T) for m in layout.meshes),
    )


def rebased(layout: Layout, state: int) -> Layout:
    """The same object with one of its observed states for rest, as those have it who are not told
    what closed is. Boxes are those of the moved surfaces, or around the moved boxes.

    Raises:
        ModelError: the layout states no such state.
    """
    if layout.states is None or not -len(layout.states) <= state < len(layout.states):
        raise ModelError(f"layout {layout.name} has no state {state} to take for rest")
    q = layout.states[state]
    poses = layout.poses(q)
    above = np.stack([poses[p] if p >= 0 else np.eye(4) for p in layout.parents.tolist()])
    turned_axes = np.einsum("pij,pj->pi", above[:, :3, :3], layout.axes)
    origins = np.einsum("pij,pj->pi", above[:, :3, :3], layout.origins) + above[:, :3, 3]
    meshes = tuple(
        None if mesh is None else replace(mesh, vertices=apply(pose, mesh.vertices))
        for mesh, pose in zip(layout.meshes, poses, strict=False)
    )
    boxes = [moved_bounds(box, pose) for box, pose in zip(layout.boxes, poses, strict=True)]
    for part, mesh in enumerate(meshes):
        boxes[part] = boxes[part] if mesh is None else mesh.bounds
    return replace(
        layout,
        boxes=np.stack(boxes),
        axes=turned_axes,
        origins=np.where((layout.types == REVOLUTE)[:, None], origins, 0.0),
        limits=np.where(layout.endless[:, None], layout.limits, layout.limits - q[:, None]),
        states=layout.states - q,
        meshes=meshes,
    )


def without(layout: Layout, drop: Callable[[str], bool]) -> Layout:
    """The layout without the parts whose label `drop` names; the base stays.

    What hung on a dropped part hangs on the part above it.
    """
    kept = [k for k, label in enumerate(layout.labels) if k == 0 or not drop(label)]
    return layout if len(kept) == len(layout) else taken(layout, kept)


def taken(layout: Layout, order: Sequence[int]) -> Layout:
    """The parts of `order` alone, base first; joints of those left out are left out."""
    places = {old: new for new, old in enumerate(order)}
    rows = list(order)
    return replace(
        layout,
        labels=tuple(layout.labels[k] for k in rows),
        parents=np.array(
            [_kept_parent(layout.parents.tolist(), k, places) for k in rows], np.int64
        ),
        meshes=tuple(layout.meshes[k] for k in rows) if layout.meshes else (),
        states=None if layout.states is None else layout.states[:, rows],
        **{key: getattr(layout, key)[rows] for key in BY_PART},
    )


def _kept_parent(parents: Sequence[int], part: int, places: dict[int, int]) -> int:
    above = parents[part]
    while above >= 0 and above not in places:
        above = parents[above]
    return places.get(above, -1)


def _with_vertices(mesh: TriMesh | None, change: Callable[[Floats], Floats]) -> TriMesh | None:
    return None if mesh is None else replace(mesh, vertices=change(mesh.vertices))
