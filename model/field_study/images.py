"""Rendering the study's scene, and how far two renderings are apart."""

from dataclasses import dataclass

import torch
from torch import Tensor

from model.field.plane_field import Field
from model.field.sdf import Quadrature
from model.field.volume import RayColors, render_along
from model.field_study.scene import Scene
from model.field_study.timing import timed

PSNR_MOST = 120.0
"""dB; what equal images are given."""
REFERENCE_SAMPLES = 512


@dataclass(frozen=True, kw_only=True)
class Setting:
    """Options of `render_along` that are studied."""

    samples: int
    coarse: int
    quadrature: Quadrature
    inverse_beta: float


@dataclass(frozen=True, kw_only=True)
class Cost:
    """ms of 1,000 rays that meet a box: without gradient, and with the backward pass."""

    forward_ms: float
    step_ms: float


def rendered(field: Field, scene: Scene, setting: Setting) -> RayColors:
    """All pixels of the scene."""
    return render_along(
        *(field, scene.articulation, scene.origin_BR3, scene.direction_BR3, scene.state_BR),
        inverse_beta=setting.inverse_beta,
        samples=setting.samples,
        coarse=setting.coarse,
        quadrature=setting.quadrature,
    )


@torch.no_grad()
def reference(field: Field, scene: Scene, inverse_beta: float) -> RayColors:
    """The scene with so many samples that more change nothing."""
    setting = Setting(
        samples=REFERENCE_SAMPLES, coarse=0, quadrature="linear", inverse_beta=inverse_beta
    )
    return rendered(field, scene, setting)


def psnr(found: RayColors, true: RayColors) -> float:
    """dB of the whole over white."""
    return _psnr(
        _over_white(found.rgb_BR3, found.alpha_BR), _over_white(true.rgb_BR3, true.alpha_BR)
    )


def part_psnr(found: RayColors, true: RayColors) -> float:
    """dB of parts alone over white."""
    return _psnr(
        _over_white(found.part_rgb_BPR3, found.part_alpha_BPR),
        _over_white(true.part_rgb_BPR3, true.part_alpha_BPR),
    )


def cost(field: Field, scene: Scene, setting: Setting, true: RayColors, device: str) -> Cost:
    """What rendering costs; the field must hold parameters, the loss is against `true`."""
    met = float((true.part_alpha_BPR.sum(dim=1) > 0.0).sum())
    with torch.no_grad():
        _, forward_ms = timed(lambda: rendered(field, scene, setting), device)

    def step() -> None:
        seen = rendered(field, scene, setting)
        torch.autograd.backward(
            (seen.part_rgb_BPR3 - true.part_rgb_BPR3).square().mean()
            + (seen.part_alpha_BPR - true.part_alpha_BPR).square().mean(),
            retain_graph=True,
        )

    _, step_ms = timed(step, device)
    return Cost(forward_ms=1e3 * forward_ms / met, step_ms=1e3 * step_ms / met)


def _over_white(rgb_X3: Tensor, alpha_X: Tensor) -> Tensor:
    return rgb_X3 + 1.0 - alpha_X[..., None]


def _psnr(found: Tensor, true: Tensor) -> float:
    error = (found.detach().double() - true.detach().double()).square().mean().item()
    return min(PSNR_MOST, float(-10.0 * torch.log10(torch.tensor(max(error, 1e-30)))))
