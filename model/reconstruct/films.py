"""What a user looks at first: a turntable, the joints at work, inputs beside reprojections."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image

from artgen.articulation.states import open_state, required_state, travel
from artgen.articulation.types import ArticulatedObject, State
from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.mesh import Floats
from artgen.imaging import Singles, png_file
from model.reconstruct.draw import Bytes, Painter, gif_bytes, over

SIDE = 256
"""px of the films' frames."""
TURNS = 24
"""Frames of the turntable."""
STROKE = 16
"""Frames in which joints open and close again."""
MOST_STROKES = 4
"""Joints that are shown alone, before all together."""
FOV = math.radians(32.0)
ELEVATION = math.radians(22.0)
FRONT = math.radians(30.0)
AJAR = 0.6
GROUND = (246, 246, 248)
EDGE = (120, 120, 128)


def camera_around(points: Floats, azimuth: float, *, side: int = SIDE) -> Camera:
    """A camera that shows all points from an azimuth, 0 the front, rad."""
    direction = orbit_direction(azimuth, ELEVATION)
    return framed(points, direction=direction, fov=FOV, size=(side, side), fill=0.9)


def painted(painter: Painter, state: State, camera: Camera) -> Bytes:
    """(H, W, 4) as a camera in the object frame sees it."""
    return painter.paint(state, camera.intrinsics, camera.camera_from_world, camera.size)


def turntable(obj: ArticulatedObject, painter: Painter) -> bytes:
    """A GIF of one round about the object ajar; the camera keeps its distance."""
    state = open_state(obj.joints, obj.preconditions, AJAR)
    points = _ball(painter.points(state))
    frames = []
    for k in range(TURNS):
        camera = camera_around(points, FRONT + 2.0 * math.pi * k / TURNS)
        frames.append(over(painted(painter, state, camera), GROUND))
    return gif_bytes(frames, seconds=4.0)


def _ball(points: Floats) -> Floats:
    """Points of a sphere around others, so that a camera around it keeps its distance."""
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    reach = float(np.linalg.norm(points - middle, axis=1).max())
    turns = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False)
    rings = [
        [np.cos(turns) * math.cos(v), np.sin(turns) * math.cos(v), np.full(24, math.sin(v))]
        for v in np.linspace(-math.pi / 2.0, math.pi / 2.0, 13)
    ]
    return np.asarray(middle + reach * np.concatenate([np.array(ring).T for ring in rings]))


def strokes(obj: ArticulatedObject) -> list[dict[str, float]]:
    """States of a film: each joint opens and closes, what it waits for held open; at last all."""
    joints = [joint for joint in obj.joints if joint.mimic is None]
    opening = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(STROKE // 2 + 1) / STROKE)
    shares = [*opening.tolist(), *opening[-2:0:-1].tolist()]  # Closing shows the same pictures.
    states: list[dict[str, float]] = []
    for joint in joints[:MOST_STROKES] if len(joints) > 1 else []:
        held = required_state(joint.name, obj.preconditions)
        lower, upper = travel(joint)
        far = upper if upper >= -lower else lower
        states += [{**held, joint.name: share * far} for share in shares]
    states += [open_state(obj.joints, obj.preconditions, share) for share in shares]
    return states


def articulation(obj: ArticulatedObject, painter: Painter) -> bytes:
    """A GIF of the joints at work, seen from the front right."""
    wide = open_state(obj.joints, obj.preconditions, 1.0)
    points = np.concatenate([painter.points({}), painter.points(wide)])
    camera = camera_around(points, FRONT)
    shown: dict[tuple[tuple[str, float], ...], Bytes] = {}
    frames = []
    for state in strokes(obj):
        key = tuple(sorted((name, q) for name, q in state.items() if q != 0.0))
        if key not in shown:
            shown[key] = over(painted(painter, state, camera), GROUND)
        frames.append(shown[key])
    return gif_bytes(frames, seconds=len(frames) / STROKE * 1.6)


def thumbnail(obj: ArticulatedObject, painter: Painter) -> bytes:
    """A PNG of the object ajar, transparent ground, as bundles have one."""
    state = open_state(obj.joints, obj.preconditions, AJAR)
    camera = camera_around(painter.points(state), FRONT)
    return png_file(painted(painter, state, camera))


@dataclass(frozen=True, kw_only=True, eq=False)
class Reprojection:
    """One input image and what the reconstruction shows there.

    Attributes:
        seen: (S, S, 4) uint8, straight alpha.
        shown: (S, S, 4) likewise.
    """

    state: int
    view: int
    seen: Bytes
    shown: Bytes

    @property
    def iou(self) -> float:
        """Of the two silhouettes."""
        one, other = self.seen[..., 3] > 127, self.shown[..., 3] > 127
        return float((one & other).sum() / max(int((one | other).sum()), 1))


def straight(rgb: Singles, alpha: Singles) -> Bytes:
    """(H, W, 4) uint8 of a picture over white (H, W, 3) and its coverage (H, W, 1)."""
    color = (rgb - (1.0 - alpha)) / np.where(alpha > 0.0, alpha, 1.0)
    rgba = np.concatenate([np.clip(color, 0.0, 1.0), alpha], axis=-1)
    return np.rint(255.0 * rgba).astype(np.uint8)


def side_by_side(found: Sequence[Reprojection]) -> bytes:
    """A PNG: a row a state, pairs of input and reprojection."""
    rows: Mapping[int, list[Bytes]] = {own.state: [] for own in found}
    for own in found:
        pair = [over(own.seen, GROUND), over(own.shown, GROUND)]
        line = np.full((pair[0].shape[0], 2, 3), EDGE, np.uint8)
        rows[own.state].append(np.concatenate([*pair, line], axis=1))
    sheet = np.concatenate([np.concatenate(row, axis=1) for row in rows.values()])
    return png_file(np.asarray(Image.fromarray(sheet)))
