"""Items of shards are the samples that were packed: images, targets, cameras."""

import dataclasses

import numpy as np
import pytest
import torch

from artgen.core.errors import ModelError, ShardError
from artgen.core.stream import Stream
from artgen.dataset.members import encoded
from artgen.dataset.sample import Sample
from artgen.dataset.shard import write_shard
from model.data.config import DataConfig
from model.data.loader import batches
from model.data.shards import ShardSource
from model.data.shuffle import shuffled
from tests.unit.dataset.scenes import made_sample
from tests.unit.model.data.small import assert_equal

CONFIG = DataConfig(batch=2, slots=4, views=2, states=2, input_px=8, target_px=8, rays=64)
IDS = ("laptop_000000", "laptop_000001", "laptop_000002")


@pytest.fixture(scope="module")
def samples() -> dict[str, Sample]:
    """Three samples of three states by four views; the last has more parts than slots."""
    parts = (3, 2, 5)
    return {
        name: made_sample(name, states=3, views=4, parts=parts[k], height=12, width=15, seed=k)
        for k, name in enumerate(IDS)
    }


@pytest.fixture(scope="module")
def folder(samples, tmp_path_factory):
    path = tmp_path_factory.mktemp("shards")
    write_shard(path / "train-000000.tar", [encoded(sample) for sample in samples.values()])
    return path


@pytest.fixture(scope="module")
def source(folder) -> ShardSource:
    return ShardSource(folder, slots=4)


def test_samples_with_too_many_parts_are_left_out_by_name(source):
    assert len(source) == 2
    assert source.left_out == {"laptop_000002": "5 parts, 4 slots"}


def test_truth_is_the_sample_s_targets_in_radii(source, samples):
    batch = next(batches(source, CONFIG))
    for b, name in enumerate(batch.asset_ids):
        targets, radius = samples[name].targets, samples[name].radius
        count = len(targets.type)
        found = batch.truth
        assert found.valid_BP[b].tolist() == [k < count for k in range(4)]
        box = np.stack([found.center_BP3[b], found.size_BP3[b]])[:, :count]
        low, high = (box[0] - box[1] / 2) * radius, (box[0] + box[1] / 2) * radius
        # float32 of numbers below 4.
        np.testing.assert_allclose(low, targets.bounds[:, 0], atol=1e-6)
        np.testing.assert_allclose(high, targets.bounds[:, 1], atol=1e-6)
        np.testing.assert_allclose(found.origin_BP3[b, :count] * radius, targets.origin, atol=1e-6)
        rows = targets.motion.astype(np.float32)
        for t in range(2):
            assert (found.motion_BTP[b, t, :count].numpy() == rows).all(axis=1).any()


def test_rays_carry_the_colors_of_the_pixels_that_they_go_through(source, samples):
    batch = next(batches(source, CONFIG))
    rays = batch.rays
    assert rays is not None
    for b, name in enumerate(batch.asset_ids):
        sample = samples[name]
        motion = sample.targets.motion.astype(np.float32)
        for r in range(CONFIG.rays):
            row = batch.truth.motion_BTP[b, rays.state_BR[b, r], : motion.shape[1]].numpy()
            t = int(np.flatnonzero((motion == row).all(axis=1))[0])
            v, y, x, depth = _pixel(sample, t, rays.origin_BR3[b, r], rays.direction_BR3[b, r])
            part = sample.part_rgba[t, v, :, y, x] / 255.0
            found = rays.part_rgb_BPR3[b, : len(part), r]
            np.testing.assert_allclose(found, part[:, :3] * part[:, 3:], atol=1e-6)
            np.testing.assert_allclose(rays.alpha_BR[b, r], sample.rgba[t, v, y, x, 3] / 255.0)
            seen = float(rays.distance_BR[b, r]) * sample.radius * depth
            # Depth codes are 3e-5 of a range of 2 m; then float32 of meters.
            assert abs(seen - sample.depth[t, v, y, x]) < 4e-5


def test_rest_is_a_state_in_which_nothing_moved(source, samples, tmp_path):
    config = dataclasses.replace(CONFIG, motion="rest")
    with pytest.raises(ModelError, match=r"0 of 3 states can be used, motion 'rest' needs 1"):
        next(batches(source, config))
    sample = samples[IDS[0]]
    q = sample.q.copy()
    q[1] = 0.0
    motion = sample.targets.motion.copy()
    motion[1] = 0.0
    rested = dataclasses.replace(
        sample, q=q, targets=dataclasses.replace(sample.targets, motion=motion)
    )
    write_shard(tmp_path / "train-000000.tar", [encoded(rested)])
    batch = next(batches(ShardSource(tmp_path, slots=4), config))
    assert not batch.truth.motion_BTP.any()


def test_one_state_is_shown_in_all(source):
    batch = next(batches(source, dataclasses.replace(CONFIG, motion="one")))
    assert torch.equal(batch.truth.motion_BTP[:, 0], batch.truth.motion_BTP[:, 1])


def test_others_are_views_that_the_network_does_not_see(source):
    batch = next(batches(source, CONFIG))
    assert batch.rays is not None
    eyes = batch.images.camera_from_world_BTV44
    centers = -(eyes[..., :3, :3].transpose(-1, -2) @ eyes[..., :3, 3:])[..., 0]
    for b in range(2):
        for t in range(2):
            own = batch.rays.origin_BR3[b][batch.rays.state_BR[b] == t]
            assert torch.cdist(own, centers[b, t]).min() > 1e-3


def test_articulation_alone_reads_no_target(source):
    batch = next(batches(source, dataclasses.replace(CONFIG, rays=0)))
    assert batch.rays is None
    assert batch.images.rgb_BTV3HW.shape == (2, 2, 2, 3, 8, 8)


def test_too_few_views_and_states_are_named(source):
    with pytest.raises(ModelError, match="4 views, the network sees 5"):
        next(batches(source, dataclasses.replace(CONFIG, views=5)))
    with pytest.raises(ModelError, match="3 of 3 states can be used, motion 'states' needs 4"):
        next(batches(source, dataclasses.replace(CONFIG, states=4)))


def test_a_folder_without_usable_samples_is_refused(folder, tmp_path):
    with pytest.raises(ModelError, match="no sample fits"):
        ShardSource(folder, slots=1)
    with pytest.raises(ShardError, match="holds no"):
        ShardSource(tmp_path)


def test_a_corrupt_member_is_named(folder, tmp_path):
    for path in folder.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    tar = tmp_path / "train-000000.tar"
    data = bytearray(tar.read_bytes())
    at = data.index(b"RIFF")
    data[at + 20] ^= 1
    tar.write_bytes(bytes(data))
    source = ShardSource(tmp_path, slots=4)
    config = dataclasses.replace(CONFIG, views=4, states=3, rays=0)
    with pytest.raises(ShardError, match="fails its checksum"):
        source.plan(0, config, Stream(0))


def _pixel(sample: Sample, t: int, origin, direction) -> tuple[int, int, int, float]:
    """View, row and column that a ray goes through, and its depth a meter of way."""
    for v in range(4):
        pose = sample.camera_from_centered[t, v]
        eye = pose[:3, :3] @ (origin.numpy() * sample.radius) + pose[:3, 3]
        if np.abs(eye).max() > 1e-5:
            continue
        local = pose[:3, :3] @ direction.numpy()
        x, y, _ = sample.cameras.intrinsics[v] @ (local / local[2])
        assert abs(x % 1 - 0.5) < 1e-3
        assert abs(y % 1 - 0.5) < 1e-3
        return v, int(y), int(x), float(local[2])
    raise AssertionError("no camera stands where the ray begins")


def test_shards_know_no_other_rest_and_may_be_shuffled(source):
    first = dataclasses.replace(CONFIG, rest="first")
    with pytest.raises(ModelError, match="needs the shapes of parts"):
        source.plan(0, first, Stream(0))
    batch = [
        source.batch([source.plan(0, config, Stream(0))], config, torch.device("cpu"))
        for config in (CONFIG, dataclasses.replace(CONFIG, part_order="shuffled"))
    ]
    assert_equal(batch[1], shuffled(batch[0]))
