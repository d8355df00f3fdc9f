"""What the user decides of every object that comes in."""

from dataclasses import dataclass

from artgen.ingest.static import Up


@dataclass(frozen=True, kw_only=True)
class GivenRest:
    """A closed pose that the user knows better: of the object `id`, its moved part `number` (the
    node in PartNet-Mobility, the joint's name in a URDF) is closed at `q`, degrees or units."""

    id: str
    number: str
    q: float


@dataclass(frozen=True, kw_only=True)
class Options:
    """Settings of an ingest.

    Attributes:
        meters_per_unit: None takes the source's, or assumes one by category.
        max_parts: the smallest parts beyond are fixed to what carries them.
        density: kg/m3 of everything, as no source states it.
        thickness: m that open surfaces weigh as.
        pieces: cuts that a part's collision may take.
        turn_deg: about z, brings the front of a URDF's object to -y.
        up: axis that points up in a static mesh file.
        licence: identifier of the terms of the source; None leaves it to the data set.
    """

    meters_per_unit: float | None = None
    max_parts: int = 40
    density: float = 500.0
    thickness: float = 0.004
    pieces: int = 40
    rests: tuple[GivenRest, ...] = ()
    turn_deg: float = -90.0
    up: Up = "y"
    licence: str | None = None
