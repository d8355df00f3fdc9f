"""Where parts are in the observed states: what does not depend on what is taken for rest."""

import numpy as np

from artgen.core.transform import apply
from model.evaluation.layout import Layout
from model.evaluation.matching import Matching


def state_centers(predicted: Layout, true: Layout, matching: Matching) -> float | None:
    """Mean distance between the middles of the moving parts' boxes, as the observed states have
    them, radii; a part that nothing stands for counts one radius.

    None where a layout knows no states, they are not equally many, or nothing moves.
    """
    moving = np.flatnonzero(true.movable).tolist()
    if predicted.states is None or true.states is None or not moving:
        return None
    if len(predicted.states) != len(true.states):
        return None
    of_true = matching.of_true
    distances = []
    for mine, theirs in zip(predicted.states, true.states, strict=True):
        poses, true_poses = predicted.poses(np.nan_to_num(mine)), true.poses(theirs)
        for part in moving:
            own = of_true.get(part)
            if own is None:
                distances.append(true.radius)
                continue
            ours = apply(poses[own], predicted.centers[own])
            distances.append(
                float(np.linalg.norm(ours - apply(true_poses[part], true.centers[part])))
            )
    return float(np.mean(distances))
