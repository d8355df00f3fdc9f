"""A template whose fronts and handles come from donors: chosen, fitted, checked, tried again."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from artgen.articulation.types import ArticulatedObject, Joint, Part, Precondition
from artgen.assembly.choice import OWN, Group, Market
from artgen.assembly.clash import Pair, clashing, template_open
from artgen.assembly.fill import Fill, Misfit, filled, grains, gripped, handle_on, middle_grip
from artgen.assembly.library import Entry
from artgen.assembly.looks import (
    Looks,
    body_surface,
    drawn_looks,
    front_surface,
    handle_surface,
    main_surfaces,
)
from artgen.assembly.piece import Piece, joined, picked, weighed
from artgen.assembly.placing import Named, placed
from artgen.assembly.plan import Plan, first_plan
from artgen.assembly.shape_hash import looks_hash, object_hash, shape_hash, tree_hash
from artgen.assembly.source import Member, Source
from artgen.assembly.surface_table import Change, SurfaceTable
from artgen.assembly.variation import edged, shortened, takes_push, with_push
from artgen.core.licence import Licence, most_restrictive
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.finish import ATLAS_RESOLUTION
from artgen.geometry.unwrap import atlas_uv

ROUNDS = 18
"""Times that an object is put together and checked before it is given up."""

Layer = Literal["body", "handle", "works"]
LAYERS: tuple[Layer, ...] = ("body", "handle", "works")


@dataclass(frozen=True, kw_only=True, eq=False)
class Assembled:
    """A new object before it is unwrapped and weighed, and what it is made from.

    Attributes:
        datasets: where its parts come from, sorted.
        sources: for each piece of each part where it comes from, as JSON: `base`, `part` (one that
            the template keeps), `front` or `whole`, `handle`, `works`.
        tried: reasons for which something else was taken before.
        seams: name of a filled part to how many of its bodies are front, handle and works.
        pushed: its fronts have no handles; they are pushed to open.
    """

    category: str
    template: str
    parts: tuple[Named, ...]
    joints: tuple[Joint, ...]
    preconditions: tuple[Precondition, ...]
    surfaces: tuple[SurfaceSpec, ...]
    licence: Licence
    donors: tuple[str, ...]
    datasets: tuple[str, ...]
    sources: tuple[Mapping[str, Any], ...]
    tried: tuple[str, ...]
    seams: Mapping[str, tuple[int, int, int]]
    pushed: bool = False

    def piece(self, name: str) -> Piece:
        """All bodies of a part."""
        return next(piece for known, _, piece in self.parts if known == name)

    def layer(self, name: str, layer: Layer) -> Piece | None:
        """The front, the handle or the works of a filled part; None where it has none."""
        counts = self.seams[name]
        place = LAYERS.index(layer)
        return picked(self.piece(name), range(sum(counts[:place]), sum(counts[: place + 1])))

    @property
    def given(self) -> list[Mapping[str, Any]]:
        """The entries of `sources` of bodies that come from donors."""
        bodies = (entry for entry in self.sources if entry["piece"] in ("front", "whole"))
        return [entry for entry in bodies if entry["source"] != self.template]

    @property
    def hashes(self) -> dict[str, str]:
        """Of tree, shapes and looks, and of the three together."""
        labels = {name: label for name, label, _ in self.parts}
        tree = tree_hash(labels, self.joints, self.parts[0][0])
        shapes = [shape_hash(piece.mesh) for _, _, piece in self.parts]
        looks = looks_hash(self.surfaces)
        boxes = [piece.bounds for _, _, piece in self.parts]
        whole = object_hash(tree, shapes, boxes, looks)
        return {"tree": tree, "looks": looks, "object": whole}


@dataclass(frozen=True, kw_only=True)
class GivenUp:
    """No object came of a template and a stream, and why."""

    template: str
    reason: str
    tried: tuple[str, ...] = ()


def assembled(market: Market, template: str, stream: Stream) -> Assembled | GivenUp:
    """A new object; depends on the library, the template's id and the stream alone."""
    source = market.library.source(template)
    groups = market.groups(template, stream.child("groups"))
    split = next(e.split for e in market.library.entries if e.source == template)
    handles = market.handle_order(split, stream.child("handles"))
    looks = drawn_looks(stream.child("looks"))
    open_before = template_open(source)
    plan = first_plan(source, groups, stream)
    if not handles:
        plan.handle = None
    plan.tried += [f"{_named(group)}: no donor suits" for group in groups if not group.donors]
    for _ in range(ROUNDS):
        slots = sum(len(group.slots) for group in groups)
        kept = sum(
            len(g.slots) for g, place in zip(groups, plan.donors, strict=True) if place is None
        )
        if not slots or kept > OWN * slots:
            reason = f"{kept} of {slots} fronts would be the template's own"
            return GivenUp(template=template, reason=reason, tried=tuple(plan.tried))
        found = _Attempt(market, source, groups, handles, looks, plan).object(open_before)
        if isinstance(found, Assembled):
            return found
    reason = f"nothing fits in {ROUNDS} rounds"
    return GivenUp(template=template, reason=reason, tried=tuple(plan.tried))


def _named(group: Group) -> str:
    return ", ".join(slot.name for slot in group.slots)


class _Attempt:
    """One round: everything put together as the plan says; faults move the plan on."""

    def __init__(
        self,
        market: Market,
        source: Source,
        groups: Sequence[Group],
        handles: Sequence[Entry],
        looks: Looks,
        plan: Plan,
    ) -> None:
        self.market, self.source, self.groups = market, source, groups
        self.handles, self.looks, self.plan = handles, looks, plan
        self.table = SurfaceTable()
        self.main = main_surfaces(source)
        self.grains = grains(source.members, source.surfaces)
        self.group_of = {s.name: k for k, g in enumerate(groups) for s in g.slots}
        self.told: list[Mapping[str, Any]] = []
        self.seams: dict[str, tuple[int, int, int]] = {}
        self.licences = [source.licence]
        self.donors = {source.family}
        self.datasets = {source.dataset}

    def object(self, open_before: Mapping[Pair, float]) -> Assembled | None:
        """The object, or None where something does not fit; the plan has then moved on."""
        parts: list[Named] = [(self.source.base_name, "base", self._base(self.source.base))]
        for member in self.source.members:
            piece = self._part(member)
            if piece is None:
                return None
            parts.append((member.name, member.label, piece))
        own = [shortened(joint, self.plan.travels) for joint in self.source.joints]
        named, joints = placed(parts, own)
        pieces = {name: piece for name, _, piece in named}
        rules = self.source.preconditions
        if clash := clashing(self.source.base_name, joints, rules, pieces, open_before):
            self._move_on(clash)
            return None
        return Assembled(
            category=self.source.category,
            template=self.source.id,
            parts=tuple(named),
            joints=tuple(joints),
            preconditions=rules,
            surfaces=tuple(self.table.surfaces),
            licence=most_restrictive(self.licences),
            donors=tuple(sorted(self.donors)),
            datasets=tuple(sorted(self.datasets)),
            sources=tuple(self.told),
            tried=tuple(self.plan.tried),
            seams=self.seams,
            pushed=self.plan.push,
        )

    def _move_on(self, clash: Pair) -> None:
        """Another handle or donor for one of two parts that meet; rounds take them in turn."""
        why = f"{clash[0]} meets {clash[1]}"
        involved = [self.group_of[name] for name in clash if name in self.group_of]
        changed = [k for k in involved if self.plan.donors[k] is not None]
        if changed and (self.plan.handle is None or len(self.plan.tried) % 2 == 0):
            self.plan.less_far(changed[0], self.groups, why)
        elif self.plan.handle is not None:
            self.plan.next_handle(len(self.handles), why)
        elif changed:
            self.plan.less_far(changed[0], self.groups, why)
        else:
            self.plan.donors = [None] * len(self.groups)  # Its own parts meet: nothing helps.
            self.plan.tried.append(why)

    def _base(self, piece: Piece) -> Piece:
        self._tell(self.source.base_name, "base", self.source, of=self.source.base_name)
        return self.table.take(piece, self.source.surfaces, self._for_body)

    def _for_body(self, surface: SurfaceSpec) -> SurfaceSpec:
        return body_surface(surface, self.main, self.looks)

    def _part(self, member: Member) -> Piece | None:
        """All bodies of a moving part; None where its donor or the handle does not fit."""
        group = self.group_of.get(member.name)
        place = None if group is None else self.plan.donors[group]
        if group is None or (member.kind == "whole" and place is None):
            change: Change = self._for_body if group is None else self._for_front
            pieces = [self.table.take(p, self.source.surfaces, change) for p in member.pieces]
            self._tell(member.name, "part", self.source, of=member.name)
            return _with_grips(joined(pieces), member)
        donor_source, donor = self.source, member
        if place is not None:
            entry = self.groups[group].donors[place]
            donor_source = self.market.library.source(entry.source)
            donor = donor_source.members[entry.number]
        try:
            grain = self.grains[member.name]
            fill = filled(member, donor, donor_source.surfaces, grain=grain)
        except Misfit as misfit:
            self.plan.next_donor(
                group, self.groups, f"{member.name} from {donor_source.id}: {misfit}"
            )
            return None
        try:
            handle = self._handle(member, donor, fill)
        except Misfit as misfit:
            why = f"{member.name} from {donor_source.id}: {misfit}"
            if self.plan.handle is None:
                self.plan.next_donor(group, self.groups, why)
            else:
                self.plan.next_handle(len(self.handles), why)
            return None
        front = fill.body
        if self.plan.push and takes_push(member, donor):
            front = with_push(front, member.side, member.name)
        taken = self.table.take(front, donor_source.surfaces, self._for_front)
        self._tell_body(member, donor_source, donor, fill)
        layers = [taken, handle, self._works(member)]
        body, knob, rest = (len(p.densities) if p else 0 for p in layers)
        self.seams[member.name] = body, knob, rest
        return _with_grips(joined([p for p in layers if p is not None]), member)

    def _works(self, member: Member) -> Piece | None:
        if member.works is None:
            return None
        self._tell(member.name, "works", self.source, of=member.name)
        return self.table.take(member.works, self.source.surfaces, lambda surface: surface)

    def _handle(self, member: Member, donor: Member, fill: Fill) -> Piece | None:
        """The handle of a slot, in slots of the table; None where its front needs none."""
        if member.kind == "whole" or member.side == "along" or edged(donor):
            return None
        if self.plan.push and takes_push(member, donor):
            return None
        if member.handle is None and (donor.handle is None or self._waits(member)):
            return None
        if self.plan.handle is None:
            if member.handle is None or donor is member:
                return self._own_handle(member)
            source, part = self.source, member
        else:
            entry = self.handles[self.plan.handle]
            source = self.market.library.source(entry.source)
            part = source.members[entry.number]
        mounted = middle_grip(handle_on(member, fill.body, donor, part), member.name)
        self._tell(member.name, "handle", source, of=part.name)
        return self.table.take(mounted, source.surfaces, self._for_handle)

    def _own_handle(self, member: Member) -> Piece | None:
        """The template's handle where it was."""
        if member.handle is None:
            return None
        self._tell(member.name, "handle", self.source, of=member.name)
        return self.table.take(member.handle, self.source.surfaces, self._for_handle)

    def _waits(self, member: Member) -> bool:
        return any(rule.joint == member.joint.name for rule in self.source.preconditions)

    def _for_front(self, surface: SurfaceSpec) -> SurfaceSpec:
        return front_surface(surface, self.looks)

    def _for_handle(self, surface: SurfaceSpec) -> SurfaceSpec:
        return handle_surface(surface, self.looks)

    def _tell_body(self, member: Member, source: Source, donor: Member, fill: Fill) -> None:
        """Where a front comes from, and how it was fitted unless it is the template's own."""
        scale = [round(float(s), 6) for s in fill.scale]
        how = {} if donor is member else {"scale": scale, "mirrored": fill.mirrored}
        self._tell(member.name, donor.kind, source, of=donor.name, **how)

    def _tell(self, part: str, piece: str, source: Source, *, of: str, **more: Any) -> None:
        """Where a piece of a part comes from; its terms and family bind the whole."""
        self.donors.add(source.family)
        self.datasets.add(source.dataset)
        self.licences.append(source.licence)
        self.told.append(
            {"part": part, "piece": piece, "source": source.id, "of": of,
             "licence": source.licence.id, **more}
        )  # fmt: skip


def _with_grips(piece: Piece, member: Member) -> Piece:
    return dataclasses.replace(piece, grips=gripped(piece, member.name, member.joint))


def finished(new: Assembled, *, asset_id: str, provenance: Mapping[str, Any]) -> ArticulatedObject:
    """An assembled object unwrapped onto an atlas and weighed, with where its parts come from."""
    pieces = [(piece.mesh.vertices, piece.mesh.faces) for _, _, piece in new.parts]
    atlas = atlas_uv(pieces, resolution=ATLAS_RESOLUTION)
    return ArticulatedObject(
        category=new.category,
        asset_id=asset_id,
        parts=tuple(
            Part(
                name=name,
                label=label,
                mesh=dataclasses.replace(piece.mesh, atlas=uv),
                collision=piece.collision,
                mass=weighed(piece),
                densities=None if piece.shells else piece.densities,
                grips=piece.grips,
            )
            for (name, label, piece), uv in zip(new.parts, atlas, strict=True)
        ),
        joints=new.joints,
        surfaces=new.surfaces,
        preconditions=new.preconditions,
        provenance={
            **provenance,
            **_shells(new),
            "template": new.template,
            "donors": new.donors,
            "sources": new.sources,
            "licence": new.licence,
            "push_to_open": new.pushed,
            "hashes": new.hashes,
        },
    )


def _shells(new: Assembled) -> dict[str, Any]:
    """What a manifest says of open surfaces, as that of an ingested object does: which bodies they
    are, the m that the thickest weighs as, and that they are a stranger's; nothing where there is
    none."""
    shells = {name: piece.shells for name, _, piece in new.parts if piece.shells}
    if not shells:
        return {}
    thickest = max(m for own in shells.values() for m in own.values())
    bodies = {name: sorted(own) for name, own in shells.items()}
    return {
        "source": {"dataset": "+".join(new.datasets), "id": new.template},
        "shells": {"thickness": thickest, "bodies": bodies},
    }
