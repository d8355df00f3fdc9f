"""Camera: a pinhole with OpenCV axes; and the nearest place from which it sees given points."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from artgen.core.mesh import Floats, frozen
from artgen.core.stated_camera import StatedCamera
from artgen.core.transform import apply, inverted, look_at

CLEARANCE = 0.05


@dataclass(frozen=True, kw_only=True, eq=False)
class Camera:
    """A pinhole.

    Attributes:
        focal: px, the same along x and y.
        size: (width, height) px; the center of the first pixel is at (0.5, 0.5).
        camera_from_world: (4, 4) rigid; x right, y down, z forward, m.
        principal: (x, y) px of the principal point; the middle of the image unless stated.
    """

    focal: float
    size: tuple[int, int]
    camera_from_world: Floats
    principal: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        matrix = frozen(np.asarray(self.camera_from_world).reshape(4, 4), np.float64)
        object.__setattr__(self, "camera_from_world", matrix)
        object.__setattr__(self, "size", (int(self.size[0]), int(self.size[1])))

    @property
    def center(self) -> tuple[float, float]:
        """(x, y) px where the optical axis meets the image."""
        return self.principal or (self.size[0] / 2.0, self.size[1] / 2.0)

    @property
    def stated(self) -> StatedCamera:
        """The same camera as plain numbers, for a render job."""
        a, b, c, d = (tuple(row) for row in self.camera_from_world.tolist())
        return StatedCamera(
            focal=self.focal, principal=self.center, size=self.size, camera_from_world=(a, b, c, d)
        )

    @property
    def intrinsics(self) -> Floats:
        """(3, 3) px."""
        x, y = self.center
        return np.array([[self.focal, 0, x], [0, self.focal, y], [0, 0, 1.0]])

    @property
    def position(self) -> Floats:
        """(3,) m, world."""
        return np.asarray(inverted(self.camera_from_world)[:3, 3])

    def project(self, points: ArrayLike) -> Floats:
        """(..., 3) px x, px y and depth (m, along z) of world points."""
        local = apply(self.camera_from_world, points)
        depth = local[..., 2:]
        return np.concatenate([self.focal * local[..., :2] / depth + self.center, depth], axis=-1)

    def rays(self) -> tuple[Floats, Floats]:
        """Origin (3,) and directions (H, W, 3) through the pixel centers, world; a direction is as
        long as one meter of depth, so that points are origin + depth * direction."""
        width, height = self.size
        x = (np.arange(width) + 0.5 - self.center[0]) / self.focal
        y = (np.arange(height) + 0.5 - self.center[1]) / self.focal
        local = np.stack([*np.meshgrid(x, y), np.ones((height, width))], axis=-1)
        return self.position, local @ self.camera_from_world[:3, :3]


def orbit_direction(azimuth: float, elevation: float) -> Floats:
    """(3,) unit vector from the object to the eye; azimuth 0 is the front (-y) and grows towards
    +x, rad."""
    flat = math.cos(elevation)
    return np.array([flat * math.sin(azimuth), -flat * math.cos(azimuth), math.sin(elevation)])


def framed(
    points: ArrayLike,
    *,
    direction: Sequence[float] | Floats,
    fov: float,
    size: tuple[int, int],
    fill: float,
    aside: tuple[float, float] = (0.0, 0.0),
    dolly: float = 1.0,
    principal: tuple[float, float] | None = None,
) -> Camera:
    """The camera along `direction` that comes as near as keeps all points within the image.

    Args:
        points: (N, 3) m, world.
        direction: unit vector from the object to the eye.
        fov: across the shorter side of the image, rad.
        fill: share of the image's half width and height that the points may use, in (0, 1].
        aside: where the camera looks, beside what would center the points; m, right and down.
        dolly: factor on the distance of the eye from the points' middle. Below 1 the points may use
            the whole image and stop the eye at its border.
        principal: (x, y) px of the principal point; the middle of the image unless stated. The eye
            moves sideways against it, so that the points stay in the middle.

    The eye also stays `CLEARANCE` of the cloud's extent in front of the nearest point: a spike that
    points at the camera would else reach it.
    """
    cloud = np.asarray(points, float)
    target = (cloud.min(axis=0) + cloud.max(axis=0)) / 2.0
    toward = np.asarray(direction, float)
    turned = inverted(look_at(target + toward, target))[:3, :3]
    local = (cloud - target) @ turned.T
    focal = min(size) / 2.0 / math.tan(fov / 2.0)
    middle = np.array(size) / 2.0
    offset = np.zeros(2) if principal is None else (middle - np.array(principal)) / focal
    wanted = _Sight(local, offset, fill * middle / focal, np.abs(aside))
    clear = float(CLEARANCE * np.ptp(cloud, axis=0).max() - local[:, 2].min())
    sight, distance = wanted, wanted.distance * dolly
    if dolly < 1.0:
        sight = _Sight(local, offset, middle / focal, np.abs(aside))
        distance = max(distance, sight.distance)
    distance = max(distance, clear)
    right, down = sight.shift(distance) + aside
    eye = target + np.array([right, down, -distance]) @ turned
    pose = np.column_stack([turned, -turned @ eye])
    return Camera(
        focal=focal,
        size=size,
        camera_from_world=np.vstack([pose, (0.0, 0.0, 0.0, 1.0)]),
        principal=principal,
    )


class _Sight:
    """How far back and how far aside an eye must stand to see points in a window of the image.

    A point at (x, z) is in the window of slopes `offset - half` to `offset + half` from an eye at
    (s, -d) when x - s <= (offset + half) (z + d) and x - s >= (offset - half) (z + d). The points
    that reach farthest either way, `high` and `low`, leave room for s while
    2 half d >= high - low; in the middle of that room, both borders hold the points back equally.

    Args:
        local: (N, 3) m, camera axes, the origin anywhere.
        offset: (2,) slope at the middle of the image.
        half: (2,) slopes from there to the window's borders.
        spare: (2,) m by which s may leave the middle of its room.
    """

    def __init__(self, local: Floats, offset: Floats, half: Floats, spare: Floats) -> None:
        across, depth = local[:, :2], local[:, 2:]
        self._high = (across - (offset + half) * depth).max(axis=0)
        self._low = (across - (offset - half) * depth).min(axis=0)
        self._offset = offset
        self.distance = float((((self._high - self._low) / 2.0 + spare) / half).max())

    def shift(self, distance: float) -> Floats:
        """(2,) the middle of the room for s, m."""
        middle: Floats = (self._high + self._low) / 2.0 - self._offset * distance
        return middle
