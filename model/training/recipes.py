"""Named runs: debug, static_pretrain, multiview, monocular, each in sizes nano, s and paper."""

import dataclasses
from collections.abc import Callable, Mapping

from model.config import (
    Config,
    FieldConfig,
    ImageTokens,
    LossWeights,
    ModelConfig,
    PlaneConfig,
    Size,
    Trunk,
)
from model.data.config import DataConfig
from model.training.schedule import Stage, TrainConfig

OURS = FieldConfig(hidden=64, bias="smallest_side", octant_blend=0.03)
"""The field of the small sizes: balls that fit flat parts, octants without seams."""

MODELS: Mapping[Size, ModelConfig] = {
    "nano": ModelConfig(
        images=ImageTokens(image_px=48, patch_px=8, alpha=True, ray_octaves=8, encoder="conv"),
        trunk=Trunk(width=96, blocks=8, heads=6, direction="part_from_image"),
        planes=PlaneConfig(grid=8, scale=2, channels=8, tokens="one"),
        field=dataclasses.replace(OURS, hidden=32),
        motion="state_tokens",
        limits=True,
        tree=True,
        count=True,
    ),
    "s": ModelConfig(
        images=ImageTokens(image_px=128, patch_px=16, alpha=True, ray_octaves=8, encoder="conv"),
        trunk=Trunk(
            width=256,
            blocks=16,
            heads=8,
            direction="part_from_image",
            scope="alternate",
            shared_mlp=True,
        ),
        slot_embedding="shared",
        planes=PlaneConfig(grid=8, scale=8, channels=16),
        field=OURS,
        motion="state_tokens",
        limits=True,
        tree=True,
        count=True,
    ),
    "paper": ModelConfig(),
}
"""The network of each size; `paper` is the paper's reading throughout, the others ours."""

WORKERS = 8
"""Of sizes that need a GPU. To draw an item takes 2.6 ms of a CPU: 64 of them in the process that
trains would take 166 ms of each step."""

DATA: Mapping[Size, DataConfig] = {
    "nano": DataConfig(input_px=48, render_px=64, target_px=48, views=2, batch=32, rays=128),
    "s": DataConfig(
        input_px=128,
        render_px=160,
        target_px=128,
        views=4,
        batch=64,
        rays=1024,
        patch_px=32,
        workers=WORKERS,
    ),
    "paper": DataConfig(
        input_px=256,
        render_px=320,
        target_px=256,
        views=4,
        batch=64,
        rays=4096,
        patch_px=64,
        background="white",
        workers=WORKERS,
    ),
}

TRAIN: Mapping[Size, TrainConfig] = {
    "nano": TrainConfig(
        steps=10_000,
        learning_rate=1e-3,
        warmup_steps=300,
        precision="float32",
        samples=8,
        coarse=16,
        rendered=0.4,
        forced=0.6,
        stages=(Stage(start=0.0, target_px=48),),
        inverse_beta=(10.0, 60.0),
    ),
    "s": TrainConfig(
        steps=60_000,
        stages=(Stage(start=0.0, target_px=64), Stage(start=0.5, target_px=128)),
    ),
    "paper": TrainConfig(
        steps=200_000,
        warmup_steps=3_000,
        stages=(Stage(start=0.0, target_px=128), Stage(start=0.5, target_px=256)),
        inverse_beta=(10.0, 200.0),
    ),
}

SMALL = LossWeights(motion=10.0, motion_as="paths", overlap=4.0, range=1.0)
"""Motions compared by the ways that parts go, boxes and ranges by their overlap as well."""

WEIGHTS: Mapping[Size, LossWeights] = {
    "nano": dataclasses.replace(SMALL, part_perceptual=0.0),
    "s": SMALL,
    "paper": LossWeights(limits=0.0, parent=0.0, count=0.0),
}
"""Of terms that are computed: `nano` has no patches to compare, `paper` no heads of ours."""


def multiview(size: Size) -> Config:
    """Several views of two states; the paper's V = 4, T = 2."""
    return Config(
        recipe="multiview",
        size=size,
        model=MODELS[size],
        data=DATA[size],
        weights=WEIGHTS[size],
        train=TRAIN[size],
    )


def monocular(size: Size) -> Config:
    """One view of each of two states; the paper's V = 1, T = 2."""
    config = multiview(size)
    data = dataclasses.replace(config.data, views=1)
    return dataclasses.replace(config, recipe="monocular", data=data)


def static_pretrain(size: Size) -> Config:
    """Shapes and boxes of parts at rest, before anything moves, as the paper pre-trains.

    Rays follow the true joints to the end: nothing teaches the predicted ones.
    """
    config = multiview(size)
    data = dataclasses.replace(config.data, motion="rest")
    train = dataclasses.replace(config.train, rendered=0.0, forced=1.0)
    weights = dataclasses.replace(
        config.weights,
        type=0.0,
        axis=0.0,
        origin=0.0,
        motion=0.0,
        limits=0.0,
        range=0.0,
        parent=0.0,
    )
    return dataclasses.replace(
        config, recipe="static_pretrain", data=data, weights=weights, train=train
    )


def debug(size: Size) -> Config:
    """A few steps of `multiview`, on few items and rays: does everything run?"""
    config = multiview(size)
    train = config.train
    return dataclasses.replace(
        config,
        recipe="debug",
        data=dataclasses.replace(config.data, batch=4, rays=min(config.data.rays, 256), patch_px=0),
        weights=dataclasses.replace(config.weights, part_perceptual=0.0),
        train=dataclasses.replace(
            train,
            steps=20,
            warmup_steps=5,
            save_every=10,
            log_every=1,
            picture_every=10,
            rendered=0.0,
        ),
    )


def articulation_only(config: Config) -> Config:
    """The same run without shapes: boxes and joints alone, no planes and no rays."""
    return dataclasses.replace(
        config,
        model=dataclasses.replace(config.model, planes=None),
        data=dataclasses.replace(config.data, rays=0, patch_px=0),
    )


RECIPES: Mapping[str, Callable[[Size], Config]] = {
    "debug": debug,
    "static_pretrain": static_pretrain,
    "multiview": multiview,
    "monocular": monocular,
}
