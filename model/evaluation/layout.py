"""Layout: what a system claims about an object; boxes, joints, states and surfaces as arrays.

Every metric reads layouts, so whatever can be made into one can be scored. Lengths are in one unit
of the layout's own (m, radii, or what another system uses); angles are in rad.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from artgen.articulation.targets import FIXED, PRISMATIC
from artgen.core.errors import ModelError
from artgen.core.mesh import Floats, TriMesh, frozen
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import rigid

HANDLE = "handle"
"""The label of parts that some protocols leave out."""
LARGEST = 1e12
"""Of any number of a layout: its cube still has digits in float64, its coordinates in float32."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Layout:
    """P parts, base first, at rest; what is unknown of a joint is nan.

    Attributes:
        name: identifier of the object, the same for truth and prediction.
        category: empty where it is not known.
        labels: what each part is or is called.
        boxes: (P, 2, 3) box of each part at rest along the axes, lower then upper.
        types: (P,) FIXED, REVOLUTE or PRISMATIC.
        endless: (P,) whether a revolute joint turns without limits; all false when left out.
        axes: (P, 3) unit directions; zero for fixed parts, nan where none was given.
        origins: (P, 3) a point of the axis; zero unless revolute, nan where none was given.
        limits: (P, 2) lower and upper end, rad or lengths; zeros for fixed parts.
        parents: (P,) index of the parent, -1 for the base.
        states: (T, P) q of each part's own joint in T observed states; None where not known.
        meshes: surface of each part at rest, None where there is none.
    """

    name: str
    category: str = ""
    labels: tuple[str, ...]
    boxes: Floats
    types: NDArray[np.int8]
    axes: Floats
    origins: Floats
    limits: Floats
    parents: NDArray[np.int64]
    endless: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, bool))
    states: Floats | None = None
    meshes: tuple[TriMesh | None, ...] = ()

    def __post_init__(self) -> None:
        put, count = object.__setattr__, len(self.labels)
        shapes = {"boxes": (count, 2, 3), "axes": (count, 3), "origins": (count, 3)}
        for key, shape in {**shapes, "limits": (count, 2)}.items():
            put(self, key, self._checked(key, np.asarray(getattr(self, key), float), shape))
        for key, kind in (("types", np.int8), ("parents", np.int64)):
            put(self, key, self._checked(key, np.asarray(getattr(self, key), kind), (count,)))
        endless = np.asarray(self.endless, bool) if len(self.endless) else np.zeros(count, bool)
        put(self, "endless", self._checked("endless", endless, (count,)))
        if self.states is not None:
            states = np.asarray(self.states, float)
            put(self, "states", self._checked("states", states, (max(len(states), 1), count)))
        if self.meshes and len(self.meshes) != count:
            raise ModelError(f"{self.name}: {len(self.meshes)} meshes for {count} parts")
        self._check_values()

    def _checked(self, key: str, values: ArrayLike, shape: tuple[int, ...]) -> NDArray[np.generic]:
        array = np.asarray(values)
        if array.shape != shape:
            raise ModelError(
                f"layout {self.name}: {key} has shape {array.shape}, expected {shape}; one row for "
                "each of its parts"
            )
        return frozen(array, array.dtype.type)

    def _check_values(self) -> None:
        if not self.labels:
            raise ModelError(f"layout {self.name} has no part; at least a base is needed")
        if not np.isfinite(self.boxes).all() or (self.boxes[:, 1] < self.boxes[:, 0]).any():
            raise ModelError(
                f"layout {self.name}: a box is not finite or has its lower corner above its upper "
                "one; check what the system wrote"
            )
        for key in ("boxes", "origins", "limits", "states"):
            values = getattr(self, key)
            if values is not None and (np.abs(values) > LARGEST).any():
                raise ModelError(
                    f"layout {self.name}: {key} reach {np.nanmax(np.abs(values)):g}, expected at "
                    f"most {LARGEST:g}; check what the system wrote"
                )
        parents = self.parents.tolist()
        if parents[0] != -1 or any(not 0 <= p < len(parents) for p in parents[1:]):
            raise ModelError(
                f"layout {self.name}: parents {parents}; expected -1 for the base, which is first, "
                "and the index of a part for all others"
            )
        if _depths(parents) is None:
            raise ModelError(f"layout {self.name}: parents {parents} go round in a circle")

    def __len__(self) -> int:
        return len(self.labels)

    @property
    def centers(self) -> Floats:
        """(P, 3) middles of the boxes."""
        return np.asarray(self.boxes.mean(axis=1))

    @property
    def bounds(self) -> Floats:
        """(2, 3) box of all parts at rest."""
        return np.stack([self.boxes[:, 0].min(axis=0), self.boxes[:, 1].max(axis=0)])

    @property
    def radius(self) -> float:
        """Half the diagonal of the box of all parts at rest."""
        return float(np.linalg.norm(self.bounds[1] - self.bounds[0]) / 2.0)

    @property
    def movable(self) -> NDArray[np.bool_]:
        """(P,) whether a part has a joint."""
        return np.asarray(self.types != FIXED)

    @property
    def children(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the direct children of each part."""
        parents = self.parents.tolist()
        return tuple(
            tuple(k for k, parent in enumerate(parents) if parent == own)
            for own in range(len(parents))
        )

    @property
    def far_ends(self) -> Floats:
        """(P,) the end of each joint's range that is farther from rest; a full turn if endless."""
        lower, upper = np.nan_to_num(self.limits).T
        far = np.where(np.abs(lower) > np.abs(upper), lower, upper)
        return np.where(self.endless, 2.0 * math.pi, far)

    def joint_motion(self, part: int, q: float) -> Floats:
        """(4, 4) motion of a part relative to its parent at `q`; none where its axis is unknown."""
        axis = self.axes[part]
        if self.types[part] == FIXED or not np.isfinite([*axis, q]).all():
            return np.eye(4)
        if self.types[part] == PRISMATIC:
            return rigid(np.eye(3), q * axis)
        turn, origin = axis_angle_matrix(tuple(axis), q), np.nan_to_num(self.origins[part])
        return rigid(turn, origin - turn @ origin)

    def poses(self, q: ArrayLike) -> Floats:
        """(P, 4, 4) `object_from_rest` of each part at joint values (P,)."""
        values, parents = np.asarray(q, float), self.parents.tolist()
        found = np.tile(np.eye(4), (len(self), 1, 1))
        for part in np.argsort(_depths(parents) or []).tolist():
            own = self.joint_motion(part, float(values[part]))
            found[part] = own if parents[part] < 0 else found[parents[part]] @ own
        return found

    def opened(self, share: float) -> Floats:
        """(P,) q of every joint at a share of the way from rest to its far end."""
        return np.asarray(share * self.far_ends)


def _depths(parents: Sequence[int]) -> list[int] | None:
    """How many joints each part is from the base; None where parents make a circle."""
    depths = []
    for part in range(len(parents)):
        depth, above = 0, parents[part]
        while above >= 0 and depth <= len(parents):
            depth, above = depth + 1, parents[above]
        depths.append(depth)
    return None if max(depths) > len(parents) else depths


def unit_axes(directions: ArrayLike, types: ArrayLike) -> Floats:
    """(P, 3) unit vectors; zero for fixed parts, nan where a direction has no length."""
    vectors = np.array(directions, float).reshape(-1, 3)
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit = np.where(length > 1e-9, vectors / np.where(length > 1e-9, length, 1.0), np.nan)
    return np.where(np.asarray(types)[:, None] == FIXED, 0.0, unit)
