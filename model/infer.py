"""Images and cameras to a Prediction: what is asked of a capture, and the network's one pass."""

import torch
from torch import Tensor

from artgen.core.errors import ModelError
from model.batch import Images
from model.config import Config
from model.network.art import Art
from model.network.prediction import Prediction


def predict(art: Art, config: Config, images: Images, *, parts: int | None) -> Prediction:
    """What the network makes of one object, on the device of its weights.

    Args:
        parts: how many, base included; None asks the network, which may have a head for it.

    Raises:
        ModelError: the images are not what the network was trained on, or the number of parts is
            not given, or more than it has slots.
    """
    check_images(config, images)
    images = images.to(next(art.parameters()).device)
    with torch.inference_mode():
        if parts is None:
            parts = counted(art, config, images)
        check_parts(config, parts)
        return art(images, first_slots(config, parts, images))


def first_slots(config: Config, parts: int, images: Images) -> Tensor:
    """(B, P) bool: the first `parts` slots of each object."""
    rgb = images.rgb_BTV3HW
    valid = torch.arange(config.model.slots, device=rgb.device) < parts
    return valid.expand(len(rgb), -1).clone()


def counted(art: Art, config: Config, images: Images) -> int:
    """How many parts the network counts.

    Raises:
        ModelError: it has no head for that.
    """
    if not config.model.count:
        raise ModelError(
            "the number of parts is not given and this checkpoint does not count them; say --parts "
            f"N, 1 to {config.model.slots}, base included"
        )
    count = art(images, first_slots(config, 1, images)).count()
    return 1 if count is None else int(count[0])


def check_parts(config: Config, parts: int) -> None:
    """Raise ModelError unless the network has so many slots."""
    if not 1 <= parts <= config.model.slots:
        raise ModelError(
            f"--parts {parts}: this checkpoint has {config.model.slots} slots, base included; give "
            f"1 to {config.model.slots}"
        )


def check_images(config: Config, images: Images) -> None:
    """Raise ModelError unless states and views are such as the network was trained on."""
    states, views = images.rgb_BTV3HW.shape[1:3]
    least = config.data.views
    check_states(config, states)
    if states > config.data.states:
        raise ModelError(
            f"the images show {states} states, this checkpoint was trained on {config.data.states} "
            "and has learned nothing of further ones; ask about so many at a time, as `artgen "
            "reconstruct` does"
        )
    if views < least:
        raise ModelError(
            f"the images show {views} views a state, this checkpoint was trained on {least}; add "
            "views, or use a checkpoint for fewer"
        )


def check_states(config: Config, states: int) -> None:
    """Raise ModelError where states are fewer than the network was trained on."""
    least = config.data.states
    if states < least:
        raise ModelError(
            f"the images show {states} state{'' if states == 1 else 's'}, this checkpoint was "
            f"trained on {least}; how parts move is seen between states alone: give {least} or "
            "more, each in its own state (`state` in the camera file, or state_0/, state_1/ in the "
            "images' names)"
        )
