"""Which joints may move only while others are open, found where a format has no words for it.

A drawer behind a door meets the door and is no defect: the door has to be opened first. What meets
although every other joint stands open is one.
"""

from collections.abc import Iterator, Mapping, Sequence

import mujoco

from artgen.articulation.kinematics import resolved
from artgen.articulation.types import Joint, Precondition
from artgen.validate.physics import body_names
from artgen.validate.sweep import Sweep, joints_between, sweeps

TOUCH = 1e-4
"""m; shallower contact than the sweep would report needs no way to be cleared."""
POSES = 81
"""States a joint is put to: a bolt is out of its strike plate a few degrees from rest."""
Parts = tuple[str, str]


def found_passages(
    model: mujoco.MjModel, base: str, joints: Sequence[Joint], owners: Mapping[str, str]
) -> tuple[Precondition, ...]:
    """A precondition for each joint that meets a part which another joint can move away.

    Args:
        base: the part that no joint moves.
        owners: the part of each body of the model.
    """
    movable = {j.name: j for j in joints if j.limit is not None and j.mimic is None}
    leaders = {j.name: j.mimic.joint if j.mimic else j.name for j in joints}
    names = [base, *(joint.child for joint in joints)]
    between = {
        (names[i], names[j]): moved for (i, j), moved in joints_between(base, joints).items()
    }
    found: dict[tuple[str, str], Precondition] = {}
    for sweep in sweeps(joints, (), POSES):
        for pair in sorted(met(model, joints, sweep, owners)):
            moved = between.get(pair) or between.get(pair[::-1], ())
            moved = tuple(leaders[name] for name in moved)
            others = [name for name in moved if name != sweep.joint and name in movable]
            if sweep.joint not in moved:
                continue
            for name in others:
                rule = _passage(movable[name], sweep.joint)
                opened = tuple({**state, name: rule.at_least} for state in sweep.states)
                again = Sweep(joint=sweep.joint, states=opened)
                if pair not in met(model, joints, again, owners):
                    found.setdefault((sweep.joint, name), rule)
                    break
    return tuple(found.values())


def _passage(other: Joint, joint: str) -> Precondition:
    """`joint` moves while `other` is at the end that is farther from rest."""
    if other.limit is None:
        raise ValueError(f"{other.name} has no end to be opened to")
    far = max(other.limit.lower, other.limit.upper, key=abs)
    return Precondition(joint=joint, requires=other.name, at_least=far)


def met(
    model: mujoco.MjModel, joints: Sequence[Joint], sweep: Sweep, owners: Mapping[str, str]
) -> set[Parts]:
    """Pairs of parts, in alphabetical order, that meet somewhere on a sweep."""
    data = mujoco.MjData(model)
    places = [model.jnt_qposadr[model.joint(joint.name).id] for joint in joints]
    parts = [owners.get(name, name) for name in body_names(model)]
    found: set[Parts] = set()
    for state in sweep.states:
        data.qpos[places] = list(resolved(joints, state).values())
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        found |= set(_touching(model, data, parts))
    return found


def _touching(model: mujoco.MjModel, data: mujoco.MjData, parts: Sequence[str]) -> Iterator[Parts]:
    for contact in data.contact:
        if contact.dist < -TOUCH:
            first, second = (parts[model.geom_bodyid[geom]] for geom in contact.geom)
            if first != second:
                yield min(first, second), max(first, second)
