"""Sizes: how large an object of a category is taken to be, as its source has no metric scale."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.core.errors import IngestError
from artgen.core.mesh import Floats

Measure = Literal["width", "depth", "height", "longest"]
PLACE = {"width": 0, "depth": 1, "height": 2}


@dataclass(frozen=True, kw_only=True)
class Size:
    """What one measure of a closed object of the category is, m."""

    measure: Measure
    meters: float


def _size(measure: Measure, meters: float) -> Size:
    return Size(measure=measure, meters=meters)


SIZES: Mapping[str, Size] = {
    "bottle": _size("height", 0.25),
    "box": _size("longest", 0.40),
    "bucket": _size("width", 0.28),
    "camera": _size("width", 0.13),
    "cart": _size("longest", 0.90),
    "chair": _size("height", 0.95),
    "clock": _size("height", 0.30),
    "coffeemachine": _size("height", 0.35),
    "dishwasher": _size("height", 0.85),
    "dispenser": _size("height", 0.20),
    "display": _size("width", 0.55),
    "door": _size("height", 2.10),
    "eyeglasses": _size("width", 0.14),
    "fan": _size("longest", 0.50),
    "faucet": _size("longest", 0.25),
    "foldingchair": _size("height", 0.80),
    "globe": _size("height", 0.40),
    "kettle": _size("height", 0.24),
    "keyboard": _size("width", 0.44),
    "kitchenpot": _size("width", 0.30),
    "knife": _size("longest", 0.22),
    "lamp": _size("longest", 0.50),
    "laptop": _size("width", 0.34),
    "lighter": _size("longest", 0.08),
    "microwave": _size("width", 0.50),
    "mouse": _size("longest", 0.11),
    "oven": _size("width", 0.60),
    "pen": _size("longest", 0.14),
    "phone": _size("longest", 0.15),
    "pliers": _size("longest", 0.18),
    "printer": _size("width", 0.45),
    "refrigerator": _size("height", 1.75),
    "remote": _size("longest", 0.18),
    "safe": _size("width", 0.40),
    "scissors": _size("longest", 0.18),
    "stapler": _size("longest", 0.14),
    "storagefurniture": _size("longest", 1.10),
    "suitcase": _size("longest", 0.65),
    "switch": _size("longest", 0.12),
    "table": _size("longest", 1.20),
    "toaster": _size("longest", 0.32),
    "toilet": _size("height", 0.75),
    "trashcan": _size("height", 0.60),
    "usb": _size("longest", 0.06),
    "washingmachine": _size("height", 0.85),
    "window": _size("longest", 1.30),
}
"""Category, in lower case without blanks, to its usual size; PartNet-Mobility's 46 categories."""
UNKNOWN = _size("longest", 0.60)
"""Of a category that is not listed."""


@dataclass(frozen=True, kw_only=True)
class Scale:
    """Meters a unit of the source, and why."""

    meters_per_unit: float
    reason: str


def category_key(category: str) -> str:
    """A category's name without what its spellings differ in."""
    return "".join(c for c in category.lower() if c.isalnum())


def chosen_scale(
    category: str, extent: Floats, *, given: float | None, stated: float | None
) -> Scale:
    """The user's scale, else the source's, else the one that gives the category its usual size.

    Args:
        extent: (3,) of the closed object in units: width, depth, height.

    Raises:
        IngestError: a scale is not positive, or the object has no extent.
    """
    for value, reason in ((given, "given by the user"), (stated, "stated by the source")):
        if value is not None:
            if not (np.isfinite(value) and value > 0.0):
                raise IngestError(f"the scale {reason} is {value} m a unit, expected > 0")
            return Scale(meters_per_unit=float(value), reason=reason)
    size = SIZES.get(category_key(category), UNKNOWN)
    units = float(extent.max() if size.measure == "longest" else extent[PLACE[size.measure]])
    if not units > 0.0:
        raise IngestError(f"the object has no {size.measure}; its meshes are flat or missing")
    known = "" if category_key(category) in SIZES else ", its category being unknown"
    reason = f"assumed: {size.measure} {size.meters:g} m{known}"
    return Scale(meters_per_unit=size.meters / units, reason=reason)
