"""Pixels as rays: colors without background, half of the draws on the object."""

import torch

from model.field.pictures import pictures
from model.fitting.fit_rays import pixels_of
from tests.unit.model.fit_scenes import drawer, photographs


def test_pixels_are_the_images_without_their_background() -> None:
    """The background is the mean of pixels with alpha below 0.01, so off by that at most."""
    articulation, field = drawer()
    images = photographs(articulation, field, 12)
    pixels = pixels_of(images, 0)
    again = pictures(
        *(field, articulation, images.intrinsics_BTV33, images.camera_from_world_BTV44),
        height=12,
        width=12,
        inverse_beta=400.0,
        samples=32,
    )
    expected = again.rgb_BTV3HW[0].movedim(2, -1).reshape(-1, 3)
    torch.testing.assert_close(pixels.rgb_M3, expected, rtol=0, atol=0.01)
    assert torch.equal(pixels.alpha_M, images.alpha_BTVHW.flatten())
    assert pixels.state_M.bincount().tolist() == [5 * 144, 5 * 144]
    assert pixels.states == 2


def test_half_of_the_rays_show_the_object() -> None:
    articulation, field = drawer()
    pixels = pixels_of(photographs(articulation, field, 12), 0)
    drawn = pixels.drawn(200, torch.Generator().manual_seed(0))
    assert len(drawn) == 200
    assert (pixels.alpha_M[drawn[:100]] > 0.01).all()
    everywhere = (pixels.alpha_M[drawn[100:]] > 0.01).float().mean()
    share = (pixels.alpha_M > 0.01).float().mean()
    # Three deviations of 100 draws.
    assert abs(everywhere - share) < 0.15
