"""Windows: sashes that turn, tilt or slide in a frame, with board, drip sill and trim."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Body, Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import window_params
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.mirror_image import mirrored_body
from artgen.generators.kit.window_frame import AIR, WindowFrame
from artgen.generators.kit.window_params import (
    METAL,
    SHEET,
    SILL,
    WindowParams,
    frame_of,
    sash_maker,
)
from artgen.generators.kit.window_sashes import (
    BEFORE,
    Fittings,
    Sashes,
    hung_sashes,
    pair_of_sashes,
    planes,
    sliding_sashes,
    swinging_sash,
)

PARAMS = WindowParams
INVARIANTS = window_params.INVARIANTS
Made = tuple[WindowFrame, list[Body], Sashes]
"""The frame, what is fixed in it, and what moves."""


def build(p: WindowParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """The room is at -y; sashes swing into it or slide along the frame."""
    frame, fixed, sashes = KINDS[p.kind](p)
    if not p.hinge_left:
        sashes, fixed = sashes.mirrored(), [mirrored_body(body) for body in fixed]
    base = [*frame.members(), *fixed, *sashes.base]
    base.append(frame.board(SILL, reach=p.board_reach, ears=p.ears))
    if p.drip:
        base.append(frame.drip(SHEET))
    if p.trim:
        base += frame.trim(replace(SILL, edge=0.002), width=p.trim_width, proud=0.016)
    parts = (DraftPart(name="base", label="base", bodies=tuple(base)), *sashes.parts)
    names = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="window",
        parts=parts,
        joints=sashes.joints,
        surfaces=tuple(spec for role, spec in surfaces.items() if role in names),
        preconditions=sashes.rules,
    )


def _fittings(p: WindowParams) -> Fittings:
    return Fittings(
        style=p.handle,
        length=p.handle_length,
        share=p.handle_share,
        metal=METAL,
        turning=p.handle_friction,
        swinging=p.friction,
        sliding=p.slide_friction,
    )


def _turning(p: WindowParams) -> Made:
    """One or two sashes that overlap the frame, under a fixed light by choice."""
    rear = p.sash_depth - BEFORE - p.lip + 0.003
    frame = frame_of(p, max(p.frame_depth, rear + 0.016))
    light = frame.opening
    fixed: list[Body] = []
    if p.fanlight:
        light, fixed = _below_fanlight(p, frame)
    mullion = 0.052 if p.kind == "casement_pair" and p.mullion else None
    for cell in _cells(light, mullion):
        fixed += frame.ledges(cell, rear, frame.depth, AIR + 0.010)
        fixed.append(frame.gasket(cell, y=0.0, width=-0.003, thick=0.0013))
    if mullion is not None:
        half = mullion / 2.0
        fixed.append(frame.divider((-half, light.z0), (half, light.z1)))
    opening = math.radians(p.tilt_deg if p.kind == "tilt" else p.opening_deg)
    maker, fit = sash_maker(p), _fittings(p)
    if p.kind == "casement_pair":
        return frame, fixed, pair_of_sashes(
            maker, fit, light, lip=p.lip, depth=p.sash_depth, opening=opening, mullion=mullion
        )  # fmt: skip
    sash = swinging_sash(
        maker, fit, light, name="sash", lip=p.lip, depth=p.sash_depth, opening=opening,
        tilts=p.kind == "tilt",
    )  # fmt: skip
    return frame, fixed, sash


def _cells(light: Rect, mullion: float | None) -> tuple[Rect, ...]:
    if mullion is None:
        return (light,)
    return replace(light, x1=-mullion / 2.0), replace(light, x0=mullion / 2.0)


def _below_fanlight(p: WindowParams, frame: WindowFrame) -> tuple[Rect, list[Body]]:
    """What the fixed light leaves below a transom, and both of these."""
    o, half = frame.opening, 0.026
    z = o.z1 - p.fanlight_share * o.height
    above = replace(o, z0=z + half)
    transom = frame.divider((o.x0, z - half), (o.x1, z + half))
    maker = replace(sash_maker(p), bars=(p.standing_bars, 0), member=0.022)
    rear = min(frame.depth - 0.006, 0.006 + p.sash_depth)
    return replace(o, z1=z - half), [transom, *maker.sash(above, 0.006, rear)]


def _tracked(p: WindowParams) -> tuple[WindowFrame, list[Body], Rect]:
    """A frame with stops before, between and behind two planes."""
    (near, inner), (outer, far) = planes(p.sash_depth)
    frame = frame_of(p, max(p.frame_depth, far + 0.014))
    o = frame.opening
    fixed = [
        *frame.ledges(o, 0.0, near - 0.0015, 0.012),
        *frame.ledges(o, inner + 0.0015, outer - 0.0015, 0.010),
        *frame.ledges(o, far + 0.0015, frame.depth, 0.012),
    ]
    return frame, fixed, o


def _double_hung(p: WindowParams) -> Made:
    frame, fixed, o = _tracked(p)
    maker, fit = sash_maker(p), _fittings(p)
    return frame, fixed, hung_sashes(maker, fit, o, depth=p.sash_depth, travel=p.travel)


def _sliding(p: WindowParams) -> Made:
    frame, fixed, o = _tracked(p)
    sashes = sliding_sashes(
        sash_maker(p), _fittings(p), o, depth=p.sash_depth, travel=p.travel,
        rear_slides=p.rear_slides,
    )  # fmt: skip
    return frame, fixed, sashes


KINDS: Mapping[str, Callable[[WindowParams], Made]] = {
    "casement": _turning,
    "casement_pair": _turning,
    "tilt": _turning,
    "double_hung": _double_hung,
    "sliding": _sliding,
}
