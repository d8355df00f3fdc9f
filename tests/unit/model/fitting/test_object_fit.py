"""One object fitted to its own images: masks agree, and the same twice."""

import dataclasses

import pytest
import torch

from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from model.batch import FIXED, PRISMATIC
from model.config import FieldConfig
from model.field.pictures import pictures
from model.fitting.object_fit import FitConfig, fit_object
from tests.unit.model.fit_scenes import drawer, photographs

TINY = FitConfig(
    steps=4,
    guesses=4,
    rays=32,
    samples=4,
    coarse=4,
    plane_px=4,
    channels=2,
    field=FieldConfig(hidden=4, layers=1),
    tight_cells=8,
)


def overlap(one: torch.Tensor, other: torch.Tensor) -> float:
    """Pixels of both over pixels of either."""
    return ((one & other).sum() / (one | other).sum()).item()


def test_a_drawer_is_fitted_in_seconds() -> None:
    """Two states by five views of 24 px: mask IoU above 0.9 over all. So few pixels do not tell the
    joint; that the second state's mask is met better than the first's would meet it shows that the
    drawer moves."""
    px = 24
    articulation, field = drawer()
    images = photographs(articulation, field, px)
    config = FitConfig(steps=140, guesses=1, rays=384, samples=10, coarse=16, plane_px=16)
    fit = fit_object(images, 2, config, Stream(0, "fit"), types=(FIXED, PRISMATIC))
    seen = pictures(
        *(fit.field, fit.articulation, images.intrinsics_BTV33, images.camera_from_world_BTV44),
        height=px,
        width=px,
        inverse_beta=config.inverse_beta[1],
        samples=24,
        coarse=24,
    )
    found, true = seen.alpha_BTVHW > 0.5, images.alpha_BTVHW > 0.5
    assert overlap(found, true) > 0.9
    assert overlap(found[:, 1], true[:, 1]) > overlap(true[:, 0], true[:, 1])
    assert fit.layout.motion_BTP[0, 0, 1] == 0.0
    assert fit.layout.motion_BTP[0, 1, 1] > 0.03


def test_fits_repeat_and_halve_their_guesses() -> None:
    """Four guesses become one by the middle; every step is told."""
    articulation, field = drawer()
    images = photographs(articulation, field, 10)
    told: list[str] = []
    runs = [
        fit_object(
            images, 2, TINY, Stream(3, "fit"), told=told.append if k == 0 else lambda _: None
        )
        for k in range(2)
    ]
    assert len(told) == TINY.steps
    assert runs[0].articulation.type_BP.shape == (1, 2)
    assert runs[0].loss == runs[1].loss
    assert torch.equal(runs[0].layout.axis_BP3, runs[1].layout.axis_BP3)


def test_wrong_types_are_told() -> None:
    articulation, field = drawer()
    images = photographs(articulation, field, 10)
    for types in ((FIXED,), (PRISMATIC, PRISMATIC), (FIXED, FIXED)):
        with pytest.raises(ModelError, match="expected one a part"):
            fit_object(images, 2, TINY, Stream(0, "fit"), types=types)


def test_an_object_of_a_batch() -> None:
    articulation, field = drawer()
    images = photographs(articulation, field, 10)
    both = images.mapped(lambda value: torch.cat([torch.zeros_like(value), value]))
    config = dataclasses.replace(TINY, guesses=1)
    alone = fit_object(images, 2, config, Stream(0, "fit"))
    second = fit_object(both, 2, config, Stream(0, "fit"), index=1)
    assert second.loss == alone.loss
