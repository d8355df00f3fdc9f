"""From a capture to what the network sees: the object's sphere, square crops, cameras in radii."""

import dataclasses
from dataclasses import dataclass

import numpy as np
import torch

from artgen.core.mesh import Floats
from artgen.dataset.preprocess import square_view
from model.batch import Images
from model.reconstruct.cameras import Rig
from model.reconstruct.capture import Capture
from model.reconstruct.hull import VisualHull

SWEEP = 1.1
"""The sphere of training holds all ends of all joints, the one of the images what they show."""
TIPS = 0.02
"""Share of a hull's points at either end of each axis that its middle is taken without."""
BACKGROUNDS = {"white": 1.0, "gray": 0.5, "black": 0.0, "random": 1.0}
"""sRGB behind the foreground, by the word in the network's settings."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Sphere:
    """Where the object is and how large: what positions are divided by.

    Attributes:
        center: (3,) in the unit of the camera file.
        radius: in that unit.
        meters: one unit in m.
        center_stated, radius_stated: whether the camera file says so; else the visual hull does.
    """

    center: Floats
    radius: float
    meters: float
    center_stated: bool
    radius_stated: bool

    @property
    def stated(self) -> bool:
        """Whether the camera file says all of it."""
        return self.center_stated and self.radius_stated

    @property
    def radius_m(self) -> float:
        """m."""
        return self.radius * self.meters


def sphere_of(rig: Rig, hull: VisualHull) -> Sphere:
    """The sphere that the camera file states, or one around the visual hull.

    The middle is that of what the hulls of all states share, which is about what does not move.
    """
    center = middle_of(hull) if rig.center is None else rig.center
    reach = max(float(np.linalg.norm(points - center, axis=1).max()) for points in hull.points)
    return Sphere(
        center=center,
        radius=SWEEP * (reach + hull.step / 2.0) if rig.radius is None else rig.radius,
        meters=rig.meters,
        center_stated=rig.center is not None,
        radius_stated=rig.radius is not None,
    )


def middle_of(hull: VisualHull) -> Floats:
    """(3,) middle of the box around the points that the hulls of all states share, without the tips
    that reach to where no camera looks; of all their points where they share none."""
    every = np.concatenate(hull.points)
    places, counts = np.unique(np.round(every / hull.step, 3), axis=0, return_counts=True)
    shared = places[counts == len(hull.points)] * hull.step
    ends = np.quantile(shared if len(shared) else every, (TIPS, 1.0 - TIPS), axis=0)
    return np.asarray(ends.mean(axis=0))


def network_images(capture: Capture, sphere: Sphere, *, size: int, background: str) -> Images:
    """One object of T states by V views: square crops at `size` px, as in training."""
    states, views = capture.rgba.shape[:2]
    crops = [
        [square_view(capture.rgba[t, v], capture.intrinsics[t, v], size=size) for v in range(views)]
        for t in range(states)
    ]
    rgba = np.array([[crop.rgba for crop in row] for row in crops])
    ground = BACKGROUNDS[background]
    rgb = rgba[..., :3] + (1.0 - rgba[..., 3:]) * ground
    intrinsics = np.array([[crop.intrinsics for crop in row] for row in crops])
    poses = np.array(
        [[in_radii(pose, sphere) for pose in row] for row in capture.camera_from_world]
    )
    return Images(
        rgb_BTV3HW=torch.tensor(rgb.transpose(0, 1, 4, 2, 3), dtype=torch.float32)[None],
        alpha_BTVHW=torch.tensor(rgba[..., 3], dtype=torch.float32)[None],
        intrinsics_BTV33=torch.tensor(intrinsics, dtype=torch.float32)[None],
        camera_from_world_BTV44=torch.tensor(np.array(poses), dtype=torch.float32)[None],
    )


def reposed(images: Images, capture: Capture, sphere: Sphere) -> Images:
    """The images of a whole capture with their cameras about another sphere."""
    poses = [[in_radii(pose, sphere) for pose in row] for row in capture.camera_from_world]
    told = torch.tensor(np.array(poses), dtype=torch.float32)[None]
    return dataclasses.replace(images, camera_from_world_BTV44=told)


def in_radii(camera_from_world: Floats, sphere: Sphere) -> Floats:
    """The pose with the sphere's middle for zero and its radius for one."""
    pose = camera_from_world.copy()
    pose[:3, 3] = (pose[:3, :3] @ sphere.center + pose[:3, 3]) / sphere.radius
    return pose


def in_object(camera_from_world: Floats, sphere: Sphere, shift: Floats) -> Floats:
    """The pose over the object frame in m, which lies `shift` m from the sphere's middle."""
    pose = in_radii(camera_from_world, sphere)
    pose[:3, 3] = pose[:3, 3] * sphere.radius_m - pose[:3, :3] @ shift
    return pose
