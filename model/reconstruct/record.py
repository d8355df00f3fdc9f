"""`prediction.json`: what the network said, before anything was mended, and what was made of it."""

from collections.abc import Mapping, Sequence
from typing import Any

import torch

from model.batch import PRISMATIC
from model.network.prediction import TYPE_OF_LOGIT
from model.reconstruct.assemble import Assembled
from model.reconstruct.films import Reprojection
from model.reconstruct.search import Finding

SCHEMA = "artgen-prediction/1"
WORDS = ("fixed", "revolute", "prismatic")
DIGITS = 6


def record(
    finding: Finding,
    assembled: Assembled,
    seen: Sequence[Reprojection],
    *,
    states: Sequence[int],
    checkpoint: Mapping[str, Any],
) -> dict[str, Any]:
    """Lengths in radii and motions in shares of a turn or of the diameter, as the network states
    them; the sphere turns them into m.

    Args:
        states: numbers of all states of the capture.
    """
    prediction, sphere = finding.prediction, finding.sphere
    articulation = prediction.articulation
    chance = torch.softmax(prediction.type_logits_BP2[0].float(), dim=-1)
    revolute = 1 - TYPE_OF_LOGIT.index(PRISMATIC)
    slots = []
    for slot in torch.nonzero(articulation.valid_BP[0]).flatten().tolist():
        slots.append(
            {
                "slot": slot,
                "part": assembled.names.get(slot),
                "type": WORDS[int(articulation.type_BP[0, slot])],
                "revolute": round(float(chance[slot, revolute]), DIGITS),
                "center": _listed(articulation.center_BP3[0, slot]),
                "size": _listed(articulation.size_BP3[0, slot]),
                "axis": _listed(articulation.axis_BP3[0, slot]),
                "origin": _listed(articulation.origin_BP3[0, slot]),
                "motion": _listed(articulation.motion_BTP[0, :, slot]),
                "limits": _listed(articulation.limits_BP2[0, slot]) if prediction.limited else None,
                "parent": int(articulation.parent_BP[0, slot]),
            }
        )
    return {
        "schema": SCHEMA,
        "units": "radii of the sphere; motion and limits: angle / 2 pi, or way / 2 in radii",
        "sphere": {
            "center": _rounded(sphere.center.tolist()),
            "radius": round(sphere.radius, DIGITS),
            "meters_per_unit": sphere.meters,
            "stated": sphere.stated,
            "object_from_center_m": _rounded(assembled.shift.tolist()),
        },
        "checkpoint": checkpoint,
        "views": list(finding.views),
        "shown_states": [states[place] for place in finding.states],
        "slots": slots,
        "states": [
            {"state": number, "joints": {name: round(q, DIGITS) for name, q in joints.items()}}
            for number, joints in zip(states, assembled.states, strict=False)
        ],
        "changes": list(assembled.changes),
        "reprojection": [
            {"state": own.state, "view": own.view, "silhouette_iou": round(own.iou, 4)}
            for own in seen
        ],
    }


def _listed(values: torch.Tensor) -> list[float]:
    return _rounded(values.detach().cpu().double().flatten().tolist())


def _rounded(values: Sequence[float]) -> list[float]:
    return [round(float(value), DIGITS) + 0.0 for value in values]
