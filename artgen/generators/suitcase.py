"""Suitcases: hard clamshells on four swiveling casters, with a telescopic handle."""

import math
from collections.abc import Mapping

from artgen.articulation.types import Body, Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import suitcase_params
from artgen.generators.kit.caster import CasterLook
from artgen.generators.kit.suitcase_fittings import hinge, latches, lid_joint, rolling, zip_lock
from artgen.generators.kit.suitcase_params import SuitcaseParams
from artgen.generators.kit.suitcase_shells import (
    badge,
    badge_surface,
    carried,
    front_half,
    rear_half,
    stocks_of,
    telescope_of,
)
from artgen.generators.kit.telescope import telescope

PARAMS = SuitcaseParams
INVARIANTS = suitcase_params.INVARIANTS


def build(p: SuitcaseParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """Standing on its wheels; the front half opens like a book about the left side."""
    front, rear = p.half(p.lid_share), p.half(1.0 - p.lid_share)
    stocks = stocks_of(p)
    handle = telescope_of(p, rear, stocks)
    works = telescope(handle) + carried(p, rear, stocks)
    look = CasterLook(
        hood=stocks["plastic"], tread=stocks["rubber"], hub=stocks["hub"], stem=stocks["metal"]
    )
    keepers: tuple[Body, ...] = ()
    if p.closure == "zip":
        works += zip_lock(rear, stocks["plastic"], stocks["metal"])
    else:
        held, keepers = latches(rear, stocks["metal"])
        works += held
    works += rolling(rear, p.caster, look, parent="base", rear=True)
    rolls = rolling(front, p.caster, look, parent="lid", rear=False)
    base = (*rear_half(p, rear, handle, stocks), *works.base, hinge(rear, stocks["plastic"]))
    lid = (*front_half(p, front, stocks), *keepers, *rolls.base, badge(p, front))
    joint = lid_joint(front, angle=math.radians(p.opening_deg), friction=p.lid_friction)
    parts = (
        DraftPart(name="base", label="base", bodies=base),
        DraftPart(name="lid", label="lid", bodies=lid),
        *works.parts,
        *rolls.parts,
    )
    used = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="suitcase",
        parts=parts,
        joints=(joint, *works.joints, *rolls.joints),
        surfaces=(*(s for role, s in surfaces.items() if role in used), badge_surface(p)),
        preconditions=works.preconditions,
    )
