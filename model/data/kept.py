"""A few scenes of every object, kept in memory: on a CPU, casting costs more than learning."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import torch
from torch import Tensor

from artgen.core.stream import Stream
from model.batch import Batch
from model.data.config import DataConfig
from model.data.items import Source
from model.data.merge import merged
from model.data.order import Permutations, Row

LEVELS = 255.0


@dataclass(frozen=True)
class Kept:
    """Every object of a source in `scenes` scenes that come again in every epoch.

    Position k is scene k // n of object k % n of the source's n; its scene follows from the data's
    seed and k alone. Images are held, and given out, in steps of 1 / 255.
    """

    source: Source[Any]
    scenes: int
    _shown: dict[tuple[int, DataConfig], Batch] = field(default_factory=dict, repr=False)

    @property
    def left_out(self) -> Mapping[str, str]:
        """As the source's."""
        return self.source.left_out

    def __len__(self) -> int:
        return self.scenes * len(self.source)

    def order(self, seed: int) -> Row:
        """Every epoch a permutation of all scenes."""
        return Permutations(len(self), seed=seed)

    def plan(self, position: int, config: DataConfig, stream: Stream) -> int:
        """The position; what is drawn follows from it."""
        return position

    def batch(self, planned: Sequence[int], config: DataConfig, device: torch.device) -> Batch:
        """The scenes, cast when first asked for."""
        shown = [_unpacked(self._item(position, config)) for position in planned]
        return merged(shown).to(device)

    def _item(self, position: int, config: DataConfig) -> Batch:
        key = (position, config)
        if key not in self._shown:
            stream = Stream(config.seed, "kept", position)
            plan = self.source.plan(position % len(self.source), config, stream)
            item = self.source.batch([plan], config, torch.device("cpu"))
            self._shown[key] = _with_images(item, lambda x: (LEVELS * x).round().byte())
        return self._shown[key]


def _unpacked(item: Batch) -> Batch:
    return _with_images(item, lambda x: x.float() / LEVELS)


def _with_images(item: Batch, change: Callable[[Tensor], Tensor]) -> Batch:
    images = item.images
    changed = replace(
        images, rgb_BTV3HW=change(images.rgb_BTV3HW), alpha_BTVHW=change(images.alpha_BTVHW)
    )
    return replace(item, images=changed)
