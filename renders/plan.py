"""Bundle and stream to RenderPlan: states, cameras, lights, passes; all chance is spent here."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import sample_states
from artgen.articulation.trajectories import Track, frame_times, tracks
from artgen.articulation.types import State
from artgen.core.camera import Camera
from artgen.core.mesh import Floats, TriMesh
from artgen.core.stream import Stream
from artgen.dataset.sample import Cameras
from artgen.export import Bundle
from artgen.export.layout import GLB
from artgen.render_job import Ground, LightRig, RenderJob
from artgen.transport import needed_transport
from renders.accuracy import Quality, quality
from renders.cameras import placed_cameras, stated_cameras
from renders.lights import light_rig
from renders.passes import Passes, planned_passes
from renders.settings import Settings
from renders.subject import check_size, hull_corners, loaded_meshes, moved_corners

GROUND = 20.0
"""Radius of the floor, in radii of the object: softboxes stand 3.5 to 5 off, shadows end before."""
MOMENTS = 5
"""Poses of a moving part while the shutter is open; parts ease, so straight lines between them are
off by a hundredth of the way."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RenderPlan:
    """All that is known of a sample before the first ray.

    Attributes:
        meshes: of the parts in the bundle's order, at rest.
        poses: part name to `object_from_rest`, for each state.
        stated: what a user is told of the cameras, where that has errors.
        sensor: chance of what a camera adds after rendering.
    """

    bundle: Bundle
    settings: Settings
    meshes: tuple[TriMesh, ...]
    states: tuple[State, ...]
    poses: tuple[dict[str, Floats], ...]
    cameras: tuple[Camera, ...]
    stated: Cameras | None
    sensor: Stream
    passes: Passes
    job: RenderJob


def plan_render(bundle: Bundle, stream: Stream, *, settings: Settings, folder: Path) -> RenderPlan:
    """The plan of one asset's sample; EXR files will lie in `folder`.

    Raises:
        RenderError: a mesh of the bundle cannot be read, or the object's size cannot be rendered.
    """
    names = [part.name for part in bundle.parts]
    meshes = loaded_meshes(bundle)
    states, moments = planned_states(bundle, stream.child("states"), settings)
    poses = _posed(bundle, states)
    exposures = tuple(_posed(bundle, shutter) for shutter in moments)
    shown = exposures or tuple((pose,) for pose in poses)
    hulls = [hull_corners(mesh.vertices) for mesh in meshes]
    corners = moved_corners(names, hulls, [pose for seen in shown for pose in seen])
    check_size(bundle, meshes, corners)
    cameras = placed_cameras(
        corners,
        stream.child("cameras"),
        settings=settings.cameras,
        views=settings.views,
        size=(settings.size, settings.size),
        radius=bundle.radius,
        ground=settings.ground,
    )
    stated = stated_cameras(
        cameras,
        stream.child("pose noise"),
        settings=settings.cameras,
        states=len(states),
        radius=bundle.radius,
    )
    paths = quality(settings.accuracy, settings.size)
    passes = planned_passes(
        names, hulls, shown, cameras, samples=paths.samples, part_samples=paths.part_samples
    )
    rig = _rig(stream.child("lights"), meshes, corners, settings, folder)
    job = RenderJob(
        glb=str(bundle.folder.resolve() / GLB),
        folder=str(folder.resolve()),
        cameras=tuple(camera.stated for camera in cameras),
        states=poses,
        rig=rig,
        transport=needed_transport(bundle.surfaces, rig, motion_blur=bool(exposures)),
        shots=passes.shots,
        seed=int(stream.child("cycles").generator().integers(2**31)),
        exposures=exposures,
        **_tracing(paths),
    )
    return RenderPlan(
        bundle=bundle,
        settings=settings,
        meshes=meshes,
        states=states,
        poses=poses,
        cameras=cameras,
        stated=stated,
        sensor=stream.child("sensor"),
        passes=passes,
        job=job,
    )


def _posed(bundle: Bundle, states: Sequence[State]) -> tuple[dict[str, Floats], ...]:
    """Part name to `object_from_rest`, for each state."""
    base = bundle.parts[0].name
    return tuple(forward_kinematics(base, bundle.joints, state) for state in states)


def _tracing(paths: Quality) -> dict[str, Any]:
    """The fields of a quality that are a job's too; samples are its shots'."""
    shared = {field.name for field in fields(RenderJob)} & {field.name for field in fields(paths)}
    return {name: getattr(paths, name) for name in shared}


def planned_states(
    bundle: Bundle, stream: Stream, settings: Settings
) -> tuple[tuple[State, ...], tuple[tuple[State, ...], ...]]:
    """The states, and for each of them those while the shutter is open; none without motion blur.

    Drawn states begin with rest, each other state drawn a joint; a single state is a drawn one.
    """
    if settings.motion == "trajectory":
        moving = tracks(bundle.joints, bundle.preconditions, stream)
        times = frame_times(settings.states)
        shutters = [_shutter(time, settings) for time in times] if settings.motion_blur else []
        return (
            tuple(_state(moving, time) for time in times),
            tuple(tuple(_state(moving, time) for time in shutter) for shutter in shutters),
        )
    count = max(1, settings.states - 1)
    drawn = sample_states(bundle.joints, bundle.preconditions, stream, count)
    return (tuple(drawn) if settings.states == 1 else ({}, *drawn)), ()


def _state(moving: Mapping[str, Track], time: float) -> State:
    return {name: track.at(time) for name, track in moving.items()}


def _shutter(time: float, settings: Settings) -> list[float]:
    """Even times while the shutter is open: from the state on, or up to it at the very end."""
    length = settings.motion_blur / max(1, settings.states - 1)
    start = min(time, 1.0 - length)
    moments = [start + length * k / (MOMENTS - 1) for k in range(MOMENTS)]
    return [time, *moments[1:]] if start == time else [*moments[:-1], time]


def _rig(
    stream: Stream,
    meshes: Sequence[TriMesh],
    corners: Floats,
    settings: Settings,
    folder: Path,
) -> LightRig:
    """The lights, sized by all states; and the floor on which the object stands at rest."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    center, radius = (low + high) / 2.0, float(np.linalg.norm(high - low) / 2.0)
    rig = light_rig(settings.light, stream, center=center, radius=radius, folder=folder)
    if not settings.ground:
        return rig
    floor = Ground(
        height=min(float(mesh.bounds[0, 2]) for mesh in meshes),
        center=(float(center[0]), float(center[1])),
        radius=GROUND * radius,
    )
    return replace(rig, ground=floor)
