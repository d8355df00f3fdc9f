"""Account: what a bundle says of where it came from and of what was done to it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from artgen.core.conventions import ART_SLOTS
from artgen.core.jsonio import plain
from artgen.core.licence import (
    OF_DATASETS,
    UNSTATED,
    Licence,
    datasets_of,
    most_restrictive,
    stated_licence,
)
from artgen.ingest.foreign import ForeignJoint, ForeignObject
from artgen.ingest.meshes.clean import Body, Washed
from artgen.ingest.options import Options
from artgen.ingest.placing import Place
from artgen.ingest.rest import Rest

FINE = ("given", "high", "medium")


@dataclass(frozen=True, kw_only=True, eq=False)
class Account:
    """All that is known of one ingested object.

    Attributes:
        sprung: joints that were given a spring which the source does not state.
        names: part name of the source to ours, in canonical order.
        bodies: by part name of the source.
    """

    foreign: ForeignObject
    sprung: tuple[str, ...]
    dropped: tuple[str, ...]
    place: Place
    rests: Mapping[str, Rest]
    bodies: Mapping[str, Sequence[Body]]
    names: Mapping[str, str]
    washed: Washed
    unreadable_images: int
    options: Options


def provenance(account: Account) -> dict[str, Any]:
    """Top-level keys of the manifest."""
    foreign = account.foreign
    said: dict[str, Any] = plain(
        {
            **borrowed(foreign),
            "source": source(foreign),
            "licence": licence(foreign, account.options),
            "template": None,
            "scale": account.place.scale,
            "joints_read": joints_read(account),
            "shells": {
                "thickness": account.options.thickness,
                "bodies": {
                    ours: [k for k, body in enumerate(account.bodies[name]) if not body.closed]
                    for name, ours in account.names.items()
                    if not all(body.closed for body in account.bodies[name])
                },
            },
            "fragments": {ours: leaves(account.bodies[n]) for n, ours in account.names.items()},
            "mended": mended(account),
            "dropped": [*account.dropped],
            "doubts": [*foreign.doubts],
            "art": unfit_for_art(account),
        }
    )
    return said


def source(foreign: ForeignObject) -> dict[str, Any]:
    """Which object of which data set it is."""
    numbered = {} if foreign.anno_id is None else {"anno_id": foreign.anno_id}
    return {
        "dataset": foreign.dataset,
        "id": foreign.id,
        "family": foreign.family,
        "digest": foreign.digest,
        "category": foreign.category,
        **numbered,
    }


def borrowed(foreign: ForeignObject) -> dict[str, Any]:
    """Families whose parts it has, where it was assembled before it was exported."""
    donors = foreign.note.get("donors")
    return {"donors": [str(one) for one in donors]} if isinstance(donors, list) and donors else {}


def licence(foreign: ForeignObject, options: Options) -> Licence:
    """The most restrictive of what binds it: the terms of its data set, what the source states,
    and what the user does, who can name terms but not lift any."""
    sets = sorted({foreign.dataset} | datasets_of(foreign.note))
    bound = [OF_DATASETS[name] for name in sets if name in OF_DATASETS]
    if (stated := foreign.note.get("licence")) is not None:
        bound.append(stated_licence(stated))
    if options.licence is not None:
        bound.append(stated_licence(options.licence))
    return most_restrictive(bound) if bound else UNSTATED


def joints_read(account: Account) -> dict[str, dict[str, Any]]:
    """Our joint's name to what the source said of it, and why it rests where it does."""
    words = {part.name: part.word for part in account.foreign.parts}
    return {
        f"{account.names[joint.child]}_joint": {
            "source": joint.name,
            "number": joint.number,
            "link": joint.child,
            "word": words[joint.child],
            "range": _shown(joint, joint.lower, joint.upper),
            "rest": _shown(joint, account.rests[joint.name].q),
            "unit": "deg" if joint.type != "prismatic" else "units",
            "reason": account.rests[joint.name].reason,
            "confidence": account.rests[joint.name].confidence,
            "turns": joint.turns,
        }
        for joint in account.foreign.joints
    }


def _shown(joint: ForeignJoint, *values: float | None) -> list[float] | None:
    if any(value is None for value in values):
        return None
    turn = math.degrees if joint.type != "prismatic" else float
    return [turn(value) for value in values if value is not None]


def leaves(bodies: Sequence[Body]) -> list[dict[str, Any]]:
    """Runs of bodies that the source calls by one name."""
    found: list[dict[str, Any]] = []
    for number, body in enumerate(bodies):
        if found and found[-1]["leaf"] == body.leaf:
            found[-1]["bodies"][1] += 1
        else:
            found.append({"leaf": body.leaf, "bodies": [number, 1]})
    return found


def mended(account: Account) -> list[str]:
    """What was changed about the meshes, a line each."""
    washed = account.washed
    open_count = sum(not b.closed for own in account.bodies.values() for b in own)
    lines = {
        f"{washed.doubled} triangles stood there twice; one of each is kept": washed.doubled,
        f"{washed.flat} triangles had no area": washed.flat,
        f"{washed.turned} triangles faced inward or against their neighbors": washed.turned,
        f"{open_count} open surfaces weigh as sheets of {account.options.thickness:g} m":
            open_count,
        f"{washed.unsure} open surfaces may face either way": washed.unsure,
        f"{', '.join(account.sprung)}: a spring that carries the weight is assumed":
            len(account.sprung),
        f"{account.unreadable_images} images could not be read; plain colors stand for them":
            account.unreadable_images,
    }  # fmt: skip
    return [line for line, count in lines.items() if count]


def unfit_for_art(account: Account) -> list[str]:
    """Why the object is no sample for ART; nothing where it is one."""
    reasons = []
    if (count := len(account.names)) > ART_SLOTS:
        reasons.append(f"{count} parts; a sample has {ART_SLOTS} slots")
    if turning := [joint.child for joint in account.foreign.joints if joint.turns]:
        reasons.append(f"{', '.join(turning)} slides and turns at once; taken as sliding alone")
    unsure = [n for n, rest in account.rests.items() if rest.confidence not in FINE]
    if unsure:
        reasons.append(f"the closed pose of {', '.join(unsure)} is a guess")
    return reasons
