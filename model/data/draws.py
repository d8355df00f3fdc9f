"""Small choices of chance that all sources share."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from artgen.core.stream import Stream
from model.data.config import Background, DataConfig

_COLORS: Mapping[Background, float] = {"white": 1.0, "gray": 0.5, "black": 0.0}


def chosen_views(config: DataConfig, count: int, stream: Stream) -> NDArray[np.int64]:
    """(T, W) which of `count` views supervise in each state, none twice while they last."""
    rng = stream.generator()
    rows = [rng.permutation(count) for _ in range(config.states)]
    return np.stack([np.resize(row, config.target_views) for row in rows]).astype(np.int64)


def background_color(kind: Background, stream: Stream) -> NDArray[np.float32]:
    """(3,) sRGB."""
    if kind == "random":
        return stream.generator().random(3, dtype=np.float32)
    return np.full(3, _COLORS[kind], np.float32)
