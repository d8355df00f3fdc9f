"""Only what the surfaces call for is computed."""

import math

import pytest

from artgen.core.surface import SurfaceSpec
from artgen.render_job import LightRig, Sky, Transport
from artgen.transport import needed_transport


def surface(**values: float) -> SurfaceSpec:
    return SurfaceSpec(name="s", recipe="plain", **values)


DARK = Sky(nadir=(0.0,) * 3, horizon=(0.0,) * 3, zenith=(0.0,) * 3)
RIG = LightRig(name="none", lights=(), sky=DARK)


def derived(surfaces: list[SurfaceSpec]) -> Transport:
    return needed_transport(surfaces, RIG)


def test_opaque_surfaces_call_for_no_transmission() -> None:
    transport = derived([surface()])
    assert (transport.transmission, transport.transparent, transport.panes) == (0, 1, ())


def test_a_clear_pane_is_thin_glass_without_refraction() -> None:
    transport = derived([surface(transmission=1.0, roughness=0.0, ior=1.45)])
    assert transport.transmission == 0
    assert transport.transparent >= 4
    assert [(pane.surface, pane.ior) for pane in transport.panes] == [("s", 1.45)]


def test_frosted_glass_is_traced() -> None:
    transport = derived([surface(transmission=1.0, roughness=0.5)])
    assert transport.transmission > 0
    assert transport.panes == ()


def test_metal_calls_for_mirrors_in_mirrors() -> None:
    assert derived([surface(metallic=1.0)]).glossy > derived([surface()]).glossy


def test_every_effect_says_why_it_is_on_or_off() -> None:
    for transport in (derived([surface()]), derived([surface(metallic=1.0, subsurface=0.01)])):
        told = transport.described()
        assert set(transport.reasons) == set(told)
        assert all(isinstance(entry["on"], bool) and entry["why"] for entry in told.values())


def test_an_absorbing_body_turns_white_light_to_its_color() -> None:
    body = SurfaceSpec(
        name="jelly",
        recipe="plain",
        color=(0.1, 0.5, 1.0),
        transmission=1.0,
        roughness=0.0,
        attenuation=0.2,
    )
    (absorption,) = derived([body]).absorbing
    left = [math.exp(-density * 0.2) for density in absorption.density]
    assert left == pytest.approx(body.color, rel=1e-12)


def test_clear_or_thin_glass_absorbs_nothing() -> None:
    clear = surface(transmission=1.0, attenuation=0.2)
    white = SurfaceSpec(
        name="s", recipe="plain", color=(1.0,) * 3, transmission=1.0, attenuation=0.2
    )
    assert derived([clear]).absorbing
    assert derived([white]).absorbing == ()
    assert derived([surface(transmission=1.0, roughness=0.0)]).absorbing == ()
