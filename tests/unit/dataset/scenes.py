"""Small made-up samples whose images agree with each other."""

from dataclasses import replace

import numpy as np

from artgen.articulation.targets import Targets
from artgen.articulation.types import Joint, Limit, Mimic, Precondition, Spring
from artgen.dataset.sample import BACKGROUND, Cameras, PartLabel, Sample, SampleMeta


def made_sample(
    asset_id: str = "laptop_000000",
    *,
    states: int = 2,
    views: int = 2,
    parts: int = 3,
    height: int = 6,
    width: int = 5,
    seed: int = 0,
) -> Sample:
    """Noise of the right kind: random parts, each alone, and the nearest of them in front."""
    rng = np.random.default_rng([seed, parts, height, width])
    grid = (states, views, parts, height, width)
    hit = rng.random(grid) < 0.6
    part_depth = np.where(hit, rng.uniform(1.0, 3.0, grid), 0).astype(np.float32)
    part_normal = rng.standard_normal((*grid, 3)).astype(np.float32)
    part_normal /= np.linalg.norm(part_normal, axis=-1, keepdims=True)
    part_normal[~hit] = 0
    part_rgba = rng.integers(0, 256, (*grid, 4), dtype=np.uint8)
    part_rgba[~hit] = 0
    part_rgba[..., 3][hit] |= 1
    nearest = np.where(hit, part_depth, np.inf).argmin(axis=2)[:, :, None]
    front = {
        name: np.take_along_axis(array, nearest.reshape(nearest.shape + (1,) * extra), axis=2)[
            :, :, 0
        ]
        for name, array, extra in (
            ("rgba", part_rgba, 1),
            ("depth", part_depth, 0),
            ("normal", part_normal, 1),
        )
    }
    part_id = np.where(hit.any(axis=2), nearest[:, :, 0], BACKGROUND).astype(np.uint8)
    return Sample(
        meta=made_meta(asset_id, parts),
        cameras=made_cameras(rng, states, views, width, height),
        targets=made_targets(rng, states, parts),
        q=rng.uniform(0, 1, (states, parts - 1)),
        center=rng.uniform(-1, 1, 3),
        radius=rng.uniform(0.3, 2),
        rgba=front["rgba"],
        part_id=part_id,
        depth=front["depth"],
        normal=front["normal"],
        part_rgba=part_rgba,
        part_depth=part_depth,
        part_normal=part_normal,
    )


def with_extras(sample: Sample) -> Sample:
    """The sample with every optional array, noise that is 0 on the background."""
    rng = np.random.default_rng(1)
    states, views, _, height, width = sample.shape
    grid = (states, views, height, width)
    seen = sample.part_id != BACKGROUND
    flow = rng.normal(0, 5, (*grid, 2)).astype(np.float32) * seen[..., None]
    flow[-1] = 0
    return replace(
        sample,
        meta=replace(sample.meta, donors=("cabinet_000007", "cabinet_000009")),
        albedo=rng.integers(0, 256, (*grid, 3), dtype=np.uint8) * seen[..., None],
        roughness=rng.integers(0, 256, grid, dtype=np.uint8) * seen,
        flow=flow,
        linear=rng.exponential(1.0, (*grid, 4)).astype(np.float16),
        stated_cameras=made_cameras(rng, states, views, width, height),
    )


def made_meta(asset_id: str, parts: int) -> SampleMeta:
    """A star of revolute joints about the base, with every optional fact filled in."""
    joints = tuple(
        Joint(
            name=f"hinge_{k}",
            type="revolute",
            parent="base",
            child=f"door_{k}",
            axis=(0.0, 0.0, 1.0),
            origin=(0.1, 0.2, 0.3),
            limit=Limit(lower=0.0, upper=1.0 + k),
            friction=0.5,
            damping=0.1,
            effort=10.0,
            spring=Spring(stiffness=2.0, reference=0.1) if k == 1 else None,
            mimic=Mimic(joint="hinge_1") if k == 2 else None,
        )
        for k in range(1, parts)
    )
    return SampleMeta(
        asset_id=asset_id,
        category=asset_id.rsplit("_", 1)[0],
        seed=7,
        index=int(asset_id.rsplit("_", 1)[1]),
        parts=tuple(
            PartLabel(name="base" if k == 0 else f"door_{k}", label="base" if k == 0 else "door")
            for k in range(parts)
        ),
        joints=joints,
        preconditions=(Precondition(joint="hinge_1", requires="hinge_2", at_least=0.5),)
        if parts > 2
        else (),
        versions={"artgen": "0.1.0", "bpy": "4.5.15"},
        shading="cycles",
        light="studio_2",
        effects={"noise": {"iso": 100}},
        rendering={"settings": {"size": (64, 48)}, "promise_db": 36.5},
    )


def made_cameras(
    rng: np.random.Generator, states: int, views: int, width: int, height: int
) -> Cameras:
    """Random proper rotations and translations."""
    rotation, upper = np.linalg.qr(rng.standard_normal((states, views, 3, 3)))
    rotation *= np.sign(np.linalg.det(rotation))[..., None, None]
    assert upper.shape == rotation.shape
    camera_from_world = np.zeros((states, views, 4, 4))
    camera_from_world[..., :3, :3] = rotation
    camera_from_world[..., :3, 3] = rng.uniform(-2, 2, (states, views, 3))
    camera_from_world[..., 3, 3] = 1
    intrinsics = np.tile(
        np.array([[9.5, 0, width / 2], [0, 9.25, height / 2], [0, 0, 1]]), (views, 1, 1)
    )
    return Cameras(intrinsics=intrinsics, camera_from_world=camera_from_world, size=(width, height))


def made_targets(rng: np.random.Generator, states: int, parts: int) -> Targets:
    """A fixed base; every other part turns about z."""
    moves = np.arange(parts) > 0
    lower = rng.uniform(-1, 0, (parts, 3))
    return Targets(
        bounds=np.stack([lower, lower + rng.uniform(0, 1, (parts, 3))], axis=1),
        type=moves.astype(np.int8),
        axis=np.outer(moves, [0.0, 0.0, 1.0]),
        origin=rng.uniform(-1, 1, (parts, 3)) * moves[:, None],
        motion=rng.uniform(-1, 1, (states, parts)) * moves,
        parent=np.where(moves, 0, -1).astype(np.int8),
        limits=np.outer(moves, [0.0, 1.5]),
        movable=moves,
    )


def assert_same(actual: Sample, expected: Sample) -> None:
    """Every array bit-equal, every fact equal."""
    assert actual.meta == expected.meta
    assert actual.radius == expected.radius
    assert actual.cameras.size == expected.cameras.size
    assert actual.images == expected.images
    for name in ("q", "center", *expected.images):
        np.testing.assert_array_equal(getattr(actual, name), getattr(expected, name), err_msg=name)
    assert_same_cameras(actual.cameras, expected.cameras)
    assert (actual.stated_cameras is None) == (expected.stated_cameras is None)
    if expected.stated_cameras is not None:
        assert_same_cameras(actual.stated_cameras, expected.stated_cameras)
    for name in Targets.__dataclass_fields__:
        np.testing.assert_array_equal(
            getattr(actual.targets, name), getattr(expected.targets, name), err_msg=name
        )


def assert_same_cameras(actual: Cameras, expected: Cameras) -> None:
    """Bit-equal."""
    assert actual.size == expected.size
    for name in ("intrinsics", "camera_from_world"):
        np.testing.assert_array_equal(getattr(actual, name), getattr(expected, name), err_msg=name)
