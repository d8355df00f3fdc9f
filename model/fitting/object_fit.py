"""One object fitted to its own images: the baseline that learns from no other objects.

After PARIS (Liu, Mahdavi-Amiri, Savva, ICCV 2023): fields of all parts and the joints between
states are optimized together until the composed images agree. Here the fields are ART's
hexa-planes of signed distance, and several guesses of the joints run side by side, of which the
worse half is dropped now and then. The first state is taken for rest, for images do not tell what
closed is.

Letters: G guesses (objects of one batch), P parts, R rays, N points, digits a length.
"""

from collections.abc import Callable
from dataclasses import dataclass

import torch
from torch import Tensor

from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation, Images
from model.config import FieldConfig
from model.field.plane_field import PlaneField
from model.field.rays import Growth, half_sides
from model.field.slopes import slopes, steepness
from model.field.volume import render_along
from model.fitting.carving import hull_bounds
from model.fitting.fit_guess import Guess, tight
from model.fitting.fit_rays import Pixels, pixels_of

REGULAR_POINTS = 128
"""Points of a step at which fields are held to be plausible."""
SMOOTHING = 0.05
"""Weight of the newest loss in the mean that guesses are compared by."""


@dataclass(frozen=True, kw_only=True)
class FitConfig:
    """How an object is fitted.

    Attributes:
        steps: updates.
        guesses: joints drawn at first; halved at even steps over the first half, until one is left.
        rays: pixels of a step.
        samples, coarse: as of `render_along`.
        plane_px, channels: of the hexa-planes.
        field: of the networks.
        inverse_beta: at the first and the last step, linear in between, 1 / radii.
        learning_rate: of planes and networks.
        joint_rate: of joints.
        motion: first guess of |S|, in a drawn direction.
        slope_weight: of the term that makes the field a distance.
        shared_weight: of matter that two parts claim.
        moving_weight: of matter in moving parts, for what could stand still should.
        mask_weight: of coverage beside color.
        tight_cells: resolution at which boxes are measured in the end.
    """

    steps: int = 600
    guesses: int = 4
    rays: int = 768
    samples: int = 16
    coarse: int = 24
    plane_px: int = 32
    channels: int = 8
    field: FieldConfig = FieldConfig(  # noqa: RUF009 (frozen)
        hidden=32, layers=1, bias="smallest_side", octant_blend=0.1
    )
    inverse_beta: tuple[float, float] = (15.0, 120.0)
    learning_rate: float = 0.02
    joint_rate: float = 0.005
    motion: float = 0.02
    slope_weight: float = 0.02
    shared_weight: float = 0.3
    moving_weight: float = 0.03
    mask_weight: float = 1.0
    tight_cells: int = 48


@dataclass(frozen=True, kw_only=True)
class ObjectFit:
    """What was found.

    Attributes:
        field: of one object.
        articulation: boxes as the field has them, the whole object's for every part.
        layout: the same joints in canonical form, with boxes as tight as the surfaces; parts whose
            field is empty are not valid.
        loss: of the last steps.
    """

    field: PlaneField
    articulation: Articulation
    layout: Articulation
    loss: float


def fit_object(
    images: Images,
    parts: int,
    config: FitConfig,
    stream: Stream,
    *,
    index: int = 0,
    types: tuple[int, ...] | None = None,
    told: Callable[[str], None] = lambda note: None,
) -> ObjectFit:
    """Fit object `index` of the images.

    Args:
        parts: P, base included.
        types: joint types of all parts, FIXED for the base; None draws both for every part.
        told: hears of every step.

    Raises:
        ModelError: no foreground, or types that do not fit the parts.
    """
    _check_types(parts, types)
    pixels = pixels_of(images, index)
    guess = Guess(
        hull_bounds(images, index=index),
        parts=parts,
        states=pixels.states,
        guesses=config.guesses,
        plane_px=config.plane_px,
        channels=config.channels,
        field=config.field,
        motion=config.motion,
        types=types,
        stream=stream,
    ).to(images.alpha_BTVHW.device)
    loss = _optimized(guess, pixels, config, stream, told)
    with torch.no_grad():
        field, articulation = guess.field(), guess.articulation()
        return ObjectFit(
            field=field,
            articulation=articulation,
            layout=tight(field, articulation, config.tight_cells),
            loss=loss,
        )


def _check_types(parts: int, types: tuple[int, ...] | None) -> None:
    if types is None:
        return
    if len(types) != parts or types[0] != FIXED or set(types[1:]) - {PRISMATIC, REVOLUTE}:
        raise ModelError(
            f"types {types} of {parts} parts: expected one a part, {FIXED} for the base and "
            f"{REVOLUTE} (revolute) or {PRISMATIC} (prismatic) for the others"
        )


def _optimized(
    guess: Guess,
    pixels: Pixels,
    config: FitConfig,
    stream: Stream,
    told: Callable[[str], None],
) -> float:
    """The loss at the end; the guess that is left is changed in place, as optimizers do."""
    generator = torch.Generator().manual_seed(int(stream.child("rays").generator().integers(2**31)))
    rounds = config.guesses.bit_length()
    optimizer, mean_G = _optimizer(guess, config), torch.full((config.guesses,), torch.nan)
    for step in range(config.steps):
        if len(mean_G) > 1 and step == _halving(config, rounds - len(mean_G).bit_length()):
            kept = mean_G.argsort()[: len(mean_G) // 2].sort().values
            guess.keep(kept)
            optimizer, mean_G = _optimizer(guess, config), mean_G[kept]
        loss_G = losses(guess, pixels, config, step / config.steps, generator)
        optimizer.zero_grad()
        torch.autograd.backward(loss_G.sum())
        optimizer.step()
        newest_G = loss_G.detach().cpu()
        mean_G = torch.where(mean_G.isnan(), newest_G, torch.lerp(mean_G, newest_G, SMOOTHING))
        told(f"loss {mean_G.min():.4f}")
    return float(mean_G.min())


def _halving(config: FitConfig, done: int) -> int:
    """The step at which guesses are halved for the time after `done`."""
    rounds = max(config.guesses.bit_length() - 1, 1)
    return round(0.5 * config.steps * (done + 1) / rounds)


def _optimizer(guess: Guess, config: FitConfig) -> torch.optim.Optimizer:
    joints = [guess.twist_GP3, guess.origin_GP3, guess.share_GTP]
    shapes = [guess.planes_GP6CHW, *guess.head.parameters()]
    return torch.optim.Adam(
        [
            {"params": shapes, "lr": config.learning_rate},
            {"params": joints, "lr": config.joint_rate},
        ],
        betas=(0.9, 0.99),
    )


def losses(
    guess: Guess, pixels: Pixels, config: FitConfig, passed: float, generator: torch.Generator
) -> Tensor:
    """(G,) loss of every guess on rays drawn anew.

    Args:
        passed: share of the steps that is over.
    """
    articulation, field = guess.articulation(), guess.field()
    guesses = len(articulation.type_BP)
    drawn_R = pixels.drawn(config.rays, generator)
    first, last = config.inverse_beta
    seen = render_along(
        field,
        articulation,
        pixels.origin_M3[drawn_R].expand(guesses, -1, -1),
        pixels.direction_M3[drawn_R].expand(guesses, -1, -1),
        pixels.state_M[drawn_R].expand(guesses, -1),
        inverse_beta=first + (last - first) * passed,
        samples=config.samples,
        coarse=config.coarse,
        generator=generator if pixels.alpha_M.device.type == "cpu" else None,
    )
    rgb_G = (seen.rgb_BR3 - pixels.rgb_M3[drawn_R]).square().sum(dim=-1).mean(dim=-1)
    mask_G = (seen.alpha_BR - pixels.alpha_M[drawn_R]).square().mean(dim=-1)
    return rgb_G + config.mask_weight * mask_G + _regular(field, articulation, config, generator)


def _regular(
    field: PlaneField, articulation: Articulation, config: FitConfig, generator: torch.Generator
) -> Tensor:
    """(G,) what keeps fields plausible where images say nothing: distances have slope 1, no place
    belongs to two parts at rest, and moving parts hold no more than they must.

    All parts have one box, so one point is asked of all of them.
    """
    guesses, parts = articulation.type_BP.shape
    device = articulation.size_BP3.device
    drawn = torch.rand(guesses, 1, REGULAR_POINTS, 3, generator=generator).to(device) * 2.0 - 1.0
    points_KN3 = drawn.expand(-1, parts, -1, -1).flatten(0, 1)
    slot_K = torch.arange(guesses * parts, device=device)
    half_S3 = half_sides(articulation.size_BP3, Growth()).flatten(0, 1)
    steep = steepness(slopes(field, points_KN3, slot_K, half_S3))
    distance_GPN = field.distances(points_KN3, slot_K).reshape(guesses, parts, -1)
    held_GPN = torch.sigmoid(-distance_GPN * config.inverse_beta[0])
    shared_G = (held_GPN.sum(dim=1) - 1.0).clamp(min=0.0).mean(dim=-1)
    moving_G = held_GPN[:, 1:].sum(dim=1).mean(dim=-1)
    return (
        config.slope_weight * steep
        + config.shared_weight * shared_G
        + config.moving_weight * moving_G
    )
