"""ART's targets in radii and in slots: what `model.batch.Articulation` holds, as numpy and as a
tensor block."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from artgen.articulation.targets import FIXED, REVOLUTE, Targets
from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from model.batch import Articulation


@dataclass(frozen=True, kw_only=True, eq=False)
class Truth:
    """The articulation of one object in P slots and T states, arrays as in `Articulation`.

    Attributes:
        radius: one radius in m.
    """

    arrays: Mapping[str, NDArray[Any]]
    radius: float


def truth(targets: Targets, *, radius: float, slots: int) -> Truth:
    """Targets in m as truth in radii; parts beyond those of the object are empty slots.

    Raises:
        ModelError: there are more parts than slots.
    """
    count = len(targets.type)
    if count > slots:
        raise ModelError(f"{count} parts do not fit into {slots} slots; raise DataConfig.slots")
    boxes = targets.bounds / radius
    unit = np.where(targets.type == REVOLUTE, 2.0 * np.pi, 2.0 * radius)
    limits = np.where(targets.type[:, None] == FIXED, 0.0, targets.limits / unit[:, None])
    arrays = {
        "valid_P": np.ones(count, bool),
        "center_P3": boxes.mean(axis=1),
        "size_P3": boxes[:, 1] - boxes[:, 0],
        "type_P": targets.type.astype(np.int64),
        "axis_P3": targets.axis,
        "origin_P3": targets.origin / radius,
        "limits_P2": limits,
        "parent_P": targets.parent.astype(np.int64),
    }
    padded = {name: _padded(array, slots) for name, array in arrays.items()}
    padded["parent_P"][count:] = -1
    padded["motion_TP"] = _padded(targets.motion.T, slots).T
    return Truth(arrays=padded, radius=radius)


def counted_from(found: Truth, state: int, poses: Floats, bounds: Floats) -> Truth:
    """The truth with one of its states for rest, as those have it who do not know what closed is.

    Args:
        poses: (P, 4, 4) where parts at rest are in that state, radii.
        bounds: (N, 2, 3) of the N parts in that state, radii.
    """
    arrays = {name: array.copy() for name, array in found.arrays.items()}
    count = len(bounds)
    center, axis = bounds.mean(axis=1), arrays["axis_P3"]
    above = poses[np.maximum(arrays["parent_P"], 0)]
    axis[:] = np.einsum("pij,pj->pi", above[:, :3, :3], axis)
    origin = np.einsum("pij,pj->pi", above[:, :3, :3], arrays["origin_P3"]) + above[:, :3, 3]
    turns = arrays["type_P"] == REVOLUTE
    along = np.einsum("pi,pi->p", center - origin[:count], axis[:count])
    origin[:count] += along[:, None] * axis[:count]
    start = arrays["motion_TP"][state].copy()
    endless = turns & (np.ptp(arrays["limits_P2"], axis=1) >= 1.0)
    arrays["center_P3"][:count], arrays["size_P3"][:count] = center, bounds[:, 1] - bounds[:, 0]
    arrays["origin_P3"] = np.where(turns[:, None], origin, 0.0)
    arrays["motion_TP"] -= start
    arrays["limits_P2"] -= np.where(endless, 0.0, start)[:, None]
    return replace(found, arrays=arrays)


def _padded(array: NDArray[Any], slots: int) -> NDArray[Any]:
    padding = [(0, slots - len(array))] + [(0, 0)] * (array.ndim - 1)
    return np.pad(array, padding)


def articulation(truths: Sequence[Truth], device: torch.device) -> Articulation:
    """B truths as one block of float32, int64 and bool."""

    def stacked(name: str) -> torch.Tensor:
        array = np.stack([truth.arrays[name] for truth in truths])
        single = array.astype(np.float32) if array.dtype == np.float64 else array
        return torch.from_numpy(np.ascontiguousarray(single)).to(device)

    return Articulation(
        valid_BP=stacked("valid_P"),
        center_BP3=stacked("center_P3"),
        size_BP3=stacked("size_P3"),
        type_BP=stacked("type_P"),
        axis_BP3=stacked("axis_P3"),
        origin_BP3=stacked("origin_P3"),
        motion_BTP=stacked("motion_TP"),
        limits_BP2=stacked("limits_P2"),
        parent_BP=stacked("parent_P"),
    )
