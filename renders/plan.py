"""Bundle and stream to RenderPlan: states, cameras, lights, passes; all chance is spent here."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import sample_states
from artgen.articulation.types import State
from artgen.core.camera import Camera
from artgen.core.mesh import Floats, TriMesh
from artgen.core.stream import Stream
from artgen.core.transform import apply
from artgen.export import Bundle
from artgen.export.layout import GLB
from artgen.render_job import RenderJob
from artgen.transport import needed_transport
from renders.accuracy import quality
from renders.cameras import orbit_cameras
from renders.lights import studio_rig
from renders.passes import Passes, planned_passes
from renders.settings import Settings


@dataclass(frozen=True, kw_only=True, eq=False)
class RenderPlan:
    """All that is known of a sample before the first ray.

    Attributes:
        meshes: of the parts in the bundle's order, at rest.
        poses: part name to `object_from_rest`, for each state.
    """

    bundle: Bundle
    settings: Settings
    meshes: tuple[TriMesh, ...]
    states: tuple[State, ...]
    poses: tuple[dict[str, Floats], ...]
    cameras: tuple[Camera, ...]
    passes: Passes
    job: RenderJob


def plan_render(bundle: Bundle, stream: Stream, *, settings: Settings, folder: Path) -> RenderPlan:
    """The plan of one asset's sample; EXR files will lie in `folder`.

    Raises:
        ExportError: a mesh of the bundle cannot be read.
    """
    names = [part.name for part in bundle.parts]
    meshes = tuple(bundle.load_mesh(name) for name in names)
    states = drawn_states(bundle, stream.child("states"), settings.states)
    poses = tuple(forward_kinematics(names[0], bundle.joints, state) for state in states)
    points = np.concatenate(
        [
            apply(pose[name], mesh.vertices)
            for pose in poses
            for name, mesh in zip(names, meshes, strict=True)
        ]
    )
    cameras = orbit_cameras(
        points,
        stream.child("cameras"),
        views=settings.views,
        size=(settings.size, settings.size),
    )
    paths = quality(settings.accuracy)
    passes = planned_passes(
        names,
        [mesh.vertices for mesh in meshes],
        poses,
        cameras,
        samples=paths.samples,
        part_samples=paths.part_samples,
    )
    low, high = points.min(axis=0), points.max(axis=0)
    rig = studio_rig(
        stream.child("lights"),
        center=(low + high) / 2.0,
        radius=float(np.linalg.norm(high - low) / 2.0),
    )
    job = RenderJob(
        glb=str(bundle.folder.resolve() / GLB),
        folder=str(folder.resolve()),
        cameras=tuple(camera.stated for camera in cameras),
        states=poses,
        rig=rig,
        transport=needed_transport(bundle.surfaces, rig),
        shots=passes.shots,
        denoise=paths.denoise,
        prefilter=paths.prefilter,
        denoise_quality=paths.denoise_quality,
        adaptive=paths.adaptive,
        bounces=paths.bounces,
        seed=int(stream.child("cycles").generator().integers(2**31)),
    )
    return RenderPlan(
        bundle=bundle,
        settings=settings,
        meshes=meshes,
        states=states,
        poses=poses,
        cameras=cameras,
        passes=passes,
        job=job,
    )


def drawn_states(bundle: Bundle, stream: Stream, count: int) -> tuple[State, ...]:
    """Rest first, then states drawn a joint; a single state is a drawn one."""
    drawn = sample_states(bundle.joints, bundle.preconditions, stream, max(1, count - 1))
    return tuple(drawn) if count == 1 else ({}, *drawn)
