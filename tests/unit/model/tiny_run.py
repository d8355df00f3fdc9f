"""A network of a few weights that draws chance, and batches that follow from the cursor."""

import os
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path

import torch
from torch import Tensor, nn

from artgen.core.stream import Stream
from model.batch import Articulation, Batch, Images
from model.training.checkpoint import Checkpoint, found_checkpoints, read_checkpoint
from model.training.distributed import Team
from model.training.run_state import Run, begun, resume
from model.training.schedule import Moment, TrainConfig
from model.training.train import Supply, train

ITEMS = 4
STEPS = 6
CONFIG = TrainConfig(
    steps=STEPS,
    learning_rate=0.01,
    warmup_steps=2,
    clip_norm=0.5,
    accumulation=2,
    save_every=2,
    log_every=1,
    picture_every=0,
)


class TinyObjective(nn.Module):
    """Box centers out of pixels, under noise; one term each for two halves of the answer."""

    def __init__(self, *, noise: float = 0.1) -> None:
        super().__init__()
        self.blocks = nn.ModuleList([nn.Linear(12, 6), nn.Linear(6, 6)])
        self.unused = nn.Linear(2, 2)
        self.noise = noise

    def forward(self, batch: Batch, moment: Moment) -> dict[str, Tensor]:
        x = batch.images.rgb_BTV3HW.flatten(1)
        x = self.blocks[1](torch.tanh(self.blocks[0](x))) + self.noise * torch.randn(len(x), 6)
        error = (x.view(-1, 2, 3) - batch.truth.center_BP3).square().sum(-1).mean(0)
        terms = {"base": error[0], "door": moment.inverse_beta * error[1]}
        return {**terms, "total": sum(terms.values(), torch.zeros(()))}


def tiny_batch(cursor: int, *, first: int = 0, count: int = ITEMS) -> Batch:
    """Items `first` to `first + count` of the batch at a cursor."""
    draw = Stream(5, "tiny", cursor).generator()
    pixels = torch.tensor(draw.uniform(size=(ITEMS, 1, 1, 3, 2, 2)))
    center = torch.tensor(draw.normal(size=(ITEMS, 2, 3)))
    chosen = slice(first, first + count)
    kind = torch.get_default_dtype()
    zeros = torch.zeros(count, 2)
    return Batch(
        images=Images(
            rgb_BTV3HW=pixels[chosen].to(kind),
            alpha_BTVHW=torch.ones(count, 1, 1, 2, 2),
            intrinsics_BTV33=torch.eye(3).expand(count, 1, 1, 3, 3),
            camera_from_world_BTV44=torch.eye(4).expand(count, 1, 1, 4, 4),
        ),
        truth=Articulation(
            valid_BP=zeros == 0.0,
            center_BP3=center[chosen].to(kind),
            size_BP3=torch.ones(count, 2, 3),
            type_BP=zeros.long(),
            axis_BP3=torch.zeros(count, 2, 3),
            origin_BP3=torch.zeros(count, 2, 3),
            motion_BTP=torch.zeros(count, 1, 2),
            limits_BP2=torch.zeros(count, 2, 2),
            parent_BP=zeros.long(),
        ),
        radius_B=torch.ones(count),
        asset_ids=tuple(f"box_{cursor + k}" for k in range(first, first + count)),
    )


def tiny_supply(team: Team | None = None) -> Supply:
    """Endless batches; each rank's share of them."""
    team = team or Team()
    count = ITEMS // team.world

    def supply(moment: Moment, cursor: int) -> Iterator[Batch]:
        while True:
            yield tiny_batch(cursor, first=team.rank * count, count=count)
            cursor += ITEMS

    return supply


def tiny_run(config: TrainConfig = CONFIG, *, noise: float = 0.1, team: Team | None = None) -> Run:
    """A run before its first update, from seed 0."""
    torch.manual_seed(0)
    settings = {"train": {"steps": config.steps}}
    return begun(TinyObjective(noise=noise), config, items=ITEMS, team=team, settings=settings)


def trained(folder: Path, config: TrainConfig = CONFIG) -> Checkpoint:
    """The last checkpoint of a run in a folder, begun or resumed there."""
    run = tiny_run(config)
    resume(run, folder)
    train(run, tiny_supply(), folder=folder)
    return read_checkpoint(found_checkpoints(folder)[-1])


def exit_status(work: Callable[[], object]) -> int:
    """Do the work in a child process; minus the signal that ended it, 0 if it came through."""
    child = os.fork()
    if child == 0:
        try:
            torch.set_num_threads(1)
            work()
        except BaseException:
            traceback.print_exc()
            os._exit(1)
        os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
