"""Laws of the linkage of folding chairs, of balanced arms, and of casters' contact pieces."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from artgen.articulation.types import Body, Limit
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.caster import Caster, CasterLook, quarter_placed
from artgen.generators.kit.fold_linkage import FoldLinkage
from artgen.generators.kit.spring_balance import balanced
from artgen.geometry.solid import Solid, box, union

ANGLES = {"lean": st.floats(0.38, 0.50), "rake": st.floats(0.50, 0.68)}


def turned(point: Floats, about: tuple[float, float], angle: float) -> Floats:
    """(y, z) turned about a point, from y towards z."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.asarray(about + np.array(((cos, -sin), (sin, cos))) @ (point - np.array(about)))


@given(share=st.floats(0.0, 1.0), **ANGLES)
def test_the_sliding_pin_stays_within_its_groove(share: float, lean: float, rake: float) -> None:
    """The pose by joints (legs about the crossing, seat about the hinge) puts the pin where the
    linkage says; its course is sampled at 61 places, between which it strays by under 0.1 mm."""
    link = FoldLinkage(height=0.42, lean=lean, rake=rake, arm=0.16)
    q = share * link.spread
    on_legs = turned(np.array(link.pin), link.hinge, link.ratio * q)
    pin = turned(on_legs, link.cross, -q)
    away = pin - np.array(link.cross)
    along = np.array((math.sin(lean), math.cos(lean)))
    before = -(away @ np.array((along[1], -along[0])))
    (near, far), (behind, ahead) = link.slide, link.stray
    assert near - 1e-4 <= away @ along <= far + 1e-4
    assert behind - 1e-4 <= before <= ahead + 1e-4
    assert ahead - behind < 0.012


@given(**ANGLES)
def test_folded_it_lies_in_one_line(lean: float, rake: float) -> None:
    """Hinge and pin come to lie on the frame's line; four roundings of 1 m are 1e-15."""
    link = FoldLinkage(height=0.42, lean=lean, rake=rake, arm=0.16)
    hinge = turned(np.array(link.hinge), link.cross, -link.spread)
    pin = turned(turned(np.array(link.pin), link.hinge, link.ratio * link.spread), link.cross,
                 -link.spread)  # fmt: skip
    assert np.abs(hinge - link.on_frame(link.arm)).max() < 1e-14
    assert np.abs(pin - link.on_frame(link.arm + link.run)).max() < 1e-14


@given(y=st.floats(-0.4, 0.4), z=st.floats(-0.1, 0.4), upper=st.floats(0.2, 1.3))
def test_friction_holds_what_the_spring_leaves(y: float, z: float, upper: float) -> None:
    solid = box((0.1, 0.1, 0.1), at=(0.0, y, z))
    body = Body(solid=solid, surface="s", density=800.0)
    limit = Limit(lower=0.0, upper=upper)
    held = balanced([body], pivot=(0.0, 0.0, 0.0), sign=-1.0, limit=limit, least=0.01)
    for q in np.linspace(0.0, upper, 7):
        at = solid.turned("x", -float(q))
        pull = 0.8 * 9.81 * float(at.bounds[:, 1].mean())  # about -x
        spring = held.spring.stiffness * (held.spring.reference - float(q))
        assert abs(pull + spring) < held.friction


def test_a_wheel_stands_on_a_side_of_its_polygon() -> None:
    """The hull of its cuboids is a polygon of twelve equal sides that touches the floor."""
    stock = Stock(surface="s", density=1000.0)
    caster = Caster(radius=0.025, width=0.05, trail=0.018, stem=0.016)
    look = CasterLook(hood=stock, tread=stock, hub=stock, stem=stock)
    place = quarter_placed((0.1, 0.2, 0.0), 1)
    wheel = caster.wheel_part("wheel", place, look)
    pieces = [piece for body in wheel.bodies for piece in body.collision]
    hull: Solid = union(pieces).hull()
    assert abs(hull.bounds[0, 2]) < 1e-12
    reach = caster.radius / math.cos(math.pi / 12.0)
    area = 12.0 * 0.5 * reach**2 * math.sin(math.pi / 6.0)
    assert abs(hull.volume / (area * caster.width) - 1.0) < 1e-9
