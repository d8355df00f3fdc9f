"""Laws of the trunk: who changes by whom, in which block."""

import dataclasses
from typing import get_args

import pytest
import torch
from torch import Tensor

from artgen.core.errors import ModelError
from model.config import Direction, Trunk
from model.network.blocks import CrossBlock, SelfBlock, TrunkBlocks
from tests.unit.model.tiny_art import TINY, held

TRUNK = TINY.trunk
NEAR = 1e-12
"""Some hundred float64 roundings of numbers of size 1 to 10."""


def streams(seed: int = 0) -> tuple[Tensor, Tensor]:
    """Two objects of three images of four tokens, and of four slots of two tokens."""
    torch.manual_seed(seed)
    return (
        torch.randn(2, 3, 4, 16, dtype=torch.float64),
        torch.randn(2, 4, 2, 16, dtype=torch.float64),
    )


def cross(direction: Direction) -> CrossBlock:
    torch.manual_seed(1)
    trunk = dataclasses.replace(TRUNK, direction=direction)
    return CrossBlock(trunk, image_goes_on=True).double()


def joint(*, within: bool = False, goes_on: bool = True, shared: bool = False) -> SelfBlock:
    torch.manual_seed(1)
    trunk = dataclasses.replace(TRUNK, shared_mlp=shared)
    return SelfBlock(trunk, within=within, image_goes_on=goes_on).double()


def test_in_the_papers_direction_images_read_and_parts_stay() -> None:
    image, part = streams()
    read, kept = cross("image_from_part")(image, part, held((3, 4)))
    assert kept is None
    assert (read != image).any(dim=-1).all()


def test_in_the_other_direction_parts_read_and_images_stay() -> None:
    image, part = streams()
    kept, read = cross("part_from_image")(image, part, held((3, 4)))
    assert kept is None
    assert (read != part).any(dim=-1).all()


def test_with_both_images_read_parts_that_have_read() -> None:
    image, part = streams()
    block, valid = cross("both"), held((4, 4))
    assert block.part_reads is not None
    assert block.image_reads is not None
    read_image, read_part = block(image, part, valid)
    expected = block.part_reads(part.flatten(1, 2), image.flatten(1, 2))
    assert torch.equal(read_part.flatten(1, 2), expected)
    assert torch.equal(read_image.flatten(1, 2), block.image_reads(image.flatten(1, 2), expected))


@pytest.mark.parametrize("direction", get_args(Direction))
def test_order_of_slots_does_not_change_the_images(direction: Direction) -> None:
    image, part = streams()
    block, valid, order = cross(direction), held((3, 4)), [2, 0, 3, 1]
    ours, theirs = block(image, part, valid), block(image, part[:, order], valid[:, order])
    if ours[0] is not None:
        torch.testing.assert_close(ours[0], theirs[0], rtol=0, atol=NEAR)
    if ours[1] is not None:
        torch.testing.assert_close(ours[1][:, order], theirs[1], rtol=0, atol=NEAR)


def influence(block: SelfBlock | TrunkBlocks, valid: Tensor) -> tuple[bool, bool, bool, bool]:
    """Whether changing one image token changes another image, and a part; one part token, an image,
    and another part."""
    image, part = streams()
    base = block(image, part, valid)
    other_image, other_part = image.clone(), part.clone()
    other_image[:, 0, 1] += 1.0
    other_part[:, 0, 1] += 1.0
    by_image, by_part = block(other_image, part, valid), block(image, other_part, valid)
    return (
        not torch.equal(by_image[0][:, 1:], base[0][:, 1:]),
        not torch.equal(by_image[1], base[1]),
        not torch.equal(by_part[0], base[0]),
        not torch.equal(by_part[1][:, 1:], base[1][:, 1:]),
    )


def test_joint_self_attention_lets_all_tokens_meet() -> None:
    assert influence(joint(), held((4, 4))) == (True, True, True, True)


def test_self_attention_within_keeps_to_an_image_and_to_a_part() -> None:
    assert influence(joint(within=True), held((4, 4))) == (False, False, False, False)


@pytest.mark.parametrize("within", [True, False])
def test_images_that_no_part_reads_any_more_cost_nothing_and_change_nothing(within: bool) -> None:
    """The last block's parts are the same whether or not it updates image tokens."""
    image, part = streams()
    full_block = joint(within=within)
    lean = joint(within=within, goes_on=False)
    names = {name for name, _ in lean.named_parameters()}
    weights = {name: w for name, w in full_block.state_dict().items() if name in names}
    lean.load_state_dict(weights)
    kept, read = lean(image, part, held((3, 4)))
    assert kept is None
    expected = full_block(image, part, held((3, 4)))[1]
    torch.testing.assert_close(read, expected, rtol=0, atol=NEAR)


def test_streams_share_a_network_only_where_so_asked() -> None:
    block = joint(shared=True)
    assert block.mlp_image is block.mlp_part
    assert joint().mlp_image is not joint().mlp_part


def test_the_papers_trunk_has_24_cross_and_8_self_blocks() -> None:
    assert Trunk().layout == "XXXS" * 8
    assert dataclasses.replace(Trunk(), blocks=8, scope="alternate").layout == "XXXWXXXS"
    assert dataclasses.replace(Trunk(), blocks=5, pattern="SX", scope="alternate").layout == "SXWXS"


def test_cross_attention_that_nobody_reads_is_refused() -> None:
    with pytest.raises(ModelError, match="XXXSXX end in cross-attention"):
        Trunk(blocks=6)
    assert Trunk(blocks=6, direction="part_from_image").layout == "XXXSXX"


@pytest.mark.parametrize("direction", get_args(Direction))
def test_every_weight_of_the_trunk_matters(direction: Direction) -> None:
    trunk = dataclasses.replace(TRUNK, direction=direction, scope="alternate", blocks=8)
    blocks = TrunkBlocks(trunk).double()
    blocks(*streams(), held((3, 4)))[1].square().sum().backward()
    for name, weights in blocks.named_parameters():
        assert weights.grad is not None, name
        assert (weights.grad != 0.0).any(), name


def test_recomputing_blocks_gives_the_same_slopes() -> None:
    slopes = []
    for recompute in (False, True):
        torch.manual_seed(2)
        blocks = TrunkBlocks(dataclasses.replace(TRUNK, recompute=recompute)).double()
        image, part = (x.requires_grad_() for x in streams())
        blocks(image, part, held((3, 4)))[1].square().sum().backward()
        slopes.append((image.grad, part.grad))
    assert torch.equal(slopes[0][0], slopes[1][0])
    assert torch.equal(slopes[0][1], slopes[1][1])


@pytest.mark.parametrize("direction", get_args(Direction))
def test_slopes_are_right(direction: Direction) -> None:
    """Of two blocks of one image of two tokens and two slots of one, the second slot empty."""
    trunk = Trunk(width=4, blocks=2, heads=2, pattern="XS", mlp_ratio=1.0, direction=direction)
    torch.manual_seed(3)
    blocks = TrunkBlocks(trunk).double()
    image = torch.randn(1, 1, 2, 4, dtype=torch.float64, requires_grad=True)
    part = torch.randn(1, 2, 1, 4, dtype=torch.float64, requires_grad=True)
    valid = torch.tensor([[True, False]])
    assert torch.autograd.gradcheck(lambda i, p: blocks(i, p, valid)[1], (image, part))
