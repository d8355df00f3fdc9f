"""Parents of parts out of logits: every part hangs, in the end, on the base.

B objects, P part slots; slot 0 is the base.
"""

import torch
from torch import Tensor


def parents(logits_BPP: Tensor, valid_BP: Tensor) -> Tensor:
    """(B, P) int64 parent of each part; -1 for the base and for empty slots.

    Each part takes its best parent. Where that runs in circles, the part of the circle that loses
    least by it hangs on the base instead, until no circle is left.

    Args:
        logits_BPP: of child (row) on parent (column); a part itself and empty slots refused.
    """
    slots = logits_BPP.shape[1]
    chosen = logits_BPP.argmax(dim=2)
    chosen[:, 0] = 0
    best = logits_BPP.gather(2, chosen[..., None])[..., 0]
    loss = best - logits_BPP[..., 0]
    numbers = torch.arange(slots, device=logits_BPP.device)
    for _ in range((slots - 1) // 2):
        freed = torch.where(_in_circle(chosen), loss, torch.inf).argmin(dim=1)
        freed = torch.where(_in_circle(chosen).any(dim=1), freed, 0)
        chosen = torch.where(numbers == freed[:, None], 0, chosen)
    hangs = valid_BP & (numbers > 0)
    return torch.where(hangs, chosen, -1)


def _in_circle(parent_BP: Tensor) -> Tensor:
    """(B, P): whether following parents leads a part, other than the base, back to itself."""
    numbers = torch.arange(parent_BP.shape[1], device=parent_BP.device)
    above, met = parent_BP, torch.zeros_like(parent_BP, dtype=torch.bool)
    for _ in range(parent_BP.shape[1]):
        met = met | ((above == numbers) & (numbers > 0))
        above = parent_BP.gather(1, above)
    return met
