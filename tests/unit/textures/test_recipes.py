import hashlib
from pathlib import Path

import numpy as np
import pytest

from artgen import textures
from artgen.core.errors import UsageError
from artgen.core.surface import SurfaceSpec
from artgen.rules.load import rules_folder
from artgen.rules.surfaces import load_palette, surface_spec
from artgen.textures import RECIPES, TextureSet, texture_set
from artgen.textures.atlas import LINEAR
from artgen.textures.screen import KINDS
from artgen.textures.wood import SPECIES, srgb_levels

PALETTE = load_palette(rules_folder())
TILES = ["oak_natural", "walnut", "wenge", "stainless_brushed", "aluminium_silver",
         "plastic_black_matte", "rubber_black", "enamel_white", "mdf_white"]  # fmt: skip
PIXELS = {
    "anodized": "04234e1502ed",
    "brushed": "dd41f9da9ffb",
    "enamel": "2caf28f58257",
    "paint": "de0e9fdeaa24",
    "plastic": "4d4bd5f5da11",
    "rubber": "cac1b5992354",
    "wood": "61284a6aee1e",
}
"""First digits of the sha256 of all images. If a change of a recipe is meant, write the new digits
here and raise `artgen.textures.VERSION`. Screens are left out: Pillow's font rasterizer draws on
them."""


def palette_set(name):
    return texture_set(surface_spec(name, PALETTE[name]))


def images_of(looks: TextureSet):
    found = (looks.color, looks.roughness, looks.normal, looks.emission)
    return [image for image in found if image is not None]


def test_every_palette_entry_names_a_recipe():
    """In the table, or as a module of its name."""
    folder = Path(textures.__file__).parent
    for recipe in {entry["recipe"] for entry in PALETTE.values()} - set(RECIPES):
        assert (folder / f"{recipe}.py").is_file(), recipe


@pytest.mark.parametrize("name", TILES)
def test_tiles_repeat_without_a_seam(name):
    """The mean step across the seam is no larger than the largest mean step between two
    neighbouring rows or columns inside."""
    for image in images_of(palette_set(name)):
        field = image.astype(float).reshape(*image.shape[:2], -1)
        for axis in (0, 1):
            steps = np.abs(field - np.roll(field, 1, axis=axis)).sum(axis=2).mean(axis=1 - axis)
            assert steps[0] <= steps[1:].max()


@pytest.mark.parametrize("recipe", sorted(PIXELS))
def test_images_are_the_same_on_every_machine(recipe):
    digest = hashlib.sha256()
    for image in images_of(texture_set(SurfaceSpec(name="s", recipe=recipe))):
        digest.update(image.tobytes())
    assert digest.hexdigest()[:12] == PIXELS[recipe]


@pytest.mark.parametrize("species", sorted(SPECIES))
def test_the_color_of_wood_is_its_mean(species):
    """Rounding moves a texel by at most half an sRGB step, 0.5 / 255 times the curve's largest
    slope of 2.28 in linear light."""
    spec = SurfaceSpec(name="w", recipe="wood", color=(0.35, 0.22, 0.12), tile=(0.96, 0.4),
                       detail={"species": species})  # fmt: skip
    mean = LINEAR[texture_set(spec).color].mean(axis=(0, 1))
    assert np.abs(mean - spec.color).max() <= 0.5 / 255.0 * 2.28


@pytest.mark.parametrize("species", sorted(SPECIES))
def test_the_grain_of_wood_runs_along_u(species):
    """Walking 9.4 mm along the grain changes the wood less than walking as far across it."""
    spec = SurfaceSpec(name="w", recipe="wood", tile=(0.96, 0.4), detail={"species": species})
    tone = texture_set(spec).color.astype(float).sum(axis=2)
    lengths = 5, 12  # texels of 1.88 and 0.78 mm
    along = np.abs(tone - np.roll(tone, lengths[0], axis=1)).mean()
    across = np.abs(tone - np.roll(tone, lengths[1], axis=0)).mean()
    assert along < across


def test_leaves_of_one_species_differ_by_seed():
    looks = [
        texture_set(SurfaceSpec(name="w", recipe="wood", detail={"seed": seed})).color
        for seed in (1, 2)
    ]
    assert np.abs(looks[0].astype(float) - looks[1].astype(float)).mean() > 1.0


def test_brushing_tilts_normals_across_the_grain():
    normal = palette_set("stainless_brushed").normal.astype(float)
    assert normal[..., 1].std() > 5.0 * normal[..., 0].std()


@pytest.mark.parametrize("name", [n for n in TILES if PALETTE[n]["recipe"] != "wood"])
def test_normals_are_unit_vectors_about_plus_z(name):
    """Rounding to 1/127 moves a component by 1/254, the length by less than twice that; a tilt that
    is left on average would turn the whole surface."""
    normal = (palette_set(name).normal.astype(float) - 128.0) / 127.0
    assert np.abs(np.linalg.norm(normal, axis=2) - 1.0).max() <= 2.0 / 254.0
    assert np.abs(normal[..., :2].mean(axis=(0, 1))).max() <= 2.0 / 254.0


def test_srgb_and_back_is_exact_for_every_level():
    assert np.array_equal(srgb_levels(LINEAR), np.arange(256))


@pytest.mark.parametrize("kind", sorted(KINDS))
def test_screens_glow_and_differ_by_seed(kind):
    def shown(seed):
        detail = {"kind": kind, "seed": seed}
        return texture_set(SurfaceSpec(name="s", recipe="screen", detail=detail)).emission

    assert np.array_equal(shown(1), shown(1))
    assert not np.array_equal(shown(1), shown(2))
    height, width, _ = shown(1).shape
    assert width * 10 == height * 16
    assert shown(1).std() > 15.0  # a picture, not a flat field


@pytest.mark.parametrize(
    ("spec", "words"),
    [
        (SurfaceSpec(name="front", recipe="wod"), "front: there is no texture recipe 'wod'"),
        (SurfaceSpec(name="top", recipe="wood", detail={"species": "elm"}), "top: no wood 'elm'"),
        (SurfaceSpec(name="lit", recipe="screen", detail={"kind": "tv"}), "lit: no screen 'tv'"),
    ],
)
def test_unknown_names_are_refused(spec, words):
    with pytest.raises(UsageError, match=words):
        texture_set(spec)


def test_images_of_a_wrong_type_are_refused():
    with pytest.raises(UsageError, match="normal image is float64"):
        TextureSet(normal=np.zeros((4, 4, 3)))
    with pytest.raises(UsageError, match=r"roughness image is uint8 \(4, 4, 3\)"):
        TextureSet(roughness=np.zeros((4, 4, 3), np.uint8))
