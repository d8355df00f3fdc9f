"""Ink-jet printers with a scanner: cassette or rear feed, trays, a panel, works under the lid."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Draft, DraftPart, Joint, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.density import ABS
from artgen.generators.kit.printer_base import base_bodies
from artgen.generators.kit.printer_design import PrinterParams
from artgen.generators.kit.printer_panel import (
    buttons,
    fixed_panel,
    panel_joint,
    panel_part,
    panel_plane,
    panel_print,
    recess,
)
from artgen.generators.kit.printer_scanner import lid_joint, lid_part, unit_joint, unit_part
from artgen.generators.kit.printer_trays import (
    carriage_joint,
    carriage_part,
    cassette_joint,
    cassette_part,
    feed_cover,
    folding_tray,
    sliding_tray,
)

PARAMS = PrinterParams
ACCESS = 0.35
"""rad; so far the scanner unit must be open for a hand to reach the carriage."""


def build(p: PrinterParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest all is shut; lids and covers turn up, trays and drawers come to the user."""
    base = DraftPart(
        name="base",
        label="base",
        bodies=base_bodies(p, recess(p)) + (() if p.tilts else fixed_panel(p)),
    )
    parts = [base, unit_part(p), lid_part(p), carriage_part(p)]
    joints = [unit_joint(p), lid_joint(p), carriage_joint(p)]
    rules = [Precondition(joint="carriage_slide", requires="scanner_unit_hinge", at_least=ACCESS)]
    for add in (_paper, _output, _controls):
        more_parts, more_joints, more_rules = add(p)
        parts, joints, rules = parts + more_parts, joints + more_joints, rules + more_rules
    looks = matched(p, surfaces)
    worn = {body.surface for part in parts for body in part.bodies}
    specs = (*looks.values(), panel_print(p))
    return Draft(
        category="printer",
        parts=tuple(parts),
        joints=tuple(joints),
        surfaces=tuple(spec for spec in specs if spec.name in worn),
        preconditions=tuple(rules),
    )


Group = tuple[list[DraftPart], list[Joint], list[Precondition]]


def _paper(p: PrinterParams) -> Group:
    """A cassette below, or a cover over the rear feed."""
    if p.feed == "cassette":
        return [cassette_part(p)], [cassette_joint(p)], []
    part, joint = feed_cover(p)
    return [part], [joint], []


def _output(p: PrinterParams) -> Group:
    """A flap that folds down, or a plate that slides out with its stop."""
    if p.output == "fold":
        part, joint = folding_tray(p)
        return [part], [joint], []
    parts, joints, rule = sliding_tray(p)
    return parts, joints, [rule]


def _controls(p: PrinterParams) -> Group:
    """Buttons, on a panel that tilts or on the base."""
    plane, parent = panel_plane(p), "control_panel" if p.tilts else "base"
    keys = buttons(p)
    parts = [key.part(plane, "key", density=ABS) for key in keys]
    joints = [key.joint(plane, parent=parent) for key in keys]
    if p.tilts:
        parts, joints = [panel_part(p), *parts], [panel_joint(p), *joints]
    return parts, joints, []


def matched(p: PrinterParams, surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """White cases have gray trims, black ones black."""
    looks = dict(surfaces)
    if sum(looks["case"].color) / 3.0 < 0.2 and not p.two_tone:
        looks["trim"] = replace(looks["case"], name="trim")
    return looks


def stop_comes_out(p: PrinterParams) -> bool:
    """The paper stop can be raised before the sliding tray is at its end."""
    reach = min(p.tray_travel, 0.8 * (p.bay_rear - p.front - 0.025))
    return p.output == "fold" or p.stop_length + 0.036 < reach


def access_is_open(p: PrinterParams) -> bool:
    """The scanner unit opens further than a hand needs."""
    return math.radians(p.unit_deg) > ACCESS + 0.02


INVARIANTS: Mapping[str, Callable[[PrinterParams], bool]] = {
    check.__name__: check for check in (stop_comes_out, access_is_open)
}
