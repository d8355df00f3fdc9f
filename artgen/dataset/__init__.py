"""Samples, shards and the catalog; reading them needs no torch."""

from artgen.dataset.reader import ShardDataset, open_shard, read_shard
from artgen.dataset.sample import (
    BACKGROUND,
    LEFT_OUT,
    Cameras,
    PartLabel,
    Sample,
    SampleMeta,
    transparent_cleared,
)
from artgen.dataset.sampler import ResumableSampler
from artgen.dataset.slots import to_slots
from artgen.dataset.split import split_of

__all__ = [
    "BACKGROUND",
    "LEFT_OUT",
    "Cameras",
    "PartLabel",
    "ResumableSampler",
    "Sample",
    "SampleMeta",
    "ShardDataset",
    "open_shard",
    "read_shard",
    "split_of",
    "to_slots",
    "transparent_cleared",
]
