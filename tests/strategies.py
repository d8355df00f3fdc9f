"""Hypothesis strategies and ready-made objects: joints, trees, meshes, ArticulatedObjects.

Strategies draw every number by hypothesis, so that failures shrink. The ready-made objects are
small closed boxes with exact masses, for tests that need real geometry and no builder.
"""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np
from hypothesis import strategies as st

from artgen.articulation.types import (
    ArticulatedObject,
    Grip,
    Joint,
    JointType,
    Latch,
    Limit,
    Mass,
    Mimic,
    Part,
    Precondition,
    Spring,
    Vector,
)
from artgen.core.mesh import Floats, TriMesh
from artgen.core.rotation import axis_angle_matrix
from artgen.core.surface import SurfaceSpec
from artgen.geometry.measure import combined, moments
from artgen.geometry.solid import Solid, hull, slab
from artgen.geometry.unwrap import metric_uv

Corners = tuple[Vector, Vector]
DENSITY = 700.0
"""kg/m3; wood."""

WOOD = SurfaceSpec(name="wood", recipe="plain", color=(0.5, 0.3, 0.1), tile=(0.4, 0.25))
STEEL = SurfaceSpec(
    name="steel", recipe="plain", color=(0.6, 0.6, 0.6), metallic=1.0, roughness=0.3
)


# ------------------------------------------------------------------------------------- strategies


def coordinates(reach: float = 2.0) -> st.SearchStrategy[float]:
    """Metres, on the grid of 1e-7 m on which finished vertices lie."""
    steps = round(reach * 1e7)
    return st.integers(-steps, steps).map(lambda step: step / 1e7)


def vectors(reach: float = 2.0) -> st.SearchStrategy[Vector]:
    """Points within a cube of half side `reach` m."""
    return st.tuples(coordinates(reach), coordinates(reach), coordinates(reach))


def unit(values: Sequence[float]) -> Vector:
    """`values` over their length, so that the norm is 1 within two roundings."""
    norm = math.sqrt(sum(v * v for v in values))
    x, y, z = (v / norm for v in values)
    return x, y, z


def axes() -> st.SearchStrategy[Vector]:
    """Unit vectors in three regimes: coordinate axes, 1e-7 off them, and anywhere."""
    exact = st.sampled_from(
        [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0),
         (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    )  # fmt: skip
    tilt = st.floats(-1e-7, 1e-7)
    near = st.tuples(exact, tilt, tilt, tilt).map(
        lambda t: unit((t[0][0] + t[1], t[0][1] + t[2], t[0][2] + t[3]))
    )
    component = st.floats(-1.0, 1.0)
    anywhere = st.tuples(component, component, component).filter(
        lambda v: math.sqrt(sum(c * c for c in v)) > 0.05
    )
    return st.one_of(exact, near, anywhere.map(unit))


def limits(reach: float) -> st.SearchStrategy[Limit]:
    """Non-empty travel around rest, up to `reach` to either side; mostly closed at 0."""
    lower = st.one_of(st.just(0.0), st.floats(-reach, -1e-3))
    return st.tuples(lower, st.floats(1e-3, reach)).map(lambda t: Limit(lower=t[0], upper=t[1]))


@st.composite
def joints(draw: st.DrawFn, *, name: str, parent: str, child: str) -> Joint:
    """Any joint between two given parts, without mimic."""
    kind: JointType = draw(st.sampled_from(["revolute", "prismatic", "continuous"]))
    reach = 3.0 if kind == "revolute" else 0.8
    amount = st.floats(0.0, 50.0)
    spring = st.builds(Spring, stiffness=st.floats(0.1, 50.0), reference=st.floats(-1.0, 1.0))
    latch = st.builds(Latch, force=st.floats(0.1, 50.0), reach=st.floats(1e-3, 0.5))
    limit = None if kind == "continuous" else draw(limits(reach))
    shuts = limit is not None and limit.lower == 0.0
    return Joint(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        axis=draw(axes()),
        origin=draw(vectors()),
        limit=limit,
        friction=draw(amount),
        damping=draw(amount),
        effort=draw(st.floats(0.5, 200.0)),
        velocity=draw(st.floats(0.1, 10.0)),
        spring=draw(st.none() | spring),
        latch=draw(st.none() | latch) if shuts else None,
    )


@st.composite
def trees(draw: st.DrawFn, *, most: int = 5) -> tuple[Joint, ...]:
    """Joints of a tree of 2 to `most` parts named part_0 (the base), part_1, ...; parents first.

    A later joint may follow an earlier, independent one as a mimic.
    """
    count = draw(st.integers(2, most))
    grown: list[Joint] = []
    for index in range(1, count):
        parent = draw(st.integers(0, index - 1))
        joint = draw(joints(name=f"joint_{index}", parent=f"part_{parent}", child=f"part_{index}"))
        if grown and grown[-1].mimic is None and draw(st.booleans()):
            multiplier = draw(st.floats(-2.0, 2.0))
            joint = _following(joint, Mimic(joint=grown[-1].name, multiplier=multiplier))
        grown.append(joint)
    return tuple(grown)


def _following(joint: Joint, mimic: Mimic) -> Joint:
    fields = {name: getattr(joint, name) for name in joint.__dataclass_fields__}
    return Joint(**fields | {"mimic": mimic})


@st.composite
def masses(draw: st.DrawFn) -> Mass:
    """A rigid body's mass, center and full tensor: a point cloud's second moments, turned."""
    mass = draw(st.floats(1e-3, 100.0))
    a, b, c = (draw(st.floats(1e-3, 1.0)) for _ in range(3))
    turn = axis_angle_matrix(draw(axes()), draw(st.floats(-math.pi, math.pi)))
    principal = mass * np.array([b * b + c * c, a * a + c * c, a * a + b * b])
    tensor = (turn * principal) @ turn.T
    return Mass(mass=mass, center=np.array(draw(vectors())), inertia=(tensor + tensor.T) / 2.0)


@st.composite
def boxes(draw: st.DrawFn) -> Corners:
    """Lower and upper corner of a cuboid with sides of 1 mm to 1 m, m."""
    low = draw(vectors(1.0))
    sides = [draw(st.integers(10_000, 10_000_000)) / 1e7 for _ in range(3)]
    x, y, z = (round(a + side, 7) for a, side in zip(low, sides, strict=True))
    return low, (x, y, z)


@st.composite
def meshes(draw: st.DrawFn) -> TriMesh:
    """One to three closed boxes with both UV sets and one or two surfaces."""
    corners = draw(st.lists(boxes(), min_size=1, max_size=3))
    slots = [draw(st.integers(0, 1)) for _ in corners]
    return mesh_of(corners, slots=slots)


@st.composite
def objects(draw: st.DrawFn, *, most: int = 5) -> ArticulatedObject:
    """Any tree of box-shaped parts with arbitrary valid masses."""
    tree = draw(trees(most=most))
    names = ["part_0", *(joint.child for joint in tree)]
    parts = []
    for name in names:
        mesh = draw(meshes())
        corners = draw(boxes())
        collision = (piece(slab(*corners)), wedge(corners))[: draw(st.integers(1, 2))]
        parts.append(
            Part(name=name, label="thing", mesh=mesh, collision=collision, mass=draw(masses()))
        )
    return _object("strange_000001", parts, tree)


@st.composite
def states(draw: st.DrawFn, tree: tuple[Joint, ...]) -> dict[str, float]:
    """q of every independent joint, within its limits (a turn either way where it has none)."""
    return {
        joint.name: draw(
            st.floats(-2 * math.pi, 2 * math.pi)
            if joint.limit is None
            else st.floats(joint.limit.lower, joint.limit.upper)
        )
        for joint in tree
        if joint.mimic is None
    }


# ------------------------------------------------------------------------------ ready-made pieces


def piece(solid: Solid) -> TriMesh:
    """A collision mesh, rounded as finishing does."""
    mesh = solid.trimesh()
    return TriMesh(vertices=np.round(mesh.vertices, 7) + 0.0, faces=mesh.faces)


def wedge(corners: Corners) -> TriMesh:
    """Half of a cuboid, cut along a diagonal: convex and no box."""
    (x0, y0, z0), (x1, y1, z1) = corners
    return piece(hull([(x, y0, z) for x, z in ((x0, z0), (x1, z0), (x0, z1))]
                      + [(x, y1, z) for x, z in ((x0, z0), (x1, z0), (x0, z1))]))  # fmt: skip


def mesh_of(corners: Sequence[Corners], *, slots: Sequence[int] | None = None) -> TriMesh:
    """Closed boxes as the bodies of one finished mesh."""
    vertices, faces, uv, start = [], [], [], 0
    for index, (low, high) in enumerate(corners):
        mesh = piece(slab(low, high))
        vertices.append(mesh.vertices)
        faces.append(mesh.faces + start)
        uv.append(metric_uv(mesh.vertices, mesh.faces, grain=None, place=index))
        start += len(mesh.vertices)
    count = [len(f) for f in faces]
    return TriMesh(
        vertices=np.concatenate(vertices),
        faces=np.concatenate(faces),
        uv=np.concatenate(uv),
        atlas=grid_atlas(sum(count)),
        slot=np.repeat([0] * len(corners) if slots is None else list(slots), count),
        body=np.repeat(np.arange(len(corners)), count),
    )


def grid_atlas(triangles: int) -> Floats:
    """(F, 3, 2) atlas with one cell of a square grid a triangle: inside, and without overlap."""
    side = math.ceil(math.sqrt(triangles))
    cell = np.stack(np.divmod(np.arange(triangles), side), axis=1)[:, None, :]
    shape = np.array([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]])
    return np.asarray(np.round((cell + shape) / side, 6))


def box_part(name: str, corners: Sequence[Corners], *, slots: Sequence[int] | None = None) -> Part:
    """A part of boxes with its exact mass at 700 kg/m3 and one collision piece a box."""
    mesh = mesh_of(corners, slots=slots)
    pieces = [(DENSITY, moments(piece(slab(low, high)).triangles)) for low, high in corners]
    mass, center, inertia = combined(pieces)
    return Part(
        name=name,
        label=name.rstrip("_0123456789"),
        mesh=mesh,
        collision=tuple(piece(slab(low, high)) for low, high in corners),
        mass=Mass(mass=mass, center=center, inertia=inertia),
    )


def with_grips(part: Part, *grips: Grip) -> Part:
    """A part that can be taken hold of."""
    return dataclasses.replace(part, grips=grips)


def _object(
    asset_id: str,
    parts: Sequence[Part],
    tree: Sequence[Joint],
    preconditions: tuple[Precondition, ...] = (),
) -> ArticulatedObject:
    return ArticulatedObject(
        category=asset_id.rpartition("_")[0],
        asset_id=asset_id,
        parts=tuple(parts),
        joints=tuple(tree),
        surfaces=(WOOD, STEEL),
        preconditions=preconditions,
        provenance={
            "seed": 7,
            "index": int(asset_id.rpartition("_")[2]),
            "rule": {"version": 1, "digest": "0" * 64},
            "params": {"width": 0.4},
        },
    )


def hinge(name: str, parent: str, child: str, **changes: object) -> Joint:
    """A revolute joint about +x at the back edge of a 0.4 m chest, with changes."""
    fields: dict[str, object] = {
        "name": name, "type": "revolute", "parent": parent, "child": child,
        "axis": (1.0, 0.0, 0.0), "origin": (0.0, 0.15, 0.2), "limit": Limit(lower=0.0, upper=1.9),
        "friction": 0.4, "damping": 0.05, "effort": 5.0, "velocity": 2.0,
    }  # fmt: skip
    return Joint(**fields | changes)  # type: ignore[arg-type]


def chest() -> ArticulatedObject:
    """A box with a lid: one hinge, off the origin and pointing to -x so that +q opens."""
    base = box_part("base", [((-0.2, -0.15, 0.0), (0.2, 0.15, 0.18))])
    lid = box_part(
        "lid",
        [((-0.2, -0.15, 0.182), (0.2, 0.15, 0.2)), ((-0.02, -0.16, 0.185), (0.02, -0.15, 0.195))],
        slots=[0, 1],
    )
    lid = with_grips(
        lid,
        Grip(
            name="lid_edge", kind="edge", position=(0.0, -0.16, 0.19), outward=(0.0, -1.0, 0.0),
            pull=(0.0, 0.0, 1.0),
        ),
    )  # fmt: skip
    return _object(
        "chest_000001", [base, lid], [hinge("hinge", "base", "lid", axis=(-1.0, 0.0, 0.0))]
    )


def drawer_unit() -> ArticulatedObject:
    """A frame with a drawer, a door on an oblique axis with a catch, and a knob that turns freely.

    Three-part chain base -> door -> knob, a slide, a spring, a precondition, a wedge as collision.
    """
    base = box_part(
        "base", [((-0.3, -0.2, 0.0), (0.3, 0.2, 0.02)), ((-0.3, 0.18, 0.02), (0.3, 0.2, 0.6))]
    )
    drawer = box_part("drawer", [((-0.28, -0.2, 0.03), (0.28, 0.17, 0.2))])
    door = box_part("door", [((-0.29, -0.22, 0.22), (0.29, -0.2, 0.59))])
    knob = box_part("knob", [((0.2, -0.25, 0.4), (0.23, -0.221, 0.43))], slots=[1])
    knob = Part(
        name="knob", label="knob", mesh=knob.mesh, mass=knob.mass,
        collision=(wedge(((0.2, -0.25, 0.4), (0.23, -0.221, 0.43))),),
    )  # fmt: skip
    front = (0.0, -1.0, 0.0)
    base = with_grips(base, Grip(name="carry", kind="edge", position=(0.3, 0.19, 0.6),
                                 outward=unit((1.0, 0.3, 0.2)), pull=(0.0, 0.0, 1.0)))  # fmt: skip
    drawer = with_grips(drawer, Grip(name="drawer_edge", kind="edge", position=(0.1, -0.2, 0.2),
                                     outward=front, pull=front))  # fmt: skip
    door = with_grips(
        door,
        Grip(name="door_edge", kind="edge", position=(0.29, -0.21, 0.4), outward=(1.0, 0.0, 0.0),
             pull=front),
        Grip(name="door_top", kind="rim", position=(0.2, -0.21, 0.59), outward=(0.0, 0.0, 1.0),
             pull=unit((0.1, -1.0, 0.05))),
    )  # fmt: skip
    slide = hinge(
        "slide", "base", "drawer", type="prismatic", axis=(0.0, -1.0, 0.0), origin=(0.0, 0.0, 0.0),
        limit=Limit(lower=0.0, upper=0.3), friction=12.0, effort=60.0,
    )  # fmt: skip
    swing = hinge(
        "swing", "base", "door", axis=unit((0.02, 0.01, -1.0)), origin=(-0.29, -0.2, 0.0),
        spring=Spring(stiffness=2.0, reference=-0.25), latch=Latch(force=1.5, reach=0.04),
    )  # fmt: skip
    turn = hinge("turn", "door", "knob", type="continuous", limit=None, axis=(0.0, -1.0, 0.0),
                 origin=(0.215, 0.0, 0.415))  # fmt: skip
    rule = Precondition(joint="slide", requires="swing", at_least=1.2)
    return _object("unit_000002", [base, drawer, door, knob], [slide, swing, turn], (rule,))


def linked_shelves() -> ArticulatedObject:
    """Two slides of which the second follows the first at half its travel."""
    base = box_part("base", [((-0.3, -0.2, 0.0), (0.3, 0.2, 0.02))])
    low = box_part("shelf_0", [((-0.3, -0.2, 0.03), (0.3, 0.2, 0.04))])
    high = box_part("shelf_1", [((-0.3, -0.2, 0.05), (0.3, 0.2, 0.06))])
    common = {"type": "prismatic", "axis": (0.0, -1.0, 0.0), "origin": (0.0, 0.0, 0.0)}
    lead = hinge("lead", "base", "shelf_0", limit=Limit(lower=0.0, upper=0.3), **common)
    follow = hinge(
        "follow", "base", "shelf_1", limit=Limit(lower=0.0, upper=0.2),
        mimic=Mimic(joint="lead", multiplier=0.5, offset=0.01), **common,
    )  # fmt: skip
    return _object("shelves_000003", [base, low, high], [lead, follow])


READY = {"chest": chest, "drawer_unit": drawer_unit, "linked_shelves": linked_shelves}
"""Every ready-made object by name, for parametrized tests."""
