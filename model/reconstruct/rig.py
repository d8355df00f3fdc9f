"""Which format a camera file has, and a rig whose world is the object's: z up, front -y."""

import dataclasses
from pathlib import Path

import numpy as np

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from artgen.core.transform import inverted
from model.reconstruct.cameras import SCHEMA, Rig, rig_of_own_json
from model.reconstruct.colmap import rig_of_colmap
from model.reconstruct.nerf import rig_of_transforms
from model.reconstruct.stated import read_json

LINE = np.sin(np.radians(6.0)) ** 2
"""Mean square of what cameras' rights have beside a line, below which they are one."""


def read_rig(cameras: Path, images: Path) -> Rig:
    """The rig of a camera file: a folder is COLMAP's, a JSON file with frames NeRF's, else ours.

    Raises:
        ModelError: it cannot be read, or is of another schema.
    """
    if cameras.is_dir() or cameras.suffix == ".txt":
        return upright(rig_of_colmap(cameras if cameras.is_dir() else cameras.parent))
    stated = read_json(cameras)
    if "frames" in stated:
        rig = rig_of_transforms(cameras, stated, images)
        return rig if rig.front_stated else upright(rig)
    if stated.get("schema") != SCHEMA:
        raise ModelError(
            f"{cameras}: schema {stated.get('schema')!r}, expected {SCHEMA!r}, a NeRF "
            "transforms.json or a folder with COLMAP's text files"
        )
    return rig_of_own_json(cameras, stated)


def upright(rig: Rig) -> Rig:
    """The rig with its world turned: up is what `up_of` says, -y where the first camera stands."""
    poses = [inverted(shot.camera_from_world) for shot in rig.shots]
    up = up_of(np.array([pose[:3, :3] for pose in poses]))
    toward = poses[0][:3, 2]
    away = _unit(toward - (toward @ up) * up, np.eye(3)[int(np.argmin(np.abs(up)))])
    right = np.cross(away, up)
    object_from_world = np.eye(4)
    object_from_world[:3, :3] = np.stack([right, away, up])
    return turned(rig, object_from_world)


def up_of(turns: Floats) -> Floats:
    """(3,) what is up in the world of some cameras: what is square to the right of all of them, as
    nobody tilts a camera sideways; what they hold up leans toward them by how far they look down.

    Where their rights are almost one line, which leaves a fan of directions, it is the one of these
    nearest to what they hold up.

    Args:
        turns: (N, 3, 3) world_from_camera, OpenCV axes.
    """
    held = _unit(-turns[:, :, 1].sum(axis=0), np.array([0.0, 0.0, 1.0]))
    spread, axes = np.linalg.eigh(turns[:, :, 0].T @ turns[:, :, 0] / len(turns))
    fan = axes[:, spread <= max(LINE, float(spread[0]))]
    return _unit(fan @ (fan.T @ held), held)


def _unit(vector: Floats, otherwise: Floats) -> Floats:
    length = float(np.linalg.norm(vector))
    return otherwise if length < 1e-6 else np.asarray(vector / length)


def turned(rig: Rig, object_from_world: Floats) -> Rig:
    """The rig in another rigid frame."""
    shots = tuple(
        dataclasses.replace(
            shot, camera_from_world=shot.camera_from_world @ inverted(object_from_world)
        )
        for shot in rig.shots
    )
    center = rig.center
    if center is not None:
        center = object_from_world[:3, :3] @ center + object_from_world[:3, 3]
    return dataclasses.replace(rig, shots=shots, center=center)
