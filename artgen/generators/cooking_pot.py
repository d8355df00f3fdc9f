"""Cooking pots: stock pots, saucepans, casseroles and Dutch ovens with lids and handles."""

from collections.abc import Mapping

from artgen.articulation.types import Body, Draft, DraftPart, Grip, Joint
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import pot_params
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import ABS, STAINLESS
from artgen.generators.kit.mirror_image import mirrored_body, mirrored_joint, mirrored_part
from artgen.generators.kit.pot_handle import (
    folding_loop,
    foot_plate,
    long_handle,
    rim_bead,
    side_loop,
)
from artgen.generators.kit.pot_marks import litre_marks, stamp
from artgen.generators.kit.pot_params import PotParams

PARAMS = PotParams
INVARIANTS = pot_params.INVARIANTS
METAL = Stock(surface="metal", density=STAINLESS, edge=0.0)
GRIP = Stock(surface="grip", density=1.2 * ABS, edge=0.0)


def build(p: PotParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the lid is on and folding handles hang down."""
    shell, lid, make = p.shell, p.cover, p.made
    bodies = shell.bodies(make.outer, make.inner, "metal")
    if p.make == "enamel":
        bodies.append(rim_bead(shell, 0.0021, "metal", 0.3 * STAINLESS))
    prints = [litre_marks(p, surfaces[make.inner]), stamp(p)]
    bodies += [body for body, _ in prints]
    if lid.hinged:
        bodies.append(lid.ears())
    rim = "sheet" if lid.kind == "glass" else p.skin
    knob = METAL if p.make == "cast" else GRIP
    moved, joints, grips = [lid.part(p.skin, rim, knob)], [lid.joint()], []
    if p.handle == "folding":
        fixed, loop, joint = folding_loop(
            shell, z=p.handle_z, half=p.loop_half, drop=p.loop_reach, radius=p.wire,
            stock=METAL, name="right_handle",
        )  # fmt: skip
        bodies += [fixed, mirrored_body(fixed)]
        left = _named(mirrored_part(loop), mirrored_joint(joint), "left_handle")
        moved += [loop, left[0]]
        joints += [joint, left[1]]
    else:
        bodies += _fixed(p)
        grips = _grips(p)
    parts = (DraftPart(name="base", label="base", bodies=tuple(bodies), grips=tuple(grips)), *moved)
    worn = {body.surface for part in parts for body in part.bodies}
    specs = (*surfaces.values(), *(spec for _, spec in prints))
    return Draft(
        category="cooking_pot",
        parts=parts,
        joints=tuple(joints),
        surfaces=tuple(spec for spec in specs if spec.name in worn),
    )


def _named(part: DraftPart, joint: Joint, name: str) -> tuple[DraftPart, Joint]:
    """The twin on the other side, under its own names."""
    grips = tuple(
        Grip(name=f"{name}_bar", kind=g.kind, position=g.position, outward=g.outward, pull=g.pull)
        for g in part.grips
    )
    twin = DraftPart(name=name, label=part.label, bodies=part.bodies, grips=grips)
    values = {**vars(joint), "name": f"{name}_fold", "child": name}
    return twin, Joint(**values)


def _fixed(p: PotParams) -> list[Body]:
    """A long handle to the right, with a loop opposite where asked for, or a loop on each side."""
    shell, z = p.shell, p.handle_z
    if p.handle == "long":
        bodies = long_handle(
            shell, z=z, length=p.handle_length, rise=p.handle_rise, width=p.bar_width,
            thick=p.bar_thickness, stock=GRIP if p.arched else METAL, metal=METAL,
            ferrule=p.ferrule,
        )  # fmt: skip
        return [*bodies, *map(mirrored_body, _loop(p, z))] if p.helper else bodies
    loop = _loop(p, z)
    return [*loop, *map(mirrored_body, loop)]


def _loop(p: PotParams, z: float) -> list[Body]:
    """One side handle with its feet at +x."""
    cast = p.handle == "lug"
    stock = Stock(surface=p.made.outer, density=p.made.density, edge=0.0) if cast else METAL
    if p.handle == "molded":
        stock = GRIP
    wide = {"lug": 0.013, "molded": 0.020}.get(p.handle, 2.1 * p.wire)
    thick = {"lug": 0.015, "molded": 0.015}.get(p.handle, 2.1 * p.wire)
    half = p.loop_half * (1.15 if cast else 1.0)
    loop = side_loop(p.shell, z=z, half=half, reach=p.loop_reach, width=wide, thick=thick,
                     stock=stock)  # fmt: skip
    if cast:
        return [loop]
    plates = [
        foot_plate(p.shell, y=s * half * 0.96, z=z, size=(0.020, 0.024), proud=0.0018, stock=METAL)
        for s in (-1.0, 1.0)
    ]
    return [loop, *plates]


def _grips(p: PotParams) -> list[Grip]:
    """Where hands take hold of what is fixed."""
    shell, up = p.shell, (0.0, 0.0, 1.0)
    if p.handle == "long":
        at = (shell.radius + 0.6 * p.handle_length, 0.0, p.handle_z + 0.6 * p.handle_rise)
        return [
            Grip(name="long_handle", kind="handle", position=at, outward=(1.0, 0.0, 0.0), pull=up)
        ]
    x, z = shell.radius + p.loop_reach - 0.007, p.handle_z
    return [
        Grip(name=f"{side}_handle", kind="handle", position=(s * x, 0.0, z), outward=(s, 0.0, 0.0),
             pull=up)
        for side, s in (("left", -1.0), ("right", 1.0))
    ]  # fmt: skip
