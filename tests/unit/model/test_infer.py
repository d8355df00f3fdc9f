"""What the network is not made for is told before it runs."""

import dataclasses
from contextlib import nullcontext

import pytest
import torch

from artgen.core.errors import ModelError
from model.batch import Images
from model.config import Config, Size
from model.infer import predict
from model.network.art import Art
from model.training.recipes import RECIPES, articulation_only


@pytest.fixture(scope="module")
def untrained() -> tuple[Art, Config]:
    torch.manual_seed(0)
    config = articulation_only(RECIPES["debug"]("nano"))
    return Art(config.model).eval(), config


def images(config: Config, *, states: int, views: int) -> Images:
    size = config.data.input_px
    shape = (1, states, views)
    return Images(
        rgb_BTV3HW=torch.rand(*shape, 3, size, size),
        alpha_BTVHW=torch.ones(*shape, size, size),
        intrinsics_BTV33=torch.tensor([[60.0, 0, 24], [0, 60, 24], [0, 0, 1]]).expand(*shape, 3, 3),
        camera_from_world_BTV44=torch.eye(4).expand(*shape, 4, 4),
    )


def test_the_slots_asked_for_are_filled(untrained: tuple[Art, Config]) -> None:
    art, config = untrained
    seen = images(config, states=config.data.states, views=config.data.views)
    found = predict(art, config, seen, parts=3)
    assert int(found.articulation.valid_BP.sum()) == 3


def test_more_parts_than_slots_are_refused(untrained: tuple[Art, Config]) -> None:
    art, config = untrained
    seen = images(config, states=config.data.states, views=config.data.views)
    for parts in (0, config.model.slots + 1):
        with pytest.raises(ModelError, match=f"--parts {parts}: this checkpoint has"):
            predict(art, config, seen, parts=parts)


def test_too_few_states_are_refused(untrained: tuple[Art, Config]) -> None:
    """One state passed without a word, and a joint that nobody saw move came out."""
    art, config = untrained
    seen = images(config, states=1, views=config.data.views)
    with pytest.raises(
        ModelError, match=r"show 1 state, this checkpoint was trained on 2; .* give 2"
    ):
        predict(art, config, seen, parts=2)


def test_states_that_were_not_trained_are_refused(untrained: tuple[Art, Config]) -> None:
    """Also where the table has vectors for them, about which nothing was learned."""
    art, config = untrained
    states = config.data.states + 1
    roomy = dataclasses.replace(config.model.images, states=states)
    config = dataclasses.replace(config, model=dataclasses.replace(config.model, images=roomy))
    with pytest.raises(ModelError, match=f"show {states} states, this checkpoint was trained on 2"):
        predict(art, config, images(config, states=states, views=config.data.views), parts=2)


def test_a_network_for_three_states_reads_three() -> None:
    torch.manual_seed(0)
    config = articulation_only(RECIPES["debug"]("nano"))
    model = dataclasses.replace(
        config.model, images=dataclasses.replace(config.model.images, states=3)
    )
    config = dataclasses.replace(
        config, model=model, data=dataclasses.replace(config.data, states=3)
    )
    art = Art(config.model).eval()
    found = predict(art, config, images(config, states=3, views=config.data.views), parts=2)
    assert found.articulation.motion_BTP.shape[1] == 3
    with pytest.raises(ModelError, match="show 2 states, this checkpoint was trained on 3"):
        predict(art, config, images(config, states=2, views=config.data.views), parts=2)


def test_too_few_views_are_refused(untrained: tuple[Art, Config]) -> None:
    art, config = untrained
    views = config.data.views - 1
    if views:
        seen = images(config, states=config.data.states, views=views)
        with pytest.raises(ModelError, match=f"show {views} views a state"):
            predict(art, config, seen, parts=2)


def test_the_number_of_parts_is_counted_where_it_is_not_given(
    untrained: tuple[Art, Config],
) -> None:
    art, config = untrained
    seen = images(config, states=config.data.states, views=config.data.views)
    if config.model.count:
        found = predict(art, config, seen, parts=None)
        assert 1 <= int(found.articulation.valid_BP.sum()) <= config.model.slots
    else:
        with pytest.raises(ModelError, match="does not count them; say --parts"):
            predict(art, config, seen, parts=None)


@pytest.mark.parametrize("size", ["nano", "s"])
def test_it_computes_where_its_weights_are(size: Size, monkeypatch: pytest.MonkeyPatch) -> None:
    """A device without memory refuses tensors of any other, as a GPU does; autocast does not know
    it."""
    monkeypatch.setattr(torch, "autocast", lambda *_, **__: nullcontext())
    config = RECIPES["multiview"](size)
    art = Art(config.model).to("meta")
    found = predict(art, config, images(config, states=2, views=config.data.views), parts=3)
    assert found.articulation.valid_BP.device.type == "meta"
    points, slot = torch.rand(1, 5, 3, device="meta"), torch.zeros(1, dtype=torch.int64)
    assert found.planes_BP6CHW is not None
    assert found.planes_BP6CHW.device.type == "meta"
    with pytest.raises(RuntimeError):  # So it does refuse.
        found.field().distances(points, slot)
