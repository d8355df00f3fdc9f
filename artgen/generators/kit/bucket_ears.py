"""What a bucket is carried and tipped by: ears bored for its bail, a strap low at the back."""

from artgen.articulation.types import Grip
from artgen.generators.kit.bail import Bail
from artgen.generators.kit.vessel import Vessel
from artgen.geometry.solid import Solid, chamfered_box, cylinder, union, wire

PLAY = 0.0007
"""m; between the hoop's end and its bore, and between hoop and boss."""


def bored_ear(vessel: Vessel, bail: Bail) -> Solid:
    """A pad on the wall at +x with a boss, bored for the hoop's end."""
    z, end = bail.height, bail.span - bail.wire - PLAY
    foot = vessel.at_height(z - 0.018).half[0]
    pad = chamfered_box((end - 0.004 - foot, 0.034, 0.030), 0.003).at(
        (foot + end - 0.004) / 2.0, 0.0, z - 0.018
    )
    boss = cylinder(0.011, end - foot, axis="x", segments=20).at(foot, 0.0, z)
    bore = cylinder(bail.wire + PLAY, 0.05, axis="x", segments=12).at(
        bail.span - 2.0 * bail.wire - 0.004, 0.0, z
    )
    return union([pad, boss]) - bore - vessel.outside()


def tipping_strap(vessel: Vessel) -> Solid:
    """A strap low at the back, to tip the bucket by."""
    low, high = vessel.rings[0].z, vessel.mouth.z
    ring = vessel.at_height(low + 0.22 * (high - low))
    b, half = ring.half[1], 0.30 * ring.half[0]
    near = b * (1.0 - 0.30**ring.power) ** (1.0 / ring.power) - 0.0015
    path = [(-half, near, ring.z), (-0.8 * half, b + 0.026, ring.z)]
    return wire([*path, *((-x, y, z) for x, y, z in reversed(path))], 0.0045, sides=8)


def low_grip(vessel: Vessel) -> Grip:
    """Where a hand tips the bucket."""
    low, high = vessel.rings[0].z, vessel.mouth.z
    z = low + 0.22 * (high - low)
    return Grip(
        name="tipping_grip", kind="handle", position=(0.0, vessel.at_height(z).half[1] + 0.026, z),
        outward=(0.0, 1.0, 0.0), pull=(0.0, 0.0, 1.0),
    )  # fmt: skip
