"""Rendered images and cast labels to a Sample."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.kinematics import resolved
from artgen.articulation.targets import targets
from artgen.core.camera import Camera
from artgen.dataset.sample import Bytes, Cameras, PartLabel, Sample, SampleMeta
from artgen.dataset.split import families_of
from artgen.export import Bundle
from artgen.imaging import Singles, display
from renders.accuracy import quality
from renders.glb import read_appearance
from renders.labels import Labels, cast_labels, poses_by_part
from renders.paint import paints
from renders.plan import RenderPlan
from renders.raycast import PartCaster
from renders.sensor import sensed

Effects = dict[str, Mapping[str, float]]
"""What the sensor drew for each composite, by `s0v00`."""


def collected(plan: RenderPlan, linear: Sequence[Singles], *, shading: str) -> Sample:
    """The sample of a plan.

    Args:
        linear: for each shot (h, w, 4) float32 of its window, linear RGB premultiplied by alpha.
        shading: the shading model that made them.

    Raises:
        RenderError: an image is missing, of another size, or not finite; or albedo is asked for
            and the GLB cannot be read.
    """
    labels = cast(plan)
    whole = np.stack([[linear[k] for k in row] for row in plan.passes.composite])
    rgba, effects = photographed(plan, whole)
    bundle, extras = plan.bundle, set(plan.settings.extras)
    names = [part.name for part in bundle.parts]
    return Sample(
        meta=_meta(bundle, plan, shading, effects),
        cameras=_cameras(plan),
        stated_cameras=plan.stated,
        targets=targets(
            names,
            [part.bounds for part in bundle.parts],
            bundle.joints,
            plan.states,
            center=bundle.center,
            radius=bundle.radius,
        ),
        q=_joint_values(plan),
        center=bundle.center,
        radius=bundle.radius,
        rgba=rgba,
        part_rgba=_alone(plan, linear),
        part_id=labels.part_id,
        depth=labels.depth,
        normal=labels.normal,
        part_depth=labels.part_depth,
        part_normal=labels.part_normal,
        albedo=labels.albedo if "albedo" in extras else None,
        roughness=labels.roughness if "roughness" in extras else None,
        flow=labels.flow,
        linear=whole.astype(np.float16) if "linear" in extras else None,
    )


def photographed(plan: RenderPlan, whole: NDArray[np.float32]) -> tuple[Bytes, Effects]:
    """Composites (T, V, H, W, 4) as the sensor shows them, and what was drawn for each.

    Parts alone are targets, and stay as rendered."""
    settings = plan.settings.sensor
    shown = np.zeros(whole.shape, np.uint8)
    effects: Effects = {}
    for t, v in np.ndindex(*whole.shape[:2]):
        name = f"s{t}v{v:02d}"
        shown[t, v], drawn = sensed(whole[t, v], settings, plan.sensor.child(name))
        if drawn:
            effects[name] = drawn
    return shown, effects


def cast(plan: RenderPlan) -> Labels:
    """Labels of all states and views, with the extra ones that the settings ask for."""
    names = [part.name for part in plan.bundle.parts]
    extras = set(plan.settings.extras)
    look = read_appearance(Path(plan.job.glb)) if extras & {"albedo", "roughness"} else None
    return cast_labels(
        [PartCaster(mesh) for mesh in plan.meshes],
        poses_by_part(names, plan.poses),
        plan.cameras,
        plan.passes.boxes,
        paint=None if look is None else paints(names, plan.meshes, look, plan.bundle.surfaces),
        moving="flow" in extras,
    )


def _alone(plan: RenderPlan, linear: Sequence[Singles]) -> Bytes:
    """(T, V, P, H, W, 4) every part alone; each shot is encoded once."""
    shape = (len(plan.states), len(plan.cameras), len(plan.meshes), *plan.cameras[0].size[::-1])
    alone = np.zeros((*shape, 4), np.uint8)
    known: dict[int, Bytes] = {}
    for t, v, p in np.ndindex(*shape[:3]):
        if (shot := plan.passes.alone[t][v][p]) is not None:
            if shot not in known:
                known[shot] = display(linear[shot])
            left, top, right, bottom = plan.passes.shots[shot].box
            alone[t, v, p, top:bottom, left:right] = known[shot]
    return alone


def _cameras(plan: RenderPlan) -> Cameras:
    """The same cameras in every state."""
    views: list[Camera] = list(plan.cameras)
    poses = np.stack([camera.camera_from_world for camera in views])
    return Cameras(
        intrinsics=np.stack([camera.intrinsics for camera in views]),
        camera_from_world=np.repeat(poses[None], len(plan.states), axis=0),
        size=views[0].size,
    )


def _joint_values(plan: RenderPlan) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """(T, J) rad or m."""
    joints = plan.bundle.joints
    rows = [resolved(joints, state) for state in plan.states]
    values = [[row[joint.name] for joint in joints] for row in rows]
    return np.array(values, np.float64).reshape(len(rows), len(joints))


def _meta(bundle: Bundle, plan: RenderPlan, shading: str, effects: Effects) -> SampleMeta:
    versions = {name: str(value) for name, value in bundle.manifest.get("versions", {}).items()}
    return SampleMeta(
        asset_id=bundle.asset_id,
        category=bundle.category,
        seed=int(bundle.manifest.get("seed", 0)),  # Only generated bundles are of a seed.
        index=int(bundle.manifest.get("index", 0)),
        parts=tuple(PartLabel(name=part.name, label=part.label) for part in bundle.parts),
        joints=bundle.joints,
        preconditions=bundle.preconditions,
        versions=versions,
        shading=shading,
        light=plan.job.rig.name,
        effects=effects,
        rendering=_rendering(plan),
        donors=families_of(bundle.manifest),
    )


def _rendering(plan: RenderPlan) -> dict[str, object]:
    """What was asked for; of Cycles, what that came to, and which light transport was computed with
    reasons."""
    settings = plan.settings
    if settings.backend != "cycles":
        return {"settings": settings}
    return {
        "settings": settings,
        "quality": quality(settings.accuracy, settings.size).described(),
        "transport": plan.job.transport.described(),
    }
