"""Sockets in the side of a device: a recess, a metal lip inside it and the tongue."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from artgen.articulation.types import Body
from artgen.generators.kit.density import ABS, STEEL
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, upright

DEEP = 0.0055
"""m; what one sees of a socket."""
LIP = 0.0004
"""m; wall of the metal shell, and how far it stays behind the case."""


@dataclass(frozen=True, kw_only=True)
class Socket:
    """Width and height of the opening, m; radius of its corners; tongue's width and height."""

    width: float
    height: float
    radius: float
    tongue: tuple[float, float] | None = None


SOCKETS: Mapping[str, Socket] = {
    "usb_a": Socket(width=0.0133, height=0.0054, radius=0.0003, tongue=(0.0115, 0.0016)),
    "usb_c": Socket(width=0.0090, height=0.0032, radius=0.0015, tongue=(0.0066, 0.0007)),
    "hdmi": Socket(width=0.0150, height=0.0055, radius=0.0012, tongue=(0.0118, 0.0010)),
    "audio": Socket(width=0.0046, height=0.0046, radius=0.0023),
    "power": Socket(width=0.0062, height=0.0062, radius=0.0031, tongue=(0.0012, 0.0012)),
    "card": Socket(width=0.0250, height=0.0022, radius=0.0003),
    "ethernet": Socket(width=0.0118, height=0.0085, radius=0.0003, tongue=(0.0085, 0.0010)),
}
"""Receptacle openings of USB 2.0/3.2 Type-A and Type-C, HDMI type A, 3.5 mm jack, SD, 8P8C."""


def side_port(kind: str, *, face: float, y: float, z: float) -> tuple[Solid, tuple[Body, ...]]:
    """What to cut from the case at x = `face` (its sign tells the side), and the bodies inside."""
    socket = SOCKETS[kind]
    place = _Place(face=face, y=y, z=z)
    ring = _outline(socket, 0.0)
    inner = _outline(socket, LIP)
    cut = place.put(prism(ring, DEEP + 0.004), -0.004)
    shell = place.put(prism(ring, DEEP - LIP - 0.0006, holes=[inner]), LIP)
    insert = prism(ring, 0.0006).at(0.0, 0.0, DEEP - 0.0006)
    if socket.tongue is not None:
        w, h = socket.tongue
        insert = insert | slab((-w / 2.0, -h / 2.0, 0.0012), (w / 2.0, h / 2.0, DEEP - 0.0003))
    return cut, (
        Body(solid=shell, surface="port_metal", density=STEEL),
        Body(solid=place.put(insert, 0.0), surface="dark", density=ABS),
    )


@dataclass(frozen=True, kw_only=True)
class _Place:
    face: float
    y: float
    z: float

    def put(self, solid: Solid, start: float) -> Solid:
        """Drawn in (y, z, depth behind the face) put into the side, `start` m behind the face."""
        right = upright(solid.at(0.0, 0.0, start), "x").mirrored("x")
        placed = right if self.face > 0.0 else right.mirrored("x")
        return placed.at(self.face, self.y, self.z)


def _outline(socket: Socket, inset: float) -> Sequence[Sequence[float]]:
    w, h = socket.width - 2.0 * inset, socket.height - 2.0 * inset
    if socket.radius * 2.0 >= socket.height:
        return [tuple(p) for p in circle(w / 2.0, segments=14)]
    segments = 3 if socket.radius > 0.001 else 1
    radius = max(socket.radius - inset, 0.0002)
    return [tuple(p) for p in rounded_rectangle(w, h, radius, segments=segments)]


def fitting(kinds: Sequence[str], *, room: float) -> tuple[str, ...]:
    """Those sockets that a wall of `room` m can hold; flat ones stand in for tall ones."""
    return tuple(kind if SOCKETS[kind].height + 0.0012 <= room else "usb_c" for kind in kinds)
