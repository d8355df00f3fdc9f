"""Terms of the loss that weigh something in the settings but are not computed, and why."""

import dataclasses

from model.config import Config

IMAGE_TERMS = ("part_rgb", "part_mask", "part_perceptual", "rgb", "mask", "distance")


def idle_terms(config: Config, *, perceptual: bool) -> dict[str, str]:
    """Term to the reason why a run leaves it out, of those whose weight is above 0.

    Args:
        perceptual: whether the network that compares patches is installed.
    """
    weights = dataclasses.asdict(config.weights)
    reasons = {**_heads(config), **_images(config, perceptual=perceptual)}
    return {name: why for name, why in reasons.items() if weights[name] > 0.0}


def idle_line(idle: dict[str, str]) -> str:
    """The same in words."""
    terms = "; ".join(f"{name} ({why})" for name, why in idle.items())
    return f"weights above 0 whose terms are left out: {terms}"


def _heads(config: Config) -> dict[str, str]:
    model = config.model
    heads = {
        "limits": ("limits", model.limits),
        "range": ("limits", model.limits),
        "parent": ("tree", model.tree),
        "count": ("count", model.count),
    }
    return {name: f"model.{head} is off" for name, (head, there) in heads.items() if not there}


def _images(config: Config, *, perceptual: bool) -> dict[str, str]:
    if config.model.planes is None:
        return dict.fromkeys(IMAGE_TERMS, "model.planes is null")
    if config.data.rays == 0:
        return dict.fromkeys(IMAGE_TERMS, "data.rays is 0")
    if config.train.rendered >= 1.0:
        return dict.fromkeys(IMAGE_TERMS, "train.rendered is 1")
    if config.data.patch_px == 0:
        return {"part_perceptual": "data.patch_px is 0, and it compares patches"}
    if not perceptual:
        return {"part_perceptual": "its network is absent: pip install artgen[encoders]"}
    return {}
