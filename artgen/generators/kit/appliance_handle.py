"""Handles of appliance doors: bars on posts, pockets sunk into a panel, grip grooves."""

from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, union, upright


def bar_handle(
    *, half_length: float, y: float, z: float, stand: float, thickness: float, flat: bool
) -> Solid:
    """A bar along x in front of the plane `y`, on two posts.

    Args:
        half_length: m.
        y: of the face that the posts stand on.
        z: of the bar's middle.
        stand: clear space between face and bar.
        thickness: of the bar from front to back.
        flat: a rectangular bar on square posts; else a round one.
    """
    height = 1.5 * thickness if flat else thickness
    radius = 0.12 * thickness if flat else 0.499 * thickness
    section = rounded_rectangle(thickness, height, radius, segments=2 if flat else 4)
    bar = upright(prism(section, 2.0 * half_length), "x").at(
        -half_length, y - stand - thickness / 2.0, z
    )
    half = 0.4 * thickness
    posts = [
        slab((x - half, y - stand - 0.3 * thickness, z - half), (x + half, y, z + half))
        for x in (-half_length + 0.03, half_length - 0.03)
    ]
    return union([bar, *posts])


def pocket_room(
    *, half_length: float, y: float, low: float, high: float, depth: float, wall: float
) -> tuple[Solid, Solid]:
    """(room to cut out of a door, cup that lines it) for a pocket behind the plane `y`.

    The cup is open to the front, its ceiling gives the fingers an edge to pull.
    """
    outline = rounded_rectangle(high - low, 2 * half_length, 0.4 * (high - low), segments=5)
    middle = (low + high) / 2.0
    room = upright(prism(outline, depth), "y").at(0.0, y, middle)
    inside = rounded_rectangle(
        high - low - 2 * wall, 2 * (half_length - wall), 0.4 * (high - low) - wall, segments=5
    )
    hollow = upright(prism(inside, depth), "y").at(0.0, y - wall, middle)
    return room, room - hollow


def grip_groove(*, half_length: float, y: float, low: float, high: float, depth: float) -> Solid:
    """Room for a groove along x behind the plane `y`, undercut upwards so that fingers hook in."""
    section = [
        (y - 0.01, low),
        (y + depth, low + 0.25 * (high - low)),
        (y + depth, high + 0.006),
        (y + 0.45 * depth, high + 0.006),
        (y + 0.35 * depth, high),
        (y - 0.01, high),
    ]
    return upright(prism(section, 2.0 * half_length), "x").at(x=-half_length)
