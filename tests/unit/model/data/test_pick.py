import dataclasses

import numpy as np
import torch

from artgen.core.stream import Stream
from model.data.config import DataConfig
from model.data.pick import picked, ray_draws

CONFIG = DataConfig(rays=4000, target_px=32, dilation_px=1, batch=1)


def _masks() -> torch.Tensor:
    """(1, 2, 3, 32, 32): a large part, a diagonal line seen in the second image, a hidden part."""
    masks = torch.zeros(1, 2, 3, 32, 32, dtype=torch.bool)
    masks[0, :, 0, 4:28, 6:30] = True
    masks[0, 1, 1, torch.arange(10, 20), torch.arange(10, 20)] = True
    return masks


def _picked(config: DataConfig) -> tuple[np.ndarray, np.ndarray]:
    draws = torch.from_numpy(ray_draws(config, Stream(0)))[None]
    image, pixel = picked(_masks(), draws, config)
    return image[0].numpy(), pixel[0].numpy()


def test_every_part_that_is_seen_is_as_likely():
    """Two of three visible masks lie in the second image, and the line gets a third of all rays."""
    image, pixel = _picked(dataclasses.replace(CONFIG, mask_share=1.0))
    # 4,000 draws of 2/3: deviation 0.0075; four of them.
    assert abs((image == 1).mean() - 2 / 3) < 0.03
    row, column = pixel // 32, pixel % 32
    near = (image == 1) & (np.abs(row - column) <= 2) & (row > 8) & (row < 21)
    line = 1 / 3 + 1 / 3 * 54 / 676  # ... and what of the large part's mask falls there.
    assert abs(near.mean() - line) < 0.035


def test_mask_rays_stay_in_the_dilated_mask():
    image, pixel = _picked(dataclasses.replace(CONFIG, mask_share=1.0))
    row, column = pixel // 32, pixel % 32
    assert ((row >= 3) & (row < 29) & (column >= 5) & (column < 31)).all()
    assert set(image) == {0, 1}


def test_box_rays_fill_the_box_of_a_part():
    image, pixel = _picked(dataclasses.replace(CONFIG, mask_share=0.0))
    row, column = pixel // 32, pixel % 32
    off = (image == 1) & (np.abs(row - column) > 6) & (row >= 9) & (row < 21) & (column < 21)
    assert off.sum() > 100
    assert ((row >= 3) & (row < 29) & (column >= 5) & (column < 31)).all()


def test_patches_are_whole_and_inside():
    config = dataclasses.replace(CONFIG, rays=640, patch_px=8)
    image, pixel = _picked(config)
    row, column = (pixel // 32).reshape(-1, 8, 8), (pixel % 32).reshape(-1, 8, 8)
    assert (np.diff(row, axis=1) == 1).all()
    assert (np.diff(column, axis=2) == 1).all()
    assert row.min() >= 0
    assert row.max() < 32
    assert (np.ptp(image.reshape(-1, 64), axis=1) == 0).all()


def test_items_do_not_touch_each_other():
    masks = torch.cat([_masks(), _masks().flip(3)])
    draws = torch.from_numpy(ray_draws(CONFIG, Stream(1)))[None].repeat(2, 1, 1)
    image, pixel = picked(masks, draws, CONFIG)
    for k in range(2):
        alone = picked(masks[k : k + 1], draws[:1], CONFIG)
        assert torch.equal(image[k], alone[0][0])
        assert torch.equal(pixel[k], alone[1][0])


def test_the_largest_draw_stays_among_what_is_seen():
    draws = torch.full((1, 1, 4), 1.0 - 2.0**-24)
    image, pixel = picked(_masks(), draws, dataclasses.replace(CONFIG, mask_share=1.0))
    assert image.item() == 1
    assert pixel.item() // 32 == 20  # The last pixel of the line, dilated by one.
