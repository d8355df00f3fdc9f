"""`artgen train` and `artgen ship`: one dataclass each, which is the option list and the help."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import tyro
from rich.console import Console

from artgen.core.errors import UsageError
from artgen.core.jsonio import canonical_json
from model.config import Config, Size
from model.training.recipes import RECIPES
from model.training.settings import changed

Recipe = Literal["debug", "static_pretrain", "multiview", "monocular"]


@dataclass(frozen=True, kw_only=True)
class Train:
    """Train the Articulated Reconstruction Transformer on objects made from seeds.

    RECIPE says what is learned: debug (one minute on a CPU), static_pretrain (parts at rest, as
    the paper begins), multiview (two states from four sides, of nano from two), monocular (two
    states from one side each). An interrupted run resumes: the same command again continues behind
    the newest checkpoint and ends in the same weights. The folder receives config.json,
    checkpoints, log.jsonl, curves for TensorBoard, rendered pictures, and art.safetensors, the file
    that `artgen reconstruct` reads. docs/train_art.md says what a run costs and brings.

    For example:

    artgen train debug

    artgen train multiview --size nano --objects 2000 --set train.steps=8000 data.batch=16

    artgen train multiview --library lib.npz --shards renders/shards --shard-share 0.2

    torchrun --nproc-per-node 8 --no-python -- artgen train multiview --size s --library lib.npz
    """

    recipe: Annotated[Recipe, tyro.conf.arg(metavar="RECIPE"), tyro.conf.Positional] = "debug"
    """What is learned."""
    size: Size = "nano"
    """How large the network is: nano for a CPU, s for one GPU, paper for many."""
    out: Path | None = None
    """Folder of the run; out/train/RECIPE_SIZE if not given."""
    categories: tuple[str, ...] = ()
    """Objects to make from seeds; all that `artgen categories` lists when none is named."""
    objects: int = 64
    """How many objects to make, dealt out to the categories in turn."""
    library: Path | None = None
    """Read objects from this file instead of making them; `artgen train-data` writes one."""
    shards: tuple[Path, ...] = ()
    """Folders of rendered shards to learn from, mixed with --library if that is given."""
    shard_share: float | None = None
    """Share of what is shown that comes from --shards, such as 0.2, where --library or --categories
    gives objects as well; by their numbers if not given, a hundredth at least."""
    scenes: int | None = None
    """Show every object in this many scenes, kept on disk until the run is done, instead of a new
    one each time: half the work on a CPU, less variety. What comes twenty times is learned by
    heart."""
    start: Path | None = None
    """Begin with the weights of this file: art.safetensors of another run, or a checkpoint."""
    set: tuple[str, ...] = ()
    """Settings to change, such as train.steps=2000, data.batch=16 or weights.motion=50;
    --settings lists all."""
    settings: bool = False
    """Print every setting as JSON and stop."""
    device: Literal["auto", "cpu", "cuda"] = "auto"
    """Where to compute."""
    plan: Literal["replicas", "shards"] = "replicas"
    """With torchrun: every process holds all weights (DDP), or a share of them (FSDP2)."""


def train(argv: Sequence[str]) -> int:
    """Train the reconstruction network; resumes where it was interrupted."""
    command = tyro.cli(Train, args=argv, prog="artgen train")
    config = changed(RECIPES[command.recipe](command.size), command.set)
    if command.settings:
        Console().print_json(config.to_json())
        return 0
    if command.objects < 1:
        raise UsageError(f"--objects {command.objects}: at least 1")
    _train(command, config)
    return 0


def _train(command: Train, config: Config) -> None:
    # Torch takes seconds to import: --help and wrong settings are told without it.
    from model.training.material import Material, library_of
    from model.training.session import run_session

    material = Material(
        categories=command.categories,
        objects=command.objects,
        library=command.library,
        shards=command.shards,
        scenes=command.scenes,
        shard_share=command.shard_share,
    )
    network = run_session(
        config,
        material,
        command.out or Path("out/train") / f"{command.recipe}_{command.size}",
        start=command.start,
        device=command.device,
        plan=command.plan,
        environment=os.environ,
    )
    if os.environ.get("RANK", "0") == "0":
        objects = library_of(material, network.parent) or command.shards[0]
        Console(soft_wrap=True).print(
            *last_words(network, config, objects), sep="\n", markup=False, highlight=False
        )


def last_words(network: Path, config: Config, objects: Path) -> Iterator[str]:
    """Where the result of a run lies and what it is for, a line each.

    Args:
        objects: library or shards that it learned from, whose held-out objects can judge it.
    """
    yield f"network: {network}, after update {config.train.steps:,}"
    yield f"curves: tensorboard --logdir {network.parent}"
    yield f"score it: artgen evaluate {network} --truth {objects}"
    yield f"use it: artgen reconstruct IMAGES --checkpoint {network}"


@dataclass(frozen=True, kw_only=True)
class Ship:
    """Show the model card of a network file, or write a copy with what an evaluation measured.

    For example:

    artgen ship out/train/multiview_nano/art.safetensors

    artgen ship art.safetensors --metrics out/evaluation/evaluation.json --out art_nano.safetensors
    """

    network: Annotated[Path, tyro.conf.arg(metavar="FILE"), tyro.conf.Positional]
    """Network file, such as art.safetensors of a training run or one of its checkpoints."""
    metrics: Path | None = None
    """evaluation.json of `artgen evaluate`; its means over all objects go into the card."""
    limits: tuple[str, ...] = ()
    """Sentences about what the network cannot do, added to the card."""
    out: Path | None = None
    """The copy to write; nothing is written if not given, and nothing overwritten."""


def ship(argv: Sequence[str]) -> int:
    """Show a network's model card, or write a copy with measured metrics."""
    command = tyro.cli(Ship, args=argv, prog="artgen ship")
    if command.out is not None and command.out.exists():
        raise UsageError(f"{command.out}: exists; name another --out")
    from model.training.art_file import carded, load_art, save_art, stored_type
    from model.training.run_state import trained_state

    art, config, found = load_art(command.network)
    card = carded(found, metrics=command.metrics, limits=command.limits)
    Console().print_json(canonical_json(card))
    if command.out is not None:
        save_art(command.out, art, config, card, stored=stored_type(trained_state(art)))
    return 0
