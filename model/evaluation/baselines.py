"""Baselines that need no network: the mean layout, and the training object that looks most alike.

Layouts are in radii of their objects, as the model's are, with parts in canonical order.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.targets import FIXED, REVOLUTE
from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from model.evaluation.layout import Layout, unit_axes
from model.evaluation.reshape import taken

THUMBNAIL = 12
"""Side of the images that pixels are compared at."""


@dataclass(frozen=True, eq=False)
class MeanLayout:
    """The mean over training objects of the same category and number of parts, part by part.

    Attributes:
        groups: (category, parts) to the mean of that group; the category is empty for all together.
    """

    groups: dict[tuple[str, int], Layout]

    def of(self, category: str, parts: int) -> Layout:
        """For an unseen pair: all categories with so many parts; else the nearest number of parts,
        of which the first `parts` are taken."""
        for key in ((category, parts), ("", parts)):
            if key in self.groups:
                return self.groups[key]
        counts = sorted({count for name, count in self.groups if not name})
        nearest = min(counts, key=lambda count: (abs(count - parts), count))
        mean = self.groups["", nearest]
        return taken(mean, range(min(parts, nearest)))


def mean_layouts(layouts: Sequence[Layout]) -> MeanLayout:
    """Means of every group.

    Raises:
        ModelError: there are no layouts.
    """
    if not layouts:
        raise ModelError("the mean layout needs training objects; name some by --train")
    groups: dict[tuple[str, int], list[Layout]] = {}
    for layout in layouts:
        for category in {layout.category, ""}:
            groups.setdefault((category, len(layout)), []).append(layout)
    return MeanLayout({key: _mean(own) for key, own in sorted(groups.items())})


def _mean(layouts: Sequence[Layout]) -> Layout:
    """Means of numbers; of types and parents the most frequent; axes and the like over the objects
    that have that type."""
    first = layouts[0]
    kinds = np.stack([layout.types for layout in layouts])
    types = _most_frequent(kinds.astype(np.int64)).astype(np.int8)
    same = (kinds == types)[..., None]  # Every column has one at least.
    weight = same.sum(axis=0)

    def over_same(values: Sequence[Floats]) -> Floats:
        return np.asarray((np.nan_to_num(np.stack(values)) * same).sum(axis=0) / weight)

    axes = over_same([layout.axes for layout in layouts])
    origins = over_same([layout.origins for layout in layouts])
    return replace(
        first,
        name="mean",
        boxes=np.mean([layout.boxes for layout in layouts], axis=0),
        types=types,
        axes=unit_axes(axes, types),
        origins=np.where((types == REVOLUTE)[:, None], origins, 0.0),
        limits=over_same([layout.limits for layout in layouts]) * (types != FIXED)[:, None],
        endless=np.mean([layout.endless for layout in layouts], axis=0) > 0.5,
        parents=_tree(_most_frequent(np.stack([layout.parents for layout in layouts]))),
        states=_mean_states(layouts, kinds == types),
        meshes=(),
    )


def _mean_states(layouts: Sequence[Layout], same: NDArray[np.bool_]) -> Floats | None:
    """(T, P) over the objects of the most frequent type; None where states differ in number."""
    known = [layout.states for layout in layouts if layout.states is not None]
    if len(known) != len(layouts) or len({len(own) for own in known}) != 1:
        return None
    return np.asarray((np.stack(known) * same[:, None]).sum(axis=0) / same.sum(axis=0))


def _most_frequent(rows: NDArray[np.int64]) -> NDArray[np.int64]:
    """(P,) the most frequent value of each column of (N, P); the least of equals."""
    return np.array([np.bincount(column + 1).argmax() - 1 for column in rows.T], np.int64)


def _tree(parents: NDArray[np.int64]) -> NDArray[np.int64]:
    """Parents that are later parts hang on the base: votes of columns need not make a tree."""
    own = np.arange(len(parents))
    fixed = np.where(parents < own, parents, 0)
    fixed[0] = -1
    return fixed.astype(np.int64)


@dataclass(frozen=True, eq=False)
class NearestNeighbor:
    """The training object whose images are nearest, among those with as many parts.

    Attributes:
        features: (N, D) of the training objects.
        layouts: theirs.
    """

    features: Floats
    layouts: Sequence[Layout]

    def __post_init__(self) -> None:
        if not len(self.layouts) or len(self.features) != len(self.layouts):
            raise ModelError(
                f"{len(self.features)} features for {len(self.layouts)} training objects; the "
                "nearest neighbor needs one each"
            )

    def of(self, feature: Floats, parts: int) -> Layout:
        """The nearest one; among all objects where none has so many parts."""
        own = np.array([len(layout) == parts for layout in self.layouts])
        allowed = np.flatnonzero(own if own.any() else np.ones(len(own), bool))
        gaps = np.linalg.norm(self.features[allowed] - feature, axis=1)
        return self.layouts[int(allowed[gaps.argmin()])]


def pixel_feature(images: Floats) -> Floats:
    """(D,) gray thumbnails of (..., 3, H, W) images, one after the other.

    A thumbnail's pixel is the mean of those that fall into it.
    """
    gray = images.mean(axis=-3).reshape(-1, *images.shape[-2:])
    rows = np.array_split(np.arange(gray.shape[1]), min(THUMBNAIL, gray.shape[1]))
    columns = np.array_split(np.arange(gray.shape[2]), min(THUMBNAIL, gray.shape[2]))
    cells = [[gray[:, r[:, None], c].mean(axis=(1, 2)) for c in columns] for r in rows]
    return np.moveaxis(np.array(cells), -1, 0).reshape(-1)
