"""Where to look from, and how users are told of it: near enough to fill the image, never nearer
than holds the object in all its states."""

from collections.abc import Sequence

import numpy as np

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix
from artgen.core.stream import Stream
from artgen.core.transform import rigid
from artgen.dataset.sample import Cameras
from renders.camera_schemes import between, directions
from renders.settings import CameraSettings

FILL = (0.84, 0.94)
"""Share of the image's half width that the object's farthest vertex may reach."""


def placed_cameras(
    points: Floats,
    stream: Stream,
    *,
    settings: CameraSettings,
    views: int,
    size: tuple[int, int],
    radius: float,
    ground: bool = False,
) -> tuple[Camera, ...]:
    """`views` cameras, each of which sees all (N, 3) `points`; view v depends on its own number
    alone.

    Every deviation has a stream of its own, so switching one on leaves the others as they are.

    Args:
        points: where any vertex is in any state, m; the corners of a hull around them do as well.
        radius: of the object, m; the unit of deviations.
        ground: there is a floor, so no eye stands below it.
    """
    places = directions(settings.scheme, stream, views=views, ground=ground)
    return tuple(
        _placed(
            points,
            stream.child("view", v),
            toward=orbit_direction(*place),
            settings=settings,
            size=size,
            radius=radius,
        )
        for v, place in enumerate(places)
    )


def _placed(
    points: Floats,
    stream: Stream,
    *,
    toward: Floats,
    settings: CameraSettings,
    size: tuple[int, int],
    radius: float,
) -> Camera:
    width, fill = stream.child("frame").generator().random(2)
    right, down = settings.look_at * radius * _signed(stream.child("look_at"), 2)
    (nearer,) = settings.dolly * _signed(stream.child("dolly"), 1)
    x, y = np.array(size) / 2.0 + settings.principal * size[0] * _signed(stream.child("crop"), 2)
    return framed(
        points,
        direction=toward,
        fov=between(settings.fov, width),
        size=size,
        fill=between(FILL, fill),
        aside=(float(right), float(down)),
        dolly=1.0 + float(nearer),
        principal=(float(x), float(y)) if settings.principal else None,
    )


def _signed(stream: Stream, count: int) -> Floats:
    """(count,) even in [-1, 1)."""
    return 2.0 * stream.generator().random(count) - 1.0


def stated_cameras(
    cameras: Sequence[Camera],
    stream: Stream,
    *,
    settings: CameraSettings,
    states: int,
    radius: float,
) -> Cameras | None:
    """What a user is told of the cameras, where it is not the truth; None without noise.

    Every photograph is registered on its own, so each state and view errs on its own: the camera
    turns about its eye by a normal rotation vector, and its eye moves by a normal vector.
    """
    if settings.rotation_noise == 0.0 and settings.position_noise == 0.0:
        return None
    poses = np.array(
        [
            [
                _noisy(
                    camera,
                    stream.child(t, v),
                    turn=settings.rotation_noise,
                    shift=settings.position_noise * radius,
                )
                for v, camera in enumerate(cameras)
            ]
            for t in range(states)
        ]
    )
    return Cameras(
        intrinsics=np.stack([camera.intrinsics for camera in cameras]),
        camera_from_world=poses,
        size=cameras[0].size,
    )


def _noisy(camera: Camera, stream: Stream, *, turn: float, shift: float) -> Floats:
    """(4, 4) `camera_from_world` of a camera that errs by standard deviations in rad and m, along
    each axis."""
    vector = turn * stream.child("rotation").generator().standard_normal(3)
    moved = shift * stream.child("position").generator().standard_normal(3)
    angle = float(np.linalg.norm(vector))
    error = axis_angle_matrix((vector / angle).tolist(), angle) if angle > 0.0 else np.eye(3)
    rotation = error @ camera.camera_from_world[:3, :3]
    return rigid(rotation, -rotation @ (camera.position + moved))
