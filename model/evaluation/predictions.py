"""Tensors of the model to layouts: what was predicted, and what is true, of one object of a batch.

B objects, T states, P part slots.
"""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from torch import Tensor

from artgen.articulation.targets import FIXED, REVOLUTE
from artgen.core.errors import ModelError
from artgen.core.mesh import TriMesh
from model.batch import Articulation
from model.evaluation.layout import Layout, unit_axes
from model.reconstruct.joints import ENDLESS


def layout_of(
    articulation: Articulation,
    index: int,
    *,
    radius: float = 1.0,
    name: str = "",
    category: str = "",
    meshes: Mapping[int, TriMesh] | None = None,
) -> Layout:
    """The layout of object `index`, in m where `radius` is one radius in m.

    A revolute joint has no ends where `artgen reconstruct` would state none.

    Args:
        meshes: slot to the part's surface at rest in the layout's unit.

    Raises:
        ModelError: slot 0 holds no part.
    """
    slots = np.flatnonzero(_array(articulation.valid_BP[index]))
    if not len(slots) or slots[0] != 0:
        raise ModelError(f"{name or index}: slot 0 holds no part; the base belongs there")
    types = _array(articulation.type_BP[index])[slots].astype(np.int8)
    types[0] = FIXED
    center = _array(articulation.center_BP3[index])[slots] * radius
    half = np.abs(_array(articulation.size_BP3[index])[slots]) * radius / 2.0
    turning = types == REVOLUTE
    unit = np.where(turning, 2.0 * math.pi, 2.0 * radius) * (types != FIXED)
    limits = _array(articulation.limits_BP2[index])[slots]
    origins = _array(articulation.origin_BP3[index])[slots] * radius
    places = {int(slot): k for k, slot in enumerate(slots)}
    parents = [places.get(int(p), 0) for p in _array(articulation.parent_BP[index])[slots]]
    own = meshes or {}
    return Layout(
        name=name,
        category=category,
        labels=("base", *(f"part_{slot}" for slot in slots[1:])),
        boxes=np.stack([center - half, center + half], axis=1),
        types=types,
        endless=turning & (np.ptp(limits, axis=1) >= ENDLESS),
        axes=unit_axes(_array(articulation.axis_BP3[index])[slots], types),
        origins=np.where(turning[:, None], origins, 0.0),
        limits=limits * unit[:, None],
        parents=_tree(parents),
        states=_array(articulation.motion_BTP[index])[:, slots] * unit,
        meshes=tuple(own.get(int(slot)) for slot in slots) if own else (),
    )


def with_observed_limits(layout: Layout) -> Layout:
    """The layout with ranges from rest to the farthest states seen either way, for those who state
    no limits."""
    if layout.states is None:
        return layout
    ends = np.stack([layout.states.min(axis=0), layout.states.max(axis=0)], axis=1)
    lower, upper = ends[:, 0].clip(max=0.0), ends[:, 1].clip(min=0.0)
    return replace(layout, limits=np.stack([lower, upper], axis=1))


def _tree(parents: list[int]) -> NDArray[np.int64]:
    """Parents as a tree: what is its own ancestor hangs on the base instead."""
    found = [-1, *parents[1:]]
    for part in range(1, len(found)):
        seen, above = {part}, found[part]
        while above > 0 and above not in seen:
            seen.add(above)
            above = found[above]
        if above > 0:
            found[part] = 0
    return np.array(found, np.int64)


def _array(tensor: Tensor) -> NDArray[np.float64]:
    return np.asarray(tensor.detach().cpu().double().numpy())
