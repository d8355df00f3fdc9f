"""Sample: one asset in T states seen by V cameras, with ART's targets; arrays, no torch.

The world frame is the object frame (m, z up, front -y), so cameras and targets need no third frame.
`docs/shard_format.md` tells how a Sample lies in a shard.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.targets import FIXED, PRISMATIC, Targets
from artgen.articulation.types import Joint, Precondition
from artgen.core.errors import ShardError
from artgen.core.jsonio import plain
from artgen.core.mesh import Floats, frozen

Bytes = NDArray[np.uint8]
Singles = NDArray[np.float32]
Halves = NDArray[np.float16]

BACKGROUND = 255
"""Part id of a pixel whose center no part covers."""
LEFT_OUT = 254
"""Part id of a pixel that shows a part of `SampleMeta.parts_left_out`."""
MAX_PARTS = 127
"""Part ids have 8 bits, but the parents of `Targets` have a sign."""

_IMAGES: Mapping[str, tuple[str, str]] = {
    "rgba": ("TVHW4", "uint8"),
    "part_id": ("TVHW", "uint8"),
    "depth": ("TVHW", "float32"),
    "normal": ("TVHW3", "float32"),
    "part_rgba": ("TVPHW4", "uint8"),
    "part_depth": ("TVPHW", "float32"),
    "part_normal": ("TVPHW3", "float32"),
}
OPTIONAL_IMAGES: Mapping[str, tuple[str, str]] = {
    "albedo": ("TVHW3", "uint8"),
    "roughness": ("TVHW", "uint8"),
    "flow": ("TVHW2", "float32"),
    "linear": ("TVHW4", "float16"),
}
"""Axes and type of the images that a sample holds only where they were asked for."""
_TARGETS: Mapping[str, tuple[str, type[np.generic]]] = {
    "bounds": ("P23", np.float64),
    "type": ("P", np.int8),
    "axis": ("P3", np.float64),
    "origin": ("P3", np.float64),
    "motion": ("TP", np.float64),
    "parent": ("P", np.int8),
    "limits": ("P2", np.float64),
    "movable": ("P", np.bool_),
}


@dataclass(frozen=True, kw_only=True)
class PartLabel:
    """A part's name, and what it is in the category's words."""

    name: str
    label: str


@dataclass(frozen=True, kw_only=True)
class SampleMeta:
    """What is known of a sample beside its arrays.

    Attributes:
        asset_id: lower-case letters, digits and `_`; names the sample's members.
        parts: the parts that the arrays hold, in canonical order, base first.
        joints: all joints of the asset, in the order of the columns of `Sample.q`.
        versions: program to version, e.g. `{"artgen": "0.1.0", "bpy": "4.5.15"}`; None where a
            program was not there.
        shading: what the colors are, e.g. `cycles`.
        light: the light rig's identifier.
        effects: post-render effects by name; empty when none was asked for.
        rendering: settings, backend, accuracy with its promise, transport; as JSON has it.
        donors: ids of the assets whose parts a recombined asset borrows, down to those that borrow
            nothing themselves, or the family of the foreign object that it was made from; empty for
            an asset of its own. They decide the split.
        slots: the P that `to_slots` cut or padded to; None while P is the number of parts.
        parts_left_out: names of parts of the asset that the arrays do not hold.
    """

    asset_id: str
    category: str
    seed: int
    index: int
    parts: tuple[PartLabel, ...]
    joints: tuple[Joint, ...]
    preconditions: tuple[Precondition, ...] = ()
    versions: Mapping[str, str | None] = field(default_factory=dict)
    shading: str
    light: str
    effects: Mapping[str, object] = field(default_factory=dict)
    rendering: Mapping[str, object] = field(default_factory=dict)
    donors: tuple[str, ...] = ()
    slots: int | None = None
    parts_left_out: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "effects", plain(self.effects))
        object.__setattr__(self, "rendering", plain(self.rendering))
        if not re.fullmatch(r"[a-z0-9_]{1,64}", self.asset_id):
            raise ShardError(
                f"asset id {self.asset_id!r} cannot name shard members; use 1 to 64 lower-case "
                "letters, digits and underscores"
            )
        if not 1 <= len(self.parts) <= MAX_PARTS:
            raise ShardError(
                f"{self.asset_id}: {len(self.parts)} parts, expected 1 to {MAX_PARTS}; merge "
                "parts that never move apart"
            )


@dataclass(frozen=True, kw_only=True, eq=False)
class Cameras:
    """V pinhole cameras, posed anew in each of T states.

    Attributes:
        intrinsics: (V, 3, 3) px; the center of the first pixel is at (0.5, 0.5).
        camera_from_world: (T, V, 4, 4) rigid; OpenCV axes, x right, y down, z forward, m.
        size: (width, height) px.
    """

    intrinsics: Floats
    camera_from_world: Floats
    size: tuple[int, int]

    def __post_init__(self) -> None:
        object.__setattr__(self, "intrinsics", frozen(self.intrinsics, np.float64))
        object.__setattr__(self, "camera_from_world", frozen(self.camera_from_world, np.float64))
        object.__setattr__(self, "size", (int(self.size[0]), int(self.size[1])))
        if self.camera_from_world.ndim != 4:
            raise ShardError(
                f"camera_from_world has shape {self.camera_from_world.shape}, expected "
                "(states, views, 4, 4); repeat still cameras over the states"
            )
        views = self.camera_from_world.shape[1]
        _expect_shape("intrinsics", self.intrinsics, (views, 3, 3))
        _expect_shape(
            "camera_from_world", self.camera_from_world, (*self.camera_from_world.shape[:2], 4, 4)
        )
        self._check_values()

    def _check_values(self) -> None:
        rotation = self.camera_from_world[..., :3, :3]
        gram = rotation @ np.swapaxes(rotation, -1, -2)
        # 1e-6: far above float32 storage in a renderer (6e-8), far below any scale factor.
        rigid = np.allclose(gram, np.eye(3), rtol=0, atol=1e-6)
        if not (rigid and (np.linalg.det(rotation) > 0).all()):
            raise ShardError(
                "camera_from_world is not a rotation with a translation; check its axes"
            )
        if not np.array_equal(
            self.camera_from_world[..., 3, :],
            np.broadcast_to([0.0, 0.0, 0.0, 1.0], (*self.camera_from_world.shape[:2], 4)),
        ):
            raise ShardError("the last row of camera_from_world is not 0 0 0 1; is it transposed?")
        focal = self.intrinsics[:, (0, 1), (0, 1)]
        if not (np.isfinite(self.intrinsics).all() and (focal > 0).all()):
            raise ShardError("intrinsics need finite entries and positive focal lengths in px")


@dataclass(frozen=True, kw_only=True, eq=False)
class Sample:
    """One training item; T states, V views, P parts, H x W pixels, J joints.

    Images are labeled at pixel centers: `part_id`, depths and normals are what the ray through the
    center hits, without antialiasing; only colors are filtered. `part_*` show each part alone, with
    nothing in front of it (amodal).

    Attributes:
        rgba: (T, V, H, W, 4) uint8, sRGB with straight alpha; RGB is 0 where alpha is 0.
        part_id: (T, V, H, W) uint8 index into `meta.parts`, or LEFT_OUT, or BACKGROUND.
        depth: (T, V, H, W) float32, m along the camera's z axis; 0 is background, so that a masked
            loss never multiplies infinity by zero.
        normal: (T, V, H, W, 3) float32, outward unit vectors in the world frame at the state shown,
            smooth as shading is, without bumps; zero is background. World normals do not depend on
            the camera, and one rotation by the part's motion takes them to rest, the same one that
            rays need.
        part_rgba: (T, V, P, H, W, 4) uint8, as `rgba`.
        part_depth: (T, V, P, H, W) float32, as `depth`.
        part_normal: (T, V, P, H, W, 3) float32, as `normal`.
        cameras: intrinsics (V, 3, 3), camera_from_world (T, V, 4, 4).
        targets: ART's (B, C, D, O, S); positions relative to `center`.
        q: (T, J) joint values, rad or m, in the order of `meta.joints`, mimics included.
        center: (3,) middle of the bounding sphere, m, object frame.
        radius: of the bounding sphere, m.
        albedo: (T, V, H, W, 3) uint8, sRGB base color of the surface seen at a pixel's center; 0 is
            background. This and all below are None where they were not asked for.
        roughness: (T, V, H, W) uint8 of the surface seen, 255 = 1; 0 is background.
        flow: (T, V, H, W, 2) float32 px (right, down): where the surface point seen at a pixel's
            center in state t lies in state t + 1, minus where it lies in t; 0 for background and in
            the last state.
        linear: (T, V, H, W, 4) float16, the composite before display: linear RGB premultiplied by
            alpha.
        stated_cameras: the poses that a user would be given, with noise; `cameras` stay true.
    """

    meta: SampleMeta
    cameras: Cameras
    targets: Targets
    q: Floats
    center: Floats
    radius: float
    rgba: Bytes
    part_id: Bytes
    depth: Singles
    normal: Singles
    part_rgba: Bytes
    part_depth: Singles
    part_normal: Singles
    albedo: Bytes | None = None
    roughness: Bytes | None = None
    flow: Singles | None = None
    linear: Halves | None = None
    stated_cameras: Cameras | None = None

    def __post_init__(self) -> None:
        put = object.__setattr__
        put(self, "center", frozen(self.center, np.float64))
        put(self, "q", frozen(self.q, np.float64))
        put(self, "radius", float(self.radius))
        for name in self.images:
            view = np.ascontiguousarray(getattr(self, name)).view()
            view.setflags(write=False)
            put(self, name, view)
        put(self, "targets", _frozen_targets(self.targets))
        self._check_shapes()
        self._check_targets()

    @property
    def images(self) -> tuple[str, ...]:
        """Names of the image arrays that are there."""
        return (*_IMAGES, *(name for name in OPTIONAL_IMAGES if getattr(self, name) is not None))

    @property
    def shape(self) -> tuple[int, int, int, int, int]:
        """(T, V, P, H, W)."""
        states, views, slots, height, width = self.part_depth.shape
        return states, views, slots, height, width

    @property
    def valid(self) -> NDArray[np.bool_]:
        """(P,) whether a slot holds a part; padding follows the parts."""
        return np.arange(self.shape[2]) < len(self.meta.parts)

    @property
    def part_mask(self) -> NDArray[np.bool_]:
        """(T, V, P, H, W) whether the ray through a pixel's center meets the part alone."""
        return self.part_depth > 0

    @property
    def camera_from_centered(self) -> Floats:
        """(T, V, 4, 4) `camera_from_world` for points relative to `center`, as targets are."""
        moved = self.cameras.camera_from_world.copy()
        moved[..., :3, 3] += moved[..., :3, :3] @ self.center
        return moved

    def _check_shapes(self) -> None:
        asset = self.meta.asset_id
        if self.part_depth.ndim != 5:
            raise ShardError(
                f"{asset}: part_depth has shape {self.part_depth.shape}, expected 5 axes "
                "(states, views, parts, height, width)"
            )
        length = dict(zip("TVPHW", self.part_depth.shape, strict=True))
        if min(length.values()) < 1:
            raise ShardError(f"{asset}: part_depth has an empty axis: {self.part_depth.shape}")
        length.update({digit: int(digit) for digit in "234"})
        kinds = {**_IMAGES, **OPTIONAL_IMAGES}
        for name in self.images:
            axes, dtype = kinds[name]
            array = getattr(self, name)
            _expect_shape(f"{asset}: {name}", array, tuple(length[axis] for axis in axes))
            if array.dtype != dtype:
                raise ShardError(f"{asset}: {name} is {array.dtype}, expected {dtype}; convert it")
        for name, (axes, _) in _TARGETS.items():
            expected = tuple(length[axis] for axis in axes)
            _expect_shape(f"{asset}: targets.{name}", getattr(self.targets, name), expected)
        _expect_shape(f"{asset}: q", self.q, (length["T"], len(self.meta.joints)))
        _expect_shape(f"{asset}: center", self.center, (3,))
        _expect_cameras(f"{asset}: cameras", self.cameras, length)
        if self.stated_cameras is not None:
            _expect_cameras(f"{asset}: stated_cameras", self.stated_cameras, length)
        slots = self.meta.slots or len(self.meta.parts)
        if not len(self.meta.parts) <= slots == length["P"]:
            raise ShardError(
                f"{asset}: {length['P']} part slots for {len(self.meta.parts)} parts and "
                f"meta.slots = {self.meta.slots}; use to_slots() to pad or cut"
            )

    def _check_targets(self) -> None:
        asset, t = self.meta.asset_id, self.targets
        numbers = (t.bounds, t.axis, t.origin, t.motion, t.limits, self.q, self.center)
        if not (self.radius > 0 and all(np.isfinite(array).all() for array in numbers)):
            raise ShardError(f"{asset}: targets must be finite and radius {self.radius} m positive")
        if t.type.min() < FIXED or t.type.max() > PRISMATIC:
            raise ShardError(f"{asset}: joint types {t.type.tolist()}, expected 0, 1 or 2")
        if not np.array_equal(t.movable, t.type != FIXED) or t.movable[0]:
            raise ShardError(f"{asset}: movable must mean type != 0, and the base is fixed")
        length = np.linalg.norm(t.axis, axis=1)
        if np.abs(length - t.movable).max() > 1e-9:  # one rounding per component is 2e-16
            raise ShardError(f"{asset}: axis lengths {length.tolist()}, expected 1, or 0 if fixed")
        if np.abs(t.motion).max() > 1:
            raise ShardError(
                f"{asset}: motion reaches {np.abs(t.motion).max():.4f}, expected [-1, 1]; "
                "is the radius too small, or an angle in degrees?"
            )
        if (t.bounds[:, 1] < t.bounds[:, 0]).any():
            raise ShardError(f"{asset}: a part's upper bound lies below its lower bound")


def transparent_cleared(rgba: Bytes) -> Bytes:
    """(..., 4) the same image with RGB 0 where alpha is 0, as samples store it."""
    return np.where(rgba[..., 3:] == 0, np.uint8(0), rgba)


def _frozen_targets(targets: Targets) -> Targets:
    arrays: dict[str, Any] = {
        name: frozen(getattr(targets, name), dtype) for name, (_, dtype) in _TARGETS.items()
    }
    return Targets(**arrays)


def _expect_cameras(where: str, cameras: Cameras, length: Mapping[str, int]) -> None:
    poses = (length["T"], length["V"], 4, 4)
    _expect_shape(f"{where}.camera_from_world", cameras.camera_from_world, poses)
    if cameras.size != (length["W"], length["H"]):
        raise ShardError(
            f"{where} are {cameras.size} px (w, h), images {(length['W'], length['H'])}; render at "
            "the planned size"
        )


def _expect_shape(where: str, array: NDArray[np.generic], expected: tuple[int, ...]) -> None:
    if array.shape != expected:
        raise ShardError(f"{where} has shape {array.shape}, expected {expected}")
