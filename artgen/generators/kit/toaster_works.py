"""What moves in a toaster besides dials and buttons: levers, carriages and the crumb tray."""

from artgen.articulation.types import DraftPart, Grip, Joint, Latch, Limit, Mimic, Spring
from artgen.core.conventions import GRAVITY
from artgen.generators.kit.board import Stock
from artgen.generators.kit.counterbalance import weighed
from artgen.generators.kit.density import ABS, STEEL
from artgen.generators.kit.press_lever import FLANGE, PressLever
from artgen.generators.kit.toaster_design import ToasterParams
from artgen.generators.kit.toaster_face import PLATE

SLICE = 0.108
"""m; side of a slice of tin bread."""


def toaster_works(p: ToasterParams, trim: str) -> tuple[list[DraftPart], list[Joint]]:
    """Tray, levers and carriages; thumb pieces wear the surface `trim`."""
    sheet = Stock(surface="inner", density=0.5 * STEEL, edge=0.0008)
    thumb = Stock(surface=trim, density=ABS, edge=0.0008)
    levers = [_lever(p, k) for k in range(len(p.served))]
    carriages = [_carriage(p, k, lever.name) for k, lever in enumerate(levers)]
    tray = DraftPart(
        name="crumb_tray",
        label="tray",
        bodies=p.shell.tray(sheet, Stock(surface="trim", density=ABS, edge=0.0008)),
        grips=(_tray_grip(p),),
    )
    parts = [tray, *(lever.part(thumb, sheet) for lever in levers), *carriages]
    pairs = zip(levers, carriages, strict=True)
    joints = [
        _tray_joint(p),
        *(lever.joint(parent="base") for lever in levers),
        *(_lift(p, lever, carriage) for lever, carriage in pairs),
    ]
    return parts, joints


def _lever(p: ToasterParams, k: int) -> PressLever:
    return PressLever(
        name="lever" if len(p.served) == 1 else f"lever_{k + 1}",
        face=p.shell.end,
        y=p.lever_places[k],
        z=p.height - p.lever_drop,
        travel=p.travel,
        style=p.lever,
        gap=PLATE + 0.0015,
        size=p.lever_size,
        preload=p.preload,
    )


def _carriage(p: ToasterParams, k: int, lever: str) -> DraftPart:
    """The racks under the bread, and the bread."""
    chamber, served = p.chamber, p.served[k]
    tip = p.shell.end - FLANGE[1] - 0.0015
    rack = chamber.carriage(served, Stock(surface="inner", density=STEEL, edge=0.0), low=p.lifted,
                            tongue=(p.lever_places[k], p.height - p.lever_drop, tip))  # fmt: skip
    slices = [
        body
        for y in served[: p.slices]
        for body in chamber.bread(y, Stock(surface="crumb", density=260.0, edge=0.0),
                                  Stock(surface="crust", density=300.0, edge=0.0),
                                  low=p.lifted + 0.009, size=SLICE)
    ]  # fmt: skip
    return DraftPart(name=f"{lever}_carriage", label="pusher", bodies=(rack, *slices))


def _lift(p: ToasterParams, lever: PressLever, carriage: DraftPart) -> Joint:
    """The carriage goes down with its lever; its spring carries it and the bread."""
    weight = weighed(carriage.bodies)[0] * GRAVITY
    return Joint(
        name=f"{lever.name}_carriage_lift",
        type="prismatic",
        parent="base",
        child=f"{lever.name}_carriage",
        axis=(0.0, 0.0, -1.0),
        limit=Limit(lower=0.0, upper=p.travel * p.lift_ratio),
        friction=0.5,
        damping=2.0,
        effort=60.0,
        spring=Spring(stiffness=weight / p.travel, reference=-1.4 * p.travel),
        mimic=Mimic(joint=f"{lever.name}_press", multiplier=p.lift_ratio),
    )


def _tray_joint(p: ToasterParams) -> Joint:
    """Out of the side away from the levers by +q."""
    return Joint(
        name="crumb_tray_slide",
        type="prismatic",
        parent="base",
        child="crumb_tray",
        axis=(-1.0, 0.0, 0.0),
        limit=Limit(lower=0.0, upper=0.85 * (p.chamber.front + p.shell.end)),
        friction=1.5,
        damping=2.0,
        effort=20.0,
        latch=Latch(force=3.0, reach=0.006),
    )


def _tray_grip(p: ToasterParams) -> Grip:
    at = (-p.shell.end - 0.008, 0.0, p.foot + 0.007)
    return Grip(
        name="crumb_tray_pull",
        kind="edge",
        position=at,
        outward=(-1.0, 0.0, 0.0),
        pull=(-1.0, 0.0, 0.0),
    )
