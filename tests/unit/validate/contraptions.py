"""Sound little objects of the kinds that doors and drawers are not: what the checks must let be.

Each is made of boards, as the cabinet is; all stand on the floor, centered, and clear by 1 mm.
"""

import dataclasses
import math
from collections.abc import Sequence

from artgen.articulation.canonical import canonical_order
from artgen.articulation.types import ArticulatedObject, Joint, Latch, Limit, Mimic, Part, Spring
from tests.strategies import STEEL, WOOD, Corners
from tests.unit.validate.cabinet import board_part

BIN: tuple[Corners, ...] = (
    ((-0.15, -0.15, 0.06), (0.15, 0.15, 0.07)),
    ((-0.15, -0.15, 0.07), (-0.146, 0.15, 0.5)),
    ((0.146, -0.15, 0.07), (0.15, 0.15, 0.5)),
    ((-0.146, -0.15, 0.07), (0.146, -0.146, 0.5)),
    ((-0.146, 0.146, 0.07), (0.146, 0.15, 0.5)),
    ((-0.15, -0.1, 0.0), (-0.12, 0.15, 0.06)),
    ((0.12, -0.1, 0.0), (0.15, 0.15, 0.06)),
)
"""An open box of 4 mm on two skids."""


def made(
    category: str,
    parts: Sequence[tuple[str, str, Sequence[Corners]]],
    joints: tuple[Joint, ...],
    density: float = 2000.0,
) -> ArticulatedObject:
    """An object of (name, label, boards), parts in canonical order."""
    listed: list[Part] = [
        dataclasses.replace(board_part(name, boards, density=density), label=label)
        for name, label, boards in parts
    ]
    order = canonical_order([part.mesh.bounds for part in listed])
    return ArticulatedObject(
        category=category,
        asset_id=f"{category}_000000",
        parts=tuple(listed[i] for i in order),
        joints=joints,
        surfaces=(WOOD, STEEL),
    )


def pedal_bin(**lid: object) -> ArticulatedObject:
    """A pedal in the middle of its length turns down and lifts the lid by a rod."""
    pedal = Joint(
        name="pedal_pivot", type="revolute", parent="base", child="pedal", axis=(1.0, 0.0, 0.0),
        origin=(0.0, 0.0, 0.04), limit=Limit(lower=0.0, upper=0.2), friction=0.2, damping=0.05,
        effort=25.0,
    )  # fmt: skip
    follower = Joint(
        name="lid_hinge", type="revolute", parent="base", child="lid", axis=(-1.0, 0.0, 0.0),
        origin=(0.0, 0.15, 0.502), limit=Limit(lower=0.0, upper=1.2), friction=0.05, damping=0.01,
        effort=5.0, mimic=Mimic(joint="pedal_pivot", multiplier=6.0),
    )  # fmt: skip
    return made(
        "pedal_bin",
        (
            ("base", "base", BIN),
            ("pedal", "pedal", (((-0.03, -0.15, 0.03), (0.03, 0.01, 0.045)),)),
            ("lid", "lid", (((-0.15, -0.15, 0.502), (0.15, 0.15, 0.51)),)),
        ),
        (pedal, dataclasses.replace(follower, **lid)),  # type: ignore[arg-type]
    )


def bucket(friction: float = 0.005) -> ArticulatedObject:
    """A bail on two ears, which lies on the rim at either end of its way."""
    box = [(low, high) for low, high in BIN[:5]]
    low = [((a[0], a[1], a[2] - 0.06), (b[0], b[1], b[2] - 0.06)) for a, b in box]
    bail: tuple[Corners, ...] = (
        ((-0.15, -0.15, 0.441), (-0.146, 0.002, 0.447)),
        ((0.146, -0.15, 0.441), (0.15, 0.002, 0.447)),
        ((-0.146, -0.15, 0.441), (0.146, -0.146, 0.447)),
    )
    falls = Joint(
        name="bail_pivot", type="revolute", parent="base", child="bail", axis=(-1.0, 0.0, 0.0),
        origin=(0.0, 0.0, 0.4445), limit=Limit(lower=0.0, upper=math.pi), friction=friction,
        damping=0.001, effort=2.0,
    )  # fmt: skip
    return made("pail", (("base", "base", low), ("bail", "handle", bail)), (falls,))


LAMP: tuple[tuple[str, str, tuple[Corners, ...]], ...] = (
    ("base", "base", (((-0.1, -0.39, 0.0), (0.1, 0.39, 0.03)),)),
    ("post", "column", (((-0.01, -0.01, 0.032), (0.01, 0.01, 0.15)),)),
    ("lower_arm", "arm", (((0.012, -0.01, 0.14), (0.02, 0.01, 0.45)),)),
    ("upper_arm", "arm", (((0.022, -0.3, 0.435), (0.03, 0.01, 0.45)),)),
    ("neck", "arm", (((0.0, -0.31, 0.38), (0.02, -0.29, 0.455)),)),
    ("shade", "head", (((-0.03, -0.39, 0.34), (0.05, -0.312, 0.4)),)),
)


def lamp(**turned: object) -> ArticulatedObject:
    """A chain of five: a post that turns for ever, two arms, a neck and a shade."""

    def joint(
        name: str, parent: str, child: str, axis: tuple[float, float, float],
        origin: tuple[float, float, float], reach: float | None, friction: float,
    ) -> Joint:  # fmt: skip
        return Joint(
            name=name, type="continuous" if reach is None else "revolute", parent=parent,
            child=child, axis=axis, origin=origin,
            limit=None if reach is None else Limit(lower=-reach, upper=reach),
            friction=friction, damping=0.02, effort=4.0 * friction,
        )  # fmt: skip

    across = (1.0, 0.0, 0.0)
    return made(
        "lamp",
        LAMP,
        (
            joint("swivel", "base", "post", (0.0, 0.0, 1.0), (0.0, 0.0, 0.0), None, 0.3),
            joint("shoulder", "post", "lower_arm", across, (0.0, 0.0, 0.145), 0.6, 2.5),
            joint("elbow", "lower_arm", "upper_arm", across, (0.0, 0.0, 0.4425), 0.7, 2.0),
            joint("wrist", "upper_arm", "neck", across, (0.0, -0.3, 0.4425), 0.5, 0.8),
            joint("nod", "neck", "shade", (0.0, 1.0, 0.0), (0.01, 0.0, 0.385), 0.5, 0.8),
        ),
        density=900.0,
    )


KETTLE_HINGE = Joint(
    name="lid_hinge", type="revolute", parent="base", child="lid", axis=(-1.0, 0.0, 0.0),
    origin=(0.0, 0.15, 0.502), limit=Limit(lower=0.0, upper=1.4), friction=0.05, damping=0.05,
    effort=6.0, spring=Spring(stiffness=0.6, reference=3.5), latch=Latch(force=2.0, reach=0.05),
)  # fmt: skip


def kettle(hinge: Joint = KETTLE_HINGE) -> ArticulatedObject:
    """A spring opens the lid; a catch holds it shut."""
    lid: tuple[Corners, ...] = (((-0.15, -0.15, 0.502), (0.15, 0.15, 0.506)),)
    box = tuple(((a[0], a[1], 0.0 if a[2] == 0.06 else a[2]), b) for a, b in BIN[:5])
    return made("pot", (("base", "base", box), ("lid", "lid", lid)), (hinge,), density=1000.0)


def touch_lid() -> ArticulatedObject:
    """A lid that falls shut into its catch."""
    return kettle(dataclasses.replace(KETTLE_HINGE, spring=None, friction=0.02, effort=20.0))


def stool(spring: Spring | None = None) -> ArticulatedObject:
    """A gas lift carries a seat that turns for ever."""
    lift = Joint(
        name="lift", type="prismatic", parent="base", child="column", axis=(0.0, 0.0, 1.0),
        limit=Limit(lower=0.0, upper=0.12), friction=40.0, damping=200.0, effort=400.0,
        spring=spring or Spring(stiffness=20.0, reference=3.0),
    )  # fmt: skip
    turn = Joint(
        name="turn", type="continuous", parent="column", child="seat", axis=(0.0, 0.0, 1.0),
        limit=None, friction=0.4, damping=0.1, effort=20.0,
    )  # fmt: skip
    return made(
        "stool",
        (
            ("base", "base", (((-0.25, -0.25, 0.0), (0.25, 0.25, 0.05)),
                              ((-0.03, -0.03, 0.05), (-0.027, 0.03, 0.35)),
                              ((0.027, -0.03, 0.05), (0.03, 0.03, 0.35)),
                              ((-0.027, -0.03, 0.05), (0.027, -0.027, 0.35)),
                              ((-0.027, 0.027, 0.05), (0.027, 0.03, 0.35)))),
            ("column", "column", (((-0.02, -0.02, 0.1), (0.02, 0.02, 0.44)),)),
            ("seat", "seat", (((-0.2, -0.2, 0.442), (0.2, 0.2, 0.48)),)),
        ),
        (lift, turn),
        density=800.0,
    )  # fmt: skip


SOUND = {
    "pedal bin": pedal_bin,
    "bucket": bucket,
    "lamp": lamp,
    "kettle": kettle,
    "touch lid": touch_lid,
    "stool": stool,
}
