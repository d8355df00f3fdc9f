"""Rollers that carry racks and drawers."""

from artgen.geometry.solid import Solid, cylinder, slab, union


def rack_wheel(
    *, x: float, y: float, z: float, radius: float, outer: float, mount: float
) -> list[Solid]:
    """A roller and its bracket, beside a rack's right wall (mirror it for the left).

    The pieces share no volume with each other nor with what lies inside `mount`.

    Args:
        x: of the roller's inner face, m.
        y: of its axis.
        z: of its axis.
        radius: of the tread.
        outer: x of the roller's outer face.
        mount: x of the rack's outermost wires, where the bracket begins.
    """
    tread = cylinder(radius, outer - x - 0.0015, axis="x", segments=12).at(x, y, z)
    cap = cylinder(0.45 * radius, 0.0015, axis="x", segments=8).at(outer - 0.0015, y, z)
    neck = slab((mount, y - 0.45 * radius, z - 0.45 * radius), (x, y + 0.45 * radius, z + 0.034))
    return [union([tread, cap, neck])]
