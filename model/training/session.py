"""One training session in its folder: objects in, network file out, interrupted or not."""

import dataclasses
import json
import logging
import platform
import shutil
from collections.abc import Iterator, Mapping
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from artgen.core.errors import UsageError
from artgen.core.jsonio import file_hash, plain, write_json
from artgen.progress import Show, progress
from artgen.run_folder import locked
from model.batch import Batch
from model.config import Config
from model.data.items import Source
from model.data.loader import batches
from model.network.art import Art
from model.precision import flushed_denormals
from model.training.art_file import (
    ModelCard,
    load_art,
    load_weights,
    network_weights,
    save_art,
    stored_type,
)
from model.training.distributed import (
    Plan,
    Team,
    joined,
    wait_for_all,
    wait_for_leader,
    whole,
)
from model.training.idle import idle_line, idle_terms
from model.training.material import (
    SCENES,
    Material,
    make_missing,
    material_hashes,
    opened,
    stated_origin,
)
from model.training.objective import Objective
from model.training.perceptual import FeatureDistance, packaged_distance
from model.training.picture import OBJECTS, picture_of
from model.training.run_state import Run, begun, differences, resume, trained_state
from model.training.schedule import Moment
from model.training.train import Draw, Supply, train

log = logging.getLogger(__name__)

RESULT = "art.safetensors"
LIMITS = (
    "Learned from procedural objects shown by a ray caster; not tried on photographs.",
    "Expects the object alone, from known cameras, in two or more states.",
)


def run_session(
    config: Config,
    material: Material,
    folder: Path,
    *,
    environment: Mapping[str, str],
    start: Path | None = None,
    device: str = "auto",
    plan: Plan = "replicas",
    show: Show = progress,
) -> Path:
    """Train, or go on training, in `folder`; the path of the network file.

    Args:
        environment: where `torchrun` says who takes part.
        start: network file, or checkpoint of a run, whose weights to begin with.

    Raises:
        UsageError: the folder holds a run of other settings or other data, or is in use.
        ModelError: data, weights or the training itself failed.
    """
    with flushed_denormals(), joined(environment, device=device, plan=plan) as team:
        if team.leads:
            folder.mkdir(parents=True, exist_ok=True)
        with locked(folder) if team.leads else nullcontext():
            settings = {"config": plain(config), "material": plain(material)}
            _claim(folder / "config.json", settings, team, "other settings")
            art, begun_with = _network(config, start)  # First: wrong weights cost no waiting.
            source = _opened(material, folder, config, team, show)
            perceptual = _perceptual(config, team)
            inputs = {
                **material_hashes(material, folder),
                "start": begun_with and begun_with["sha256"],
                "encoder": art.encoder_identity,
                "perceptual": perceptual is not None,
            }
            _claim(folder / "inputs.json", inputs, team, "other data or weights")
            run = _begun(art, perceptual, config, team, {**settings, "inputs": inputs})
            resume(run, folder)
            supply = _supply(source, config, team)
            train(run, supply, folder=folder, show=show, draw=_draw(art, source, config, team))
            card = _card(source, config, material, run, begun_with)
            _export(run, art, config, card, folder / RESULT)
            wait_for_all(team)
            if team.leads:
                shutil.rmtree(folder / SCENES, ignore_errors=True)
    return folder / RESULT


def _claim(path: Path, ours: Mapping[str, Any], team: Team, what: str) -> None:
    """Write into a new folder what its run depends on, or see that an old one has the same."""
    if team.leads and not path.exists():
        write_json(path, ours)
    wait_for_all(team)
    found = json.loads(path.read_text(encoding="utf-8"))
    if lines := differences(found, plain(ours)):
        raise UsageError(
            f"{path.parent}: holds a run of {what}: {'; '.join(lines[:5])}; give the same ones "
            "to resume, or choose another --out"
        )


def _opened(
    material: Material, folder: Path, config: Config, team: Team, show: Show
) -> Source[Any]:
    """What to learn from; the rank that leads makes what is to be made."""
    if team.leads:
        make_missing(material, folder, config.data, show=show)
    wait_for_leader(team)
    return opened(material, folder, config.data)


def _network(config: Config, start: Path | None) -> tuple[Art, Mapping[str, Any] | None]:
    """The network, and what a card says of the file whose weights it begins with."""
    torch.manual_seed(config.train.seed)
    art = Art(config.model)
    if start is None:
        return art, None
    begun_from, _, card = load_art(start)
    load_weights(art, trained_state(begun_from), start)
    before = {"data": card.data, "steps": card.steps, "hours": card.hours, "on": card.hardware}
    return art, {"file": start.name, "sha256": file_hash(start), **before}


def _perceptual(config: Config, team: Team) -> FeatureDistance | None:
    """The image distance that the settings ask for, where installed; what is left out is told."""
    possible = "part_perceptual" not in idle_terms(config, perceptual=True)
    asked = config.weights.part_perceptual > 0.0 and possible
    distance = packaged_distance() if asked else None
    idle = idle_terms(config, perceptual=distance is not None)
    if idle and team.leads:
        log.warning("%s", idle_line(idle))
    return distance


def _begun(
    art: Art,
    perceptual: FeatureDistance | None,
    config: Config,
    team: Team,
    settings: Mapping[str, Any],
) -> Run:
    objective = Objective(
        art,
        config.weights,
        precision=config.train.precision,
        field_precision=config.train.field_precision,
        perceptual=perceptual,
    )
    return begun(objective, config.train, items=config.data.batch, team=team, settings=settings)


def _supply(source: Source[Any], config: Config, team: Team) -> Supply:
    def supply(moment: Moment, cursor: int) -> Iterator[Batch]:
        data = dataclasses.replace(config.data, target_px=moment.target_px)
        place = {"rank": team.rank, "world": team.world}
        return batches(source, data, cursor, **place, device=team.device)

    return supply


def _draw(art: Art, source: Source[Any], config: Config, team: Team) -> Draw | None:
    """How to show the first objects; not where weights are divided among ranks."""
    if art.planes is None or (team.world > 1 and team.plan == "shards"):
        return None
    few = dataclasses.replace(config.data, batch=min(OBJECTS, config.data.batch), workers=0)

    def draw(moment: Moment) -> NDArray[np.uint8]:
        data = dataclasses.replace(few, target_px=moment.target_px)
        return picture_of(art, next(batches(source, data, device=team.device)), moment)

    return draw


def _card(
    source: Source[Any],
    config: Config,
    material: Material,
    run: Run,
    begun_with: Mapping[str, Any] | None,
) -> ModelCard:
    return ModelCard(
        data={
            "made": stated_origin(material, config.data.seed),
            "library": material.library and material.library.name,
            "shards": [path.name for path in material.shards],
            "shard_share": material.shard_share,
            "split": material.split,
            "scenes": material.scenes,
            "items": len(source),
            "left_out": len(source.left_out),
            "seen": run.cursor,
            "begun_with": begun_with,
        },
        steps=run.step,
        hours=run.seconds / 3600.0,
        hardware=hardware(run.team),
        limits=LIMITS,
    )


def hardware(team: Team) -> str:
    """What computed, for the card."""
    if team.device.type == "cuda":
        return f"{team.world} x {torch.cuda.get_device_name(team.device)}"
    return f"{team.world} x {torch.get_num_threads()} threads of a {platform.machine()} CPU"


def _export(run: Run, art: Art, config: Config, card: ModelCard, path: Path) -> None:
    """Ship the moving average of the weights, in the larger type that stays within the limit."""
    weights = network_weights({name: whole(value) for name, value in run.average.items()})
    if run.team.leads:
        save_art(path, art, config, card, weights=weights, stored=stored_type(weights))
    wait_for_all(run.team)
