"""Materials of GLB and DAE files, as sRGB."""

from pathlib import Path

import numpy as np
import pytest
import trimesh
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from artgen.ingest.meshes.clean import Body
from artgen.ingest.meshes.scenes import read_scene
from artgen.ingest.meshes.soup import Look, Soup
from artgen.ingest.surfaces import surfaces_of

BYTE = 0.5 / 255.0
"""trimesh keeps factors as bytes."""


def read(path: Path, **stated: object) -> Soup:
    mesh = trimesh.creation.box((0.1, 0.2, 0.3))
    mesh.visual = TextureVisuals(material=PBRMaterial(**stated))
    mesh.export(path)
    (instance,) = read_scene(path)
    return instance.soup


@pytest.mark.parametrize("factor", [(0.5, 0.25, 0.01), (0.0, 1.0, 0.75)])
def test_a_factor_of_a_glb_is_linear_and_comes_back(
    factor: tuple[float, float, float], tmp_path: Path
) -> None:
    """It was read as sRGB and made linear once more: 0.5 became 0.216."""
    soup = read(tmp_path / "m.glb", baseColorFactor=[*factor, 1.0])
    (spec,) = surfaces_of([Body(soup=soup, leaf="x", closed=True)]).specs
    # The byte, and 1e-7 of the two curves.
    np.testing.assert_allclose(spec.color, factor, rtol=0.0, atol=BYTE + 1e-6)


def test_a_material_of_a_glb_without_a_factor_is_white(tmp_path: Path) -> None:
    """So says glTF; the curve gives 1 to rounding."""
    (look,) = read(tmp_path / "m.glb", roughnessFactor=0.25).looks
    assert look.color == pytest.approx((1.0, 1.0, 1.0), abs=1e-15)
    assert look.roughness == pytest.approx(0.25, abs=BYTE)


def test_a_color_of_a_dae_is_srgb(tmp_path: Path) -> None:
    mesh = trimesh.creation.box((0.1, 0.2, 0.3))
    mesh.visual.face_colors = [128, 64, 10, 255]
    mesh.export(tmp_path / "m.dae")
    (instance,) = read_scene(tmp_path / "m.dae")
    (look,) = instance.soup.looks
    assert look != Look()
    np.testing.assert_allclose(look.color, np.array([128, 64, 10]) / 255.0, atol=2.0 * BYTE)
