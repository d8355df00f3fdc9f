"""The light transport that a scene calls for, derived from its surfaces.

Measured at 192 px: bounces that nothing uses cost nothing and change no bit, but caustics cost 14 %
and refraction through panes blackens what is behind them unless every bounce is traced. So flat
panes become thin glass, and refraction is on only where a body really refracts.
"""

from collections.abc import Sequence

from artgen.core.surface import SurfaceSpec
from artgen.render_job import ThinGlass, Transport

PANE_ROUGHNESS = 0.3
"""Rougher glass scatters what is behind it, so it is traced as a refracting body."""
CLEAR = 0.5
"""Surfaces that transmit more than this are glass."""


def needed_transport(surfaces: Sequence[SurfaceSpec]) -> Transport:
    """The cheapest settings that show these surfaces right; `test_transport` states the bounds."""
    glass = [surface for surface in surfaces if surface.transmission > CLEAR]
    panes = [surface for surface in glass if surface.roughness < PANE_ROUGHNESS]
    metal = any(surface.metallic > 0.5 for surface in surfaces)
    return Transport(
        diffuse=3,
        glossy=3 if metal else 1,
        transmission=8 if len(glass) > len(panes) else 0,
        transparent=8 if panes else 1,  # four panes, two faces each; 0 changes opaque scenes too
        clamp_indirect=10.0,
        panes=tuple(
            ThinGlass(
                surface=surface.name,
                ior=surface.ior,
                tint=surface.color,
                roughness=surface.roughness,
            )
            for surface in panes
        ),
    )
