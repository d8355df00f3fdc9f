"""Rendered images and cast labels to a Sample."""

from collections.abc import Sequence

import numpy as np

from artgen.articulation.kinematics import resolved
from artgen.articulation.targets import targets
from artgen.core.camera import Camera
from artgen.dataset.sample import Cameras, PartLabel, Sample, SampleMeta
from artgen.export import Bundle
from artgen.imaging import Singles, display
from renders.plan import RenderPlan
from renders.raycast import Labels, PartCaster, cast_labels


def collected(plan: RenderPlan, linear: Sequence[Singles], *, shading: str) -> Sample:
    """The sample of a plan.

    Args:
        linear: for each shot (h, w, 4) float32 of its window, linear RGB premultiplied by alpha.
        shading: the shading model that made them.

    Raises:
        RenderError: an image is missing, of another size, or not finite.
    """
    images = [display(image) for image in linear]
    labels = cast(plan)
    counts = (len(plan.states), len(plan.cameras))
    shape = (*counts, len(plan.meshes), *plan.cameras[0].size[::-1])
    rgba = np.stack([[images[k] for k in row] for row in plan.passes.composite])
    alone = np.zeros((*shape, 4), np.uint8)
    for t, v, p in np.ndindex(*shape[:3]):
        if (shot := plan.passes.alone[t][v][p]) is not None:
            left, top, right, bottom = plan.passes.shots[shot].box
            alone[t, v, p, top:bottom, left:right] = images[shot]
    bundle = plan.bundle
    names = [part.name for part in bundle.parts]
    return Sample(
        meta=_meta(bundle, plan, shading),
        cameras=_cameras(plan),
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
        part_rgba=alone,
        part_id=np.stack([[view.part_id for view in row] for row in labels]),
        depth=np.stack([[view.depth for view in row] for row in labels]),
        normal=np.stack([[view.normal for view in row] for row in labels]),
        part_depth=np.stack([[view.part_depth for view in row] for row in labels]),
        part_normal=np.stack([[view.part_normal for view in row] for row in labels]),
    )


def cast(plan: RenderPlan) -> list[list[Labels]]:
    """Labels [state][view]."""
    names = [part.name for part in plan.bundle.parts]
    casters = [PartCaster(mesh) for mesh in plan.meshes]
    return [
        [
            cast_labels(casters, names, poses, camera, boxes)
            for camera, boxes in zip(plan.cameras, windows, strict=True)
        ]
        for poses, windows in zip(plan.poses, plan.passes.boxes, strict=True)
    ]


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


def _meta(bundle: Bundle, plan: RenderPlan, shading: str) -> SampleMeta:
    versions = {name: str(value) for name, value in bundle.manifest["versions"].items()}
    return SampleMeta(
        asset_id=bundle.asset_id,
        category=bundle.category,
        seed=int(bundle.manifest["seed"]),
        index=int(bundle.manifest["index"]),
        parts=tuple(PartLabel(name=part.name, label=part.label) for part in bundle.parts),
        joints=bundle.joints,
        preconditions=bundle.preconditions,
        versions=versions,
        shading=shading,
        light=plan.job.rig.name,
    )
