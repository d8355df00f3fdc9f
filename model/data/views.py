"""Where the cameras of ray-cast images stand, and through which windows targets are seen."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.core.camera import framed, orbit_direction
from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix
from artgen.core.stream import Stream
from artgen.core.transform import rigid
from model.data.config import DataConfig


@dataclass(frozen=True, kw_only=True, eq=False)
class Views:
    """V cameras in each of T states.

    Attributes:
        intrinsics: (T, V, 3, 3) px.
        camera_from_world: (T, V, 4, 4) rigid, OpenCV axes, radii.
    """

    intrinsics: Floats
    camera_from_world: Floats


def drawn_views(
    points: Floats, config: DataConfig, stream: Stream, *, count: int, size: int
) -> Views:
    """`count` cameras a state, spread around the object, each as near as shows all of it.

    Args:
        points: (T, N, 3) radii, what must be seen in each state.
        size: width and height of the images, px.
    """
    states = len(points)
    if config.same_cameras:
        everything = points.reshape(1, -1, 3)
        views = _state_views(everything[0], config, stream, count, size)
        return Views(
            intrinsics=np.broadcast_to(views.intrinsics, (states, count, 3, 3)),
            camera_from_world=np.broadcast_to(views.camera_from_world, (states, count, 4, 4)),
        )
    rows = [
        _state_views(points[t], config, stream.child("state", t), count, size)
        for t in range(states)
    ]
    return Views(
        intrinsics=np.concatenate([row.intrinsics for row in rows]),
        camera_from_world=np.concatenate([row.camera_from_world for row in rows]),
    )


def _state_views(
    points: Floats, config: DataConfig, stream: Stream, count: int, size: int
) -> Views:
    """(1, count) cameras; azimuths lie in equal shares of the range, one each, in drawn order."""
    rng = stream.generator()
    turn = rng.random()
    shares = (rng.permutation(count) + 0.5 + 0.8 * (rng.random(count) - 0.5)) / count
    widest = math.radians(config.azimuth_deg)
    azimuths = widest * (2.0 * ((shares + turn) % 1.0) - 1.0)
    low, high = np.sin(np.radians(config.elevation_deg))
    elevations = np.arcsin(low + (high - low) * rng.random(count))
    near, far = np.radians(config.fov_deg)
    fovs = near + (far - near) * rng.random(count)
    cameras = [
        framed(
            points,
            direction=orbit_direction(float(azimuth), float(elevation)),
            fov=float(fov),
            size=(size, size),
            fill=config.fill,
        )
        for azimuth, elevation, fov in zip(azimuths, elevations, fovs, strict=True)
    ]
    return Views(
        intrinsics=np.stack([camera.intrinsics for camera in cameras])[None],
        camera_from_world=np.stack([camera.camera_from_world for camera in cameras])[None],
    )


def stated_views(views: Views, config: DataConfig, stream: Stream) -> Views:
    """The cameras as the network is told them: turned and shifted a little where asked for."""
    if config.pose_noise_deg == config.pose_noise == 0.0:
        return views
    poses = views.camera_from_world.copy()
    rng = stream.generator()
    for place in np.ndindex(*poses.shape[:2]):
        turn = math.radians(config.pose_noise_deg) * rng.normal(size=3)
        shift = config.pose_noise * rng.normal(size=3)
        angle = float(np.linalg.norm(turn))
        axis = turn / angle if angle > 0.0 else np.array([0.0, 0.0, 1.0])
        poses[place] = rigid(axis_angle_matrix(axis.tolist(), angle), shift) @ poses[place]
    return Views(intrinsics=views.intrinsics, camera_from_world=poses)
