"""A few scenes of every object, kept on disk: on a CPU, casting costs more than learning."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import torch
from diskcache import Cache
from torch import Tensor

from artgen.core.jsonio import content_hash
from artgen.core.stream import Stream
from model.batch import Batch
from model.data.config import DataConfig
from model.data.flat import from_bytes, to_bytes
from model.data.items import Source
from model.data.merge import merged
from model.data.order import Permutations, Row

LEVELS = 255.0
IMAGES = ("images.rgb_BTV3HW", "images.alpha_BTVHW")
"""What is kept in bytes."""


@dataclass(frozen=True)
class Kept:
    """Every object of a source in `scenes` scenes that come again in every epoch.

    Position k is scene k // n of object k % n of the source's n; its scene follows from the data's
    seed and k alone. Images are held, and given out, in steps of 1 / 255.

    Attributes:
        folder: holds what was cast, for all processes of a run and for its next start.
    """

    source: Source[Any]
    scenes: int
    folder: Path

    @cached_property
    def _cast(self) -> Cache:
        return Cache(str(self.folder), eviction_policy="none", size_limit=2**60)

    @property
    def left_out(self) -> Mapping[str, str]:
        """As the source's."""
        return self.source.left_out

    def __len__(self) -> int:
        return self.scenes * len(self.source)

    def order(self, seed: int) -> Row:
        """Every epoch a permutation of all scenes."""
        return Permutations(len(self), seed=seed)

    def plan(self, position: int, config: DataConfig, stream: Stream) -> bytes:
        """The scene, cast when first asked for: by whoever draws, so that workers do it beside a
        GPU. Bytes, as tensors between processes take a file handle each."""
        key = f"{_name(config)}/{position}"
        held: bytes | None = self._cast.get(key)
        if held is None:
            own = Stream(config.seed, "kept", position)
            plan = self.source.plan(position % len(self.source), config, own)
            item = self.source.batch([plan], config, torch.device("cpu"))
            held = to_bytes(item, dict.fromkeys(IMAGES, _byte))
            self._cast.set(key, held)
        return held

    def batch(self, planned: Sequence[bytes], config: DataConfig, device: torch.device) -> Batch:
        """The scenes, on the device."""
        return merged([from_bytes(own, dict.fromkeys(IMAGES, _float)) for own in planned]).to(
            device
        )


@cache
def _name(config: DataConfig) -> str:
    return content_hash(config)[:16]


def _byte(image: Tensor) -> Tensor:
    return (LEVELS * image).round().byte()


def _float(image: Tensor) -> Tensor:
    return image.float() / LEVELS
