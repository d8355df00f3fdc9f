"""The light transport that a scene calls for, derived from its surfaces, its lights and what was
asked for.

Bounces that nothing uses cost nothing and change no bit; what costs is what shaders, lamps and
motion add. `artgen study effects` measures both, docs/rendering.md shows it.
"""

import math
from collections.abc import Sequence

from artgen.core.surface import SurfaceSpec
from artgen.render_job import Absorption, LightRig, Relief, Subsurface, ThinGlass, Transport

PANE_ROUGHNESS = 0.3
"""Rougher glass scatters what is behind it, so it is traced as a refracting body."""
CLEAR = 0.5
"""Surfaces that transmit more than this are glass."""
DARKEST = 1e-3
"""Least linear color of an absorbing body; black glass would absorb without end."""
SEVERAL_LAMPS = 2
"""Lamps from which a tree chooses among them: with two, noise falls by a third for a fifth more
time; with one there is no choice. Without a tree, Cycles chooses by the order of lamps in memory,
which depends on what the process rendered before."""


def needed_transport(
    surfaces: Sequence[SurfaceSpec], rig: LightRig, *, motion_blur: bool = False
) -> Transport:
    """The cheapest settings that show this scene right, each with its reason.

    Args:
        motion_blur: asked for; it follows from no surface.
    """
    glass = [surface for surface in surfaces if surface.transmission > CLEAR]
    panes = [s for s in glass if s.roughness < PANE_ROUGHNESS and not s.attenuation]
    bodies = [surface for surface in glass if surface not in panes]
    tinted = [s for s in bodies if s.attenuation and min(s.color) < 1.0]
    metals = [surface for surface in surfaces if surface.metallic > 0.5]
    soft = [surface for surface in surfaces if surface.subsurface]
    carved = [surface for surface in surfaces if surface.relief]
    lamps = len(rig.lights) + sum(surface.emission > 0.0 for surface in surfaces)
    return Transport(
        diffuse=3,
        glossy=3 if metals else 1,
        transmission=8 if bodies else 0,
        transparent=8 if panes else 1,  # four panes, two faces each; 0 changes opaque scenes too
        clamp_indirect=10.0,
        panes=tuple(_pane(surface) for surface in panes),
        subsurface=tuple(Subsurface(surface=s.name, depth=s.subsurface) for s in soft),
        absorbing=tuple(_absorption(surface) for surface in tinted),
        relief=tuple(Relief(surface=s.name, height=s.relief, size=s.relief_size) for s in carved),
        reflective_caustics=bool(metals),
        refractive_caustics=bool(bodies),
        light_tree=lamps >= SEVERAL_LAMPS,
        motion_blur=motion_blur,
        reasons={
            "transmission": _why(bodies, "refract", "no surface refracts"),
            "thin_glass": _why(panes, "are smooth clear panes", "no surface is a clear pane"),
            "glossy": _why(metals, "mirror what is mirrored", "coats mirror once"),
            "reflective_caustics": _why(metals, "light what is matte", "coats throw little light"),
            "refractive_caustics": _why(bodies, "let light in by refraction", "nothing refracts"),
            "subsurface": _why(soft, "scatter below", "no surface scatters below"),
            "volume": _why(tinted, "absorb inside", "no body absorbs inside"),
            "displacement": _why(carved, "are carved", "no surface is carved"),
            "motion_blur": "asked for" if motion_blur else "not asked for",
            "light_tree": f"{lamps} lamps; there is a choice from {SEVERAL_LAMPS} on",
        },
    )


def _why(causes: Sequence[SurfaceSpec], which: str, otherwise: str) -> str:
    names = ", ".join(sorted(surface.name for surface in causes))
    return f"{names}: {which}" if names else otherwise


def _pane(surface: SurfaceSpec) -> ThinGlass:
    return ThinGlass(
        surface=surface.name, ior=surface.ior, tint=surface.color, roughness=surface.roughness
    )


def _absorption(surface: SurfaceSpec) -> Absorption:
    """White light has turned to the surface's color after `attenuation` m, by Beer's law."""
    red, green, blue = (
        -math.log(min(1.0, max(DARKEST, value))) / surface.attenuation for value in surface.color
    )
    return Absorption(surface=surface.name, density=(red, green, blue))
