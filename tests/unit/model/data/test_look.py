import numpy as np
import torch

from artgen.core.stream import Stream
from artgen.core.surface import linear_from_srgb
from model.data.look import LIGHTS, Lighting, drawn_look, encoded, shaded

UP = torch.tensor([[0.0, 0.0, 1.0]])
WHITE = torch.tensor([[1.0, 1.0, 1.0, 1.0, 0.0, 0.0]])


def _lights(power: float, sky: float, ground: float) -> Lighting:
    toward = torch.zeros(1, LIGHTS, 3)
    toward[..., 2] = 1.0
    strength = torch.zeros(1, LIGHTS, 3)
    strength[:, 0] = power
    return Lighting(
        toward_BL3=toward,
        power_BL3=strength,
        sky_B3=torch.full((1, 3), sky),
        ground_B3=torch.full((1, 3), ground),
    )


def _shown(look: torch.Tensor, normal: torch.Tensor, lights: Lighting) -> float:
    """Linear light that leaves a point seen edge on, where nothing is mirrored to the eye."""
    sight = torch.tensor([[1.0, 0.0, 0.0]])
    color = shaded(look, normal, sight, lights, torch.zeros(1, dtype=torch.int64))
    return linear_from_srgb(float(color[0, 0]))


def test_the_sky_lights_what_looks_up_and_the_ground_what_looks_down():
    lights = _lights(0.0, 0.4, 0.1)
    # A dielectric mirrors 4 % of what is around it on top of its own color.
    assert abs(_shown(WHITE, UP, lights) - 1.04 * 0.4) < 1e-5
    assert abs(_shown(WHITE, -UP, lights) - 1.04 * 0.1) < 1e-5


def test_a_light_shows_by_the_cosine_and_never_from_behind():
    gray = torch.tensor([[0.3, 0.3, 0.3, 0.15, 0.0, 0.0]])
    lights = _lights(1.0, 0.0, 0.0)
    for angle in (0.0, 0.7, 1.2):
        normal = torch.tensor([[0.0, np.sin(angle), np.cos(angle)]], dtype=torch.float32)
        # The lobe adds at most 4 % of its height, 11.4, at the angle to the halfway vector.
        assert 0.3 * np.cos(angle) - 1e-5 <= _shown(gray, normal, lights)
    assert abs(_shown(gray, -UP, lights)) < 1e-6


def test_metal_has_no_color_of_its_own_in_the_dark_and_screens_shine():
    dark = _lights(0.0, 0.0, 0.0)
    assert _shown(torch.tensor([[0.5, 0.5, 0.5, 0.3, 1.0, 0.0]]), UP, dark) == 0.0
    assert abs(_shown(torch.tensor([[0.5, 0.5, 0.5, 0.3, 0.0, 1.0]]), UP, dark) - 0.5) < 1e-5


def test_encoding_is_srgb():
    values = np.linspace(0.0, 1.0, 50)
    back = [linear_from_srgb(float(v)) for v in encoded(torch.tensor(values))]
    np.testing.assert_allclose(back, values, atol=1e-7)
    np.testing.assert_allclose(encoded(torch.tensor([-1.0, 7.0])), [0.0, 1.0], atol=1e-7)


def test_looks_differ_between_items_and_not_between_calls():
    one, same, other = (drawn_look(5, Stream(0, k)) for k in ("a", "a", "b"))
    assert np.array_equal(one.gains, same.gains)
    assert np.array_equal(one.toward, same.toward)
    assert not np.array_equal(one.power, other.power)
    np.testing.assert_allclose(np.linalg.norm(one.toward, axis=1), 1.0)
    assert one.gains.shape == (5, 3)
    assert (one.gains > 0.0).all()
