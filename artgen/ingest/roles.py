"""Roles and dynamics of foreign parts: their words to ours, and forces nobody has measured."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from artgen.articulation.roles import ROLES
from artgen.articulation.types import JointType
from artgen.core.errors import RuleError
from artgen.validate.semantics import packaged_rule

WORDS: Mapping[str, str] = {
    "rotation_door": "door",
    "translation_door": "door",
    "translation_screen": "cover",
    "rotation_window": "sash",
    "translation_window": "sash",
    "window": "sash",
    "rotation_lid": "lid",
    "translation_lid": "lid",
    "cap": "lid",
    "cover_lid": "lid",
    "screen": "lid",
    "rotation_screen": "lid",
    "shaft": "lid",
    "translation_tray": "tray",
    "rotation_tray": "turntable",
    "container": "bin",
    "key": "button",
    "toggle_button": "button",
    "push_button": "button",
    "rotation_button": "knob",
    "translation_knob": "knob",
    "slider": "knob",
    "rotation_slider": "dial",
    "switch": "lever",
    "toggle_switch": "lever",
    "rotation_handle": "handle",
    "translation_handle": "handle",
    "bail": "handle",
    "rotation_blade": "blade",
    "translation_blade": "blade",
    "steering_wheel": "wheel",
    "caster_yaw": "caster",
    "tilt_leg": "leg",
    "rotation_leg": "leg",
    "connector": "arm",
    "rotation_bar": "arm",
    "translation_bar": "arm",
    "bar": "arm",
    "rotation": "part",
    "translation": "part",
    "lever": "lever",
    "spout": "spout",
    "hand": "arm",
    "temple": "arm",
    "head": "head",
    "back": "backrest",
    "rotation_container": "drum",
    "nozzle": "head",
}
"""Words of the data set that are not our roles, to the roles they stand for."""
FLIPPED: Mapping[tuple[str, JointType], str] = {
    ("drawer", "revolute"): "door",
    ("drawer", "continuous"): "door",
    ("rack", "revolute"): "part",
    ("shelf", "revolute"): "part",
    ("dial", "prismatic"): "knob",
    ("drum", "prismatic"): "bin",
    ("turntable", "prismatic"): "tray",
    ("flap", "prismatic"): "cover",
}
"""A role that cannot move like that, to the one that does."""


def role_label(word: str, joint: JointType | None) -> str:
    """The role of a part: `base` where nothing moves it, `part` where the word says nothing."""
    if joint is None:
        return "base"
    key = re.sub(r"[^a-z]+", "_", word.lower()).strip("_")
    found = WORDS.get(key) or (key if key in ROLES and key != "base" else None)
    if found is None:
        own = [part for part in key.split("_") if part in ROLES and part != "base"]
        found = own[-1] if own else "part"
    return FLIPPED.get((found, joint), found)


@dataclass(frozen=True, kw_only=True)
class Dynamics:
    """Friction and the like of a joint: N m or N, per rad/s or m/s."""

    friction: float
    damping: float
    effort: float


LIGHTEST = 0.05
"""Of the span of its role: how much friction a joint has at least."""
HOLDS = 0.5
"""Of the joint's own load (weight times arm): friction that such joints have."""
HELD = 1.25
"""Likewise, where a part stays where it is put."""
FOREIGN_HELD: Mapping[str, tuple[str, ...]] = {
    "display": ("lid", "arm", "head", "part"),
    "lamp": ("arm", "head", "column"),
    "phone": ("lid",),
}
"""Roles of parts that stay where they are put, in categories that artgen has no rule for."""
DAMPED = 0.1
"""Damping over friction, s."""
STIFFEST = 500.0
"""1/s; damping over inertia. MuJoCo lets what is damped more than that through its stops: a dial of
2 g with 0.002 N m s went 0.3 rad too far; 1000 /s is 0.007 rad."""
STRONG = 4.0
"""Effort over the sum of friction and load."""


def held_roles(category: str) -> tuple[str, ...]:
    """Roles of parts that stay wherever they are put: a laptop's lid, the arms of a lamp."""
    try:
        return packaged_rule(category).held
    except RuleError:
        return FOREIGN_HELD.get(category, ())


def dynamics(
    label: str, joint: JointType, *, load: float, inertia: float, held: bool = False
) -> Dynamics:
    """Friction inside the role's span, the more the heavier what moves; an effort that overcomes
    it.

    Args:
        load: weight of what moves, N; times its arm about the axis where it turns, N m.
        inertia: of what moves, kg; about the axis where it turns, kg m2.
        held: whether friction has to carry the load.
    """
    role = ROLES[label]
    low, high = role.sliding if joint == "prismatic" else role.turning
    high = min(high, 100.0 * max(low, 0.01), 50.0)
    least = max(low, LIGHTEST * min(high, 1.0))
    friction = min(max((HELD if held else HOLDS) * load, least), max(high, least))
    if joint == "continuous":
        friction = least
    return Dynamics(
        friction=friction,
        damping=min(DAMPED * friction, STIFFEST * inertia),
        effort=STRONG * (friction + load),
    )
