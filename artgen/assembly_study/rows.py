"""Objects of the study, one row each: assembled, held against every invariant, measured."""

import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from artgen.assembly.assemble import Assembled, GivenUp
from artgen.assembly.case import Case, case_of
from artgen.assembly.choice import Market
from artgen.assembly.evenness import density_by_part
from artgen.assembly.invariants import broken
from artgen.assembly.library import Library
from artgen.assembly.run import TEMPLATES, new_object
from artgen.assembly.source import Member
from artgen.assembly.texels import density, ratios
from artgen.assembly.uv_fix import areas
from artgen.assembly_study.near import Face, face_of
from artgen.core.mesh import Floats, TriMesh

DENSITY_BINS = np.linspace(0.3, 2.2, 77)
STRETCH_BINS = np.linspace(1.0, 3.0, 81)
WHAT = "storage_furniture"


@dataclass(frozen=True, kw_only=True)
class Row:
    """One attempt.

    Attributes:
        reason: why it was given up, or which invariants do not hold; empty when all is well.
        hash: of tree, shapes and looks.
        looks: hash of looks alone.
        diagonal: of the object at rest, m.
        parts: base included.
        filled: slots filled by donors.
        bodies: sources of bodies and handles with the number of the part, joined by blanks.
        bare: filled slots without a handle: sliding doors, gripped at an edge, pushed.
        pushed: the fronts of the object are pushed to open.
        shorter: joints that open less far than the template's.
        tried: how often something else was tried.
        least, most: texel density of the parts over the median of all parts.
        seconds: CPU time to assemble it, and to hold it against the invariants.
    """

    index: int
    template: str
    accepted: bool
    reason: str
    hash: str
    tree: str
    looks: str
    diagonal: float
    parts: int
    filled: int
    bare: int
    pushed: bool
    shorter: int
    bodies: str
    tried: int
    least: float
    most: float
    assemble_s: float
    check_s: float


@dataclass(frozen=True, kw_only=True)
class Chunk:
    """Rows of one task, and areas of fitted fronts in m2 by texel density and by stretch, with the
    texture coordinates left as they were and as corrected; the faces of what was accepted."""

    rows: tuple[Row, ...]
    density_left: tuple[float, ...]
    density_fixed: tuple[float, ...]
    stretch_left: tuple[float, ...]
    stretch_fixed: tuple[float, ...]
    faces: tuple[Face, ...] = ()


@dataclass(frozen=True, kw_only=True)
class ChunkTask:
    """Attempts `start` to `stop` of a seed."""

    library: Path
    seed: int
    start: int
    stop: int

    @property
    def asset_id(self) -> str:
        """For messages."""
        return f"objects {self.start} to {self.stop}"


_market: Market | None = None
"""Of this worker process; set once by the pool's initializer, as pools offer no other way."""


def open_market(library: Path) -> None:
    """Prepare a process."""
    global _market
    _market = Market(Library(library), TEMPLATES[WHAT])


def measured(task: ChunkTask) -> Chunk:
    """The rows of a task, in a prepared process."""
    if _market is None:
        raise RuntimeError(f"process {os.getpid()} did not open its library")
    return measured_by(_market, task)


def measured_by(market: Market, task: ChunkTask) -> Chunk:
    """The rows of a task."""
    sums = [np.zeros(len(b) - 1) for b in (DENSITY_BINS, DENSITY_BINS, STRETCH_BINS, STRETCH_BINS)]
    rows, faces = [], []
    for index in range(task.start, task.stop):
        began = time.process_time()
        new = new_object(market, WHAT, task.seed, index)
        spent = time.process_time() - began
        if isinstance(new, GivenUp):
            rows.append(_given_up(index, new, spent))
            continue
        rows.append(_row(index, new, market.library, spent))
        if rows[-1].accepted:
            faces.append(face_of(index, new))
        for body, donor, mirrored in fitted_bodies(new, market.library):
            weights = areas(body.triangles)
            for k, mesh in enumerate((left_as_it_was(body, donor, mirrored=mirrored), body)):
                sums[k] += np.histogram(density(mesh), DENSITY_BINS, weights=weights)[0]
                sums[2 + k] += np.histogram(ratios(mesh), STRETCH_BINS, weights=weights)[0]
    return Chunk(
        rows=tuple(rows),
        density_left=tuple(sums[0].tolist()),
        density_fixed=tuple(sums[1].tolist()),
        stretch_left=tuple(sums[2].tolist()),
        stretch_fixed=tuple(sums[3].tolist()),
        faces=tuple(faces),
    )


def _given_up(index: int, new: GivenUp, spent: float) -> Row:
    return Row(
        index=index, template=new.template, accepted=False, reason=new.reason, hash="", tree="",
        looks="", diagonal=0.0, parts=0, filled=0, bare=0, pushed=False, shorter=0, bodies="",
        tried=len(new.tried), least=1.0, most=1.0, assemble_s=spent, check_s=0.0,
    )  # fmt: skip


def _row(index: int, new: Assembled, library: Library, spent: float) -> Row:
    began = time.process_time()
    case = case_of(new, library)
    faults = broken(case)
    medians = np.array(list(density_by_part(new).values()) or [1.0])
    hashes = new.hashes
    bodies = new.given
    return Row(
        index=index,
        template=new.template,
        accepted=not faults,
        reason="; ".join(f"{f.number} {f.part}: {f.value}" for f in faults),
        hash=hashes["object"],
        tree=hashes["tree"],
        looks=hashes["looks"],
        diagonal=round(case.diagonal, 4),
        parts=len(new.parts),
        filled=len(bodies),
        bare=sum(new.layer(str(e["part"]), "handle") is None for e in bodies),
        pushed=new.pushed,
        shorter=_shorter(case),
        bodies=" ".join(sorted({f"{e['source']}:{e['of']}" for e in bodies})),
        tried=len(new.tried),
        least=float(medians.min() / np.median(medians)),
        most=float(medians.max() / np.median(medians)),
        assemble_s=spent,
        check_s=time.process_time() - began,
    )


def _shorter(case: Case) -> int:
    """How many joints open less far than the template's."""
    own = {joint.name: joint.limit for joint in case.template.joints}
    return sum(joint.limit != own[joint.name] for joint in case.new.joints)


def fitted_bodies(new: Assembled, library: Library) -> list[tuple[TriMesh, TriMesh, bool]]:
    """Each fitted body, the donor's mesh, and whether it was mirrored."""
    found = []
    for entry in new.given:
        body = new.layer(str(entry["part"]), "body")
        if body is not None:
            donor = _member(library, entry)
            found.append((body.mesh, donor.body.mesh, bool(entry["mirrored"])))
    return found


def _member(library: Library, entry: Mapping[str, object]) -> Member:
    members = library.source(str(entry["source"])).members
    return next(member for member in members if member.name == entry["of"])


def left_as_it_was(body: TriMesh, donor: TriMesh, *, mirrored: bool) -> TriMesh:
    """A fitted body with the texture coordinates of its donor, corner by corner."""
    uv: Floats = np.asarray(donor.uv)
    return TriMesh(
        vertices=body.vertices, faces=body.faces, uv=uv[:, [0, 2, 1]] if mirrored else uv
    )


def entropy_share(uses: Sequence[float], available: int) -> float:
    """Shannon entropy of how often each donor was used, over that of an even use of all that are
    available (Shannon 1948)."""
    share = np.array([use for use in uses if use > 0], float)
    share /= share.sum()
    return float(-(share * np.log(share)).sum() / np.log(available))
