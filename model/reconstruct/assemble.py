"""Predicted parts and joints to an ArticulatedObject, by the same finishing as every asset.

Order: surfaces become closed solids; parts are moved apart at rest; ways are freed, shortened or
made to wait; canonical order names the parts; contact, weights and forces are added; `finish` does
the rest, and the colors become one image on its atlas.
"""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.canonical import (
    canonical_order,
    canonical_pivot,
    canonicalize,
    part_bounds,
)
from artgen.articulation.types import (
    ArticulatedObject,
    Body,
    Draft,
    DraftPart,
    Joint,
    Limit,
    State,
    Vector,
)
from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.finish import finish
from artgen.geometry.solid import Solid
from artgen.textures.images import Image, TextureSet
from model.reconstruct.apart import Cutter, apart_at_rest, clear_ways
from model.reconstruct.contact import contact_pieces
from model.reconstruct.guess import ColorAt, ObjectGuess, PartGuess, Told
from model.reconstruct.joints import CleanJoint, clean_joint, parents_first
from model.reconstruct.physics import DENSITY, LEAST, forces, weights
from model.reconstruct.rescue import unblocked
from model.reconstruct.scene import Scene
from model.reconstruct.seating import seated
from model.reconstruct.sense import sensible
from model.reconstruct.shapes import shape_of
from model.reconstruct.skin import PaintOver, colored, moved_color, nearest_part
from model.reconstruct.substance import settled

CATEGORY = "reconstructed"
CLEARANCE = 1e-3
"""m of air between parts at rest; half of what joinery leaves around a door."""
TOLERANCE = 1e-3
"""Of the radius: how far merging triangles may move a surface."""
MOST_TRIANGLES = 6000
"""Of all parts before they are cut; 15,000 in a bundle weigh 3 MB."""
MOST_HULLS = 19
"""Files that a bundle has room for beside its meshes: 30, of which 10 are others, one is spare."""
NEAR = 0.02
"""Of the radius: a point nearer to a predicted surface than this has the field's own color."""
Overlay = Callable[[ArticulatedObject, Floats, Sequence[State]], PaintOver]
"""A finished object without colors, its shift and the images' states, to what is painted over it.
"""
BARE = SurfaceSpec(name="skin", recipe="plain")


@dataclass(frozen=True, kw_only=True)
class Wishes:
    """How an object is put together.

    Attributes:
        asset_id: names its files.
        category: of the bundle; one with a rule is held to the rule's sizes.
        clearance: m of air between parts at rest.
        density: kg/m3, of all parts.
    """

    asset_id: str = "reconstruction"
    category: str = CATEGORY
    clearance: float = CLEARANCE
    density: float = DENSITY


@dataclass(frozen=True, kw_only=True, eq=False)
class Assembled:
    """The object and what it took.

    Attributes:
        images: those of its only surface, for `TextureLibrary.keep`.
        colors: part name to the predicted colors, object frame.
        names: slot to part name.
        shift: (3,) m, from the sphere's middle to the object frame.
        states: joint name to q in each state of the images, rad or m.
        changes: what differs from the prediction, a sentence each.
    """

    object: ArticulatedObject
    images: TextureSet
    colors: Mapping[str, ColorAt]
    names: Mapping[int, str]
    shift: Floats
    states: tuple[Mapping[str, float], ...]
    changes: tuple[str, ...]

    @property
    def color(self) -> Image:
        """(S, S, 3) uint8 sRGB on the atlas."""
        if self.images.color is None:
            raise ModelError("a reconstruction has no color image; color it first")
        return self.images.color


def assemble(
    guess: ObjectGuess,
    wishes: Wishes,
    *,
    provenance: Mapping[str, object] | None = None,
    overlay: Overlay | None = None,
) -> Assembled:
    """The object that was predicted, disjoint, weighed and colored.

    Args:
        overlay: makes what is painted over the predicted colors; None leaves those.

    Raises:
        ModelError: the base is missing. GeometryError: a part vanishes inside others.
    """
    if not guess.parts or guess.parts[0].slot != 0:
        raise ModelError("the prediction has no base in slot 0; nothing can hang on it")
    joints = parents_first([clean_joint(joint) for joint in guess.joints])
    solids, told = _solids(guess, {joint.guess.slot: joint.guess.parent for joint in joints})
    names = _names(solids)
    for joint in joints:
        told += [(joint.guess.slot, change) for change in joint.changes]
    scene = Scene(
        solids={names[slot]: solids[slot] for slot in names},
        joints=tuple(_stated(joint, names) for joint in joints),
        changes=tuple(f"{names.get(slot, f'slot {slot}')}: {text}" for slot, text in told),
    )
    cutter = Cutter(wishes.clearance)
    scene = unblocked(seated(apart_at_rest(scene, cutter)))
    scene = settled(clear_ways(scene, cutter))
    order = _in_order(scene)
    scene = scene.renamed(order)
    names = {slot: order.get(name, name) for slot, name in names.items()}
    draft = _draft(scene, wishes)
    placed = canonicalize(draft)
    shift = part_bounds(placed.parts[0])[0] - part_bounds(draft.parts[0])[0]
    bare = finish(
        placed,
        asset_id=wishes.asset_id,
        rounder=lambda bodies: [],
        provenance={**(provenance or {}), "changes": list(scene.changes)},
    )
    held = {slot: scene.piece_of(name) for slot, name in names.items()}
    colors = _colors(guess, held, shift)
    states = _states(joints, scene, names)
    over = None if overlay is None else overlay(bare, shift, states)
    whole, images = colored(bare, colors, over=over)
    return Assembled(
        object=whole,
        images=images,
        colors=colors,
        names=held,
        shift=shift,
        states=states,
        changes=scene.changes,
    )


def _solids(guess: ObjectGuess, carriers: Mapping[int, int]) -> tuple[dict[int, Solid], list[Told]]:
    """Slot to solid, the base first; parts that do not move become pieces of the base.

    Args:
        carriers: moving slot to the slot that carries it.
    """
    told = list(guess.told)
    share = MOST_TRIANGLES // (len(guess.parts) + 1)
    budgets = {part.slot: share * (2 if part.slot == 0 else 1) for part in guess.parts}
    found: dict[int, Solid] = {}
    for part in guess.parts:
        shape = shape_of(part, tolerance=TOLERANCE * guess.radius, triangles=budgets[part.slot])
        told += [(part.slot, change) for change in shape.changes]
        found[part.slot] = shape.solid
    guesses = {part.slot: part for part in guess.parts}
    found, replaced = sensible(found, guesses, budgets, carriers)
    solids = {slot: solid for slot, solid in found.items() if slot == 0 or slot in carriers}
    for slot in found.keys() - solids.keys():
        solids[0] = solids[0] | found[slot]
        told.append((slot, "it does not move and became a piece of the base"))
    return solids, told + replaced


def _names(solids: Mapping[int, Solid]) -> dict[int, str]:
    """Slot to name, in canonical order: base, part_1, part_2 ..."""
    slots = list(solids)
    order = canonical_order([solids[slot].bounds for slot in slots])
    return {slots[k]: "base" if place == 0 else f"part_{place}" for place, k in enumerate(order)}


def _in_order(scene: Scene) -> dict[str, str]:
    """Part name to the name that its place in canonical order gives it, now that it is cut."""
    places = canonical_order([solid.bounds for solid in scene.solids.values()])
    names = list(scene.solids)
    movers = sorted(names[1:], key=lambda name: int(name.rpartition("_")[2]))
    return {names[k]: new for k, new in zip(places, [names[0], *movers], strict=True)}


def _stated(joint: CleanJoint, names: Mapping[int, str]) -> Joint:
    """The joint with its geometry; forces come when the weights are known."""
    name = names[joint.guess.slot]
    return canonical_pivot(
        Joint(
            name=f"{name}_joint",
            type="continuous" if joint.endless else joint.guess.type,
            parent=names[joint.guess.parent],
            child=name,
            axis=_vector(joint.axis),
            origin=_vector(joint.origin),
            limit=None if joint.endless else Limit(lower=joint.lower, upper=joint.upper),
            friction=0.0,
            damping=0.0,
            effort=LEAST,
        )
    )


def _vector(values: Floats) -> Vector:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z


def _draft(scene: Scene, wishes: Wishes) -> Draft:
    """Parts of one body each, with contact; joints with forces."""
    heavy = weights(scene.solids, wishes.density)
    joints = []
    for joint in scene.joints:
        found = forces(joint, scene.joints, heavy, scene.base)
        joints.append(dataclasses.replace(joint, **dataclasses.asdict(found)))
    slanted = max(1, MOST_HULLS // len(scene.solids) - 1)
    parts = tuple(
        DraftPart(
            name=name,
            label="base" if name == scene.base else "part",
            bodies=(
                Body(
                    solid=solid,
                    surface=BARE.name,
                    density=wishes.density,
                    collision=contact_pieces(solid, slanted=slanted),
                ),
            ),
        )
        for name, solid in scene.solids.items()
    )
    return Draft(
        category=wishes.category,
        parts=parts,
        joints=tuple(joints),
        surfaces=(BARE,),
        preconditions=scene.rules,
    )


def _colors(guess: ObjectGuess, names: Mapping[int, str], shift: Floats) -> dict[str, ColorAt]:
    """Part name to its colors in the object frame; pieces of the base share its name."""
    found: dict[str, list[PartGuess]] = {}
    for part in guess.parts:
        found.setdefault(names.get(part.slot, names[0]), []).append(part)
    reach = NEAR * guess.radius
    return {name: moved_color(nearest_part(own, reach), shift) for name, own in found.items()}


def _states(
    joints: list[CleanJoint], scene: Scene, names: Mapping[int, str]
) -> tuple[dict[str, float], ...]:
    """q of every joint in each state of the images, within the ways that were left."""
    count = min((len(joint.observed) for joint in joints), default=0)
    states: list[dict[str, float]] = [{} for _ in range(count)]
    left = {joint.name for joint in scene.joints}
    for joint in joints:
        name = f"{names[joint.guess.slot]}_joint"
        if name not in left:
            continue
        limit = scene.joint(name).limit
        for state, q in zip(states, joint.observed.tolist(), strict=False):
            state[name] = q if limit is None else float(np.clip(q, limit.lower, limit.upper))
    return tuple(states)
