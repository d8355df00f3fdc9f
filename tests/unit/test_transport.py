"""Only what the surfaces call for is computed."""

from artgen.core.surface import SurfaceSpec
from artgen.transport import needed_transport


def surface(**values: float) -> SurfaceSpec:
    return SurfaceSpec(name="s", recipe="plain", **values)


def test_opaque_surfaces_call_for_no_transmission() -> None:
    transport = needed_transport([surface()])
    assert (transport.transmission, transport.transparent, transport.panes) == (0, 1, ())


def test_a_clear_pane_is_thin_glass_without_refraction() -> None:
    transport = needed_transport([surface(transmission=1.0, roughness=0.0, ior=1.45)])
    assert transport.transmission == 0
    assert transport.transparent >= 4
    assert [(pane.surface, pane.ior) for pane in transport.panes] == [("s", 1.45)]


def test_frosted_glass_is_traced() -> None:
    transport = needed_transport([surface(transmission=1.0, roughness=0.5)])
    assert transport.transmission > 0
    assert transport.panes == ()


def test_metal_calls_for_mirrors_in_mirrors() -> None:
    assert needed_transport([surface(metallic=1.0)]).glossy > needed_transport([surface()]).glossy
