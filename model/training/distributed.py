"""Several processes that train one network: who takes part, and how gradients and weights meet.

Started by `torchrun`, each process holds a rank. Replicas (DDP) average gradients; shards (FSDP2)
also divide weights and moments among the ranks. One process alone needs neither.
"""

from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from datetime import timedelta
from typing import Literal

import torch
from torch import Tensor, nn
from torch import distributed as dist
from torch.distributed.fsdp import FSDPModule, fully_shard
from torch.distributed.tensor import DTensor, distribute_tensor
from torch.nn.parallel import DistributedDataParallel

from artgen.core.errors import ModelError

Plan = Literal["replicas", "shards"]

TIMEOUT = timedelta(minutes=10)
"""A rank that stays away longer is taken for dead."""
PATIENCE = timedelta(days=2)
"""Thousands of objects take hours to make, while all but the leading rank have nothing to do."""


@dataclass(frozen=True, kw_only=True)
class Team:
    """The processes of one training run, seen from one of them.

    Attributes:
        plan: how weights are held where there is more than one process.
        patient: the same processes, who wait as long as `PATIENCE`; None where there is one.
    """

    rank: int = 0
    world: int = 1
    device: torch.device = field(default_factory=lambda: torch.device("cpu"))
    plan: Plan = "replicas"
    patient: dist.ProcessGroup | None = None

    @property
    def leads(self) -> bool:
        """Whether this process writes files and talks to the user."""
        return self.rank == 0


@contextmanager
def joined(
    environment: Mapping[str, str], *, device: str, plan: Plan = "replicas"
) -> Iterator[Team]:
    """The team that `torchrun` describes in the environment; one process where it does not.

    Args:
        device: "cpu", "cuda", or "auto" for a GPU where there is one.
    """
    local = int(environment.get("LOCAL_RANK", "0"))
    place = device_named(device, local)
    if int(environment.get("WORLD_SIZE", "1")) == 1:
        yield Team(device=place)
        return
    dist.init_process_group("nccl" if place.type == "cuda" else "gloo", timeout=TIMEOUT)
    try:
        yield Team(
            rank=dist.get_rank(),
            world=dist.get_world_size(),
            device=place,
            plan=plan,
            patient=dist.new_group(timeout=PATIENCE),
        )
    finally:
        dist.destroy_process_group()


def device_named(name: str, local: int = 0) -> torch.device:
    """ "cpu", "cuda", or "auto" for a GPU where there is one.

    Raises:
        ModelError: there is none.
    """
    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    if name != "cuda":
        return torch.device(name)
    if not torch.cuda.is_available():
        raise ModelError("--device cuda: this torch sees no GPU; use --device cpu or auto")
    torch.cuda.set_device(local)
    return torch.device("cuda", local)


def shared(module: nn.Module, team: Team) -> nn.Module:
    """The module as the team holds it; its forward and backward then involve every rank."""
    if team.world == 1:
        return module
    if team.plan == "replicas":
        # Heads that a recipe leaves unused get no gradient; the search for them costs little.
        return DistributedDataParallel(module, find_unused_parameters=True)
    for blocks in (child for child in module.modules() if isinstance(child, nn.ModuleList)):
        for block in blocks:
            fully_shard(block)
    fully_shard(module)
    return module


def meeting(module: nn.Module, *, now: bool) -> AbstractContextManager[None]:
    """Within it, a backward pass sends gradients to the other ranks, or keeps them for later."""
    if isinstance(module, FSDPModule):
        module.set_requires_gradient_sync(now)
    elif isinstance(module, DistributedDataParallel) and not now:
        return module.no_sync()
    return nullcontext()


def averaged(values: Tensor, team: Team) -> Tensor:
    """Mean over the ranks; not-a-number on one rank is so on all."""
    if team.world == 1:
        return values
    total = values.clone()
    dist.all_reduce(total)
    return total / team.world


def wait_for_all(team: Team) -> None:
    """Return once every rank has come here."""
    if team.world > 1:
        dist.barrier()


def wait_for_leader(team: Team) -> None:
    """The same, where the leading rank may take hours; if it dies, `torchrun` ends the others."""
    if team.patient is not None:
        dist.barrier(group=team.patient)


def local(tensor: Tensor) -> Tensor:
    """This rank's share of a tensor; shares its memory."""
    return tensor.to_local() if isinstance(tensor, DTensor) else tensor


def whole(tensor: Tensor) -> Tensor:
    """All of a tensor, on the CPU; every rank must ask at once."""
    full = tensor.full_tensor() if isinstance(tensor, DTensor) else tensor
    return full.detach().cpu()


def share_of(full: Tensor, like: Tensor) -> Tensor:
    """`full` on the device of `like` and divided among ranks as `like` is."""
    placed = full.to(device=like.device)
    if isinstance(like, DTensor):
        return distribute_tensor(placed, like.device_mesh, like.placements)
    return placed
