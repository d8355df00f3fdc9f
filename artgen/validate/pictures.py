"""Pictures of the worst poses: the parts a finding names in color through the others, faint."""

import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from numpy.typing import NDArray
from PIL import Image

from artgen.articulation.kinematics import forward_kinematics, resolved
from artgen.articulation.types import State
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply
from artgen.geometry.clearance import Mover, overlaps
from artgen.validate.report import Finding, Report
from artgen.validate.subject import Subject
from artgen.validate.sweep import Sweep, sweep_poses

MOST = 4
"""Pictures an asset; the first findings of a kind tell most."""
SIZE = (360, 300)
FAINT = np.array([0.78, 0.80, 0.83])
COLORS = (np.array([0.93, 0.42, 0.16]), np.array([0.16, 0.45, 0.85]))
LIGHT = np.array([-0.35, -0.75, 0.56])
VIEW = np.array([-0.62, -0.66, 0.42])
"""From the object towards the camera: from the front left, above."""
CURVE = 41


@dataclass(frozen=True, kw_only=True)
class Picture:
    """A PNG that shows a finding, and what its sweep measured.

    Attributes:
        number: place of the finding in its report.
        curve: (q, value) pairs over the joint's range, empty where there is nothing to draw.
    """

    number: int
    png: bytes
    unit: str = ""
    curve: tuple[tuple[float, float], ...] = ()


def pictures_of(subject: Subject, report: Report) -> Iterator[Picture]:
    """Pictures of the findings that name parts whose meshes could be read, `MOST` at most."""
    drawn = 0
    for number, finding in enumerate(report.findings):
        if drawn == MOST or finding.check.startswith(("files.", "structure.", "compile.")):
            continue
        meshes = subject.meshes
        named = [name for name in meshes if name in finding.part.replace(",", " ").split()]
        joint = next((j for j in subject.joints if j.name == finding.joint), None)
        named = named or [joint.child for _ in (0,) if joint is not None and joint.child in meshes]
        if named:
            drawn += 1
            png = drawing(meshes, poses_at(subject, finding.state or {}), named)
            curve = shared_volume(subject, finding, named)
            yield Picture(number=number, png=png, unit="m3 shared", curve=curve)


def poses_at(subject: Subject, state: State) -> Mapping[str, Floats]:
    """Part name to (4, 4) `object_from_rest`."""
    return forward_kinematics(
        subject.parts[0].name, subject.joints, resolved(subject.joints, state)
    )


def shared_volume(
    subject: Subject, finding: Finding, named: Sequence[str]
) -> tuple[tuple[float, float], ...]:
    """q of the finding's joint and the volume (m3) that its two parts share there."""
    joint = next((j for j in subject.joints if j.name == finding.joint), None)
    if finding.check != "motion.overlap" or joint is None or joint.limit is None or len(named) != 2:
        return ()
    path = np.linspace(joint.limit.lower, joint.limit.upper, CURVE).tolist()
    states = tuple({**(finding.state or {}), joint.name: q} for q in path)
    sweep = Sweep(joint=joint.name, states=states)
    poses = sweep_poses(subject.parts[0].name, subject.joints, sweep)
    movers = [Mover(name=n, shape=subject.shapes[n], poses=poses[n]) for n in named]
    volume = np.zeros(CURVE)
    for overlap in overlaps(movers):
        volume[overlap.pose] = overlap.volume
    return tuple(zip(path, volume.tolist(), strict=True))


def drawing(
    meshes: Mapping[str, TriMesh], poses: Mapping[str, Floats], named: Sequence[str]
) -> bytes:
    """A PNG of the object from the front left, the named parts shown through the others."""
    placed = {name: apply(poses[name], mesh.triangles) for name, mesh in meshes.items()}
    rays = _rays(np.concatenate([t.reshape(-1, 3) for t in placed.values()]))
    faint = [t for name, t in placed.items() if name not in named]
    image = np.ones((len(rays[0]), 3))
    if faint:
        _paint(image, rays, np.concatenate(faint), FAINT, 1.0)
    solid = [placed[name] for name in named]
    colors = np.concatenate([np.full(len(t), k % 2) for k, t in enumerate(solid)]).astype(int)
    _paint(image, rays, np.concatenate(solid), np.array(COLORS)[colors], 0.75)
    pixels = (image.reshape(SIZE[1], SIZE[0], 3) * 255.0).round().astype(np.uint8)
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def _rays(points: Floats) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Origins and directions (N, 3) of a parallel view that holds all points, row by row."""
    view = VIEW / np.linalg.norm(VIEW)
    right = np.cross((0.0, 0.0, 1.0), view)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(view, right)])
    flat = points @ axes.T
    middle, span = (flat.min(axis=0) + flat.max(axis=0)) / 2.0, np.ptp(flat, axis=0)
    pitch = 1.08 * max(span[0] / SIZE[0], span[1] / SIZE[1])
    u = (np.arange(SIZE[0]) - SIZE[0] / 2.0 + 0.5) * pitch + middle[0]
    v = (SIZE[1] / 2.0 - 0.5 - np.arange(SIZE[1])) * pitch + middle[1]
    grid = np.stack(np.meshgrid(u, v), axis=2).reshape(-1, 2)
    far = float((points @ view).max()) + 1.0
    origins = grid @ axes + far * view
    return origins.astype(np.float32), np.tile(-view, (len(origins), 1)).astype(np.float32)


def _paint(
    image: Floats,
    rays: tuple[NDArray[np.float32], NDArray[np.float32]],
    triangles: Floats,
    color: Floats,
    alpha: float,
) -> None:
    """Lay shaded triangles of one color, or one each, over the image."""
    scene = rtcore_scene.EmbreeScene()
    TriangleMesh(scene, triangles.astype(np.float32))
    hit = scene.run(*rays)
    seen = hit >= 0
    a, b, c = triangles.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    shade = 0.55 + 0.45 * np.abs(normal @ LIGHT)
    painted = np.broadcast_to(color, (len(triangles), 3)) * shade[:, None]
    image[seen] += alpha * (painted[hit[seen]] - image[seen])
