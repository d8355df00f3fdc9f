"""Licences of what objects are made from, and which of several binds the whole."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class Licence:
    """Terms of a source.

    Attributes:
        id: an SPDX identifier, or `LicenseRef-...` for terms that SPDX does not list.
        text: one line for people.
        distributable: whether copies and works made from it may be handed on at all.
    """

    id: str
    text: str
    distributable: bool


OURS = Licence(
    id="LicenseRef-artgen-output",
    text="Made by artgen's generators, which claim no right in what they generate.",
    distributable=True,
)
UNSTATED = Licence(
    id="NOASSERTION", text="The source states no licence; ask its maker.", distributable=False
)
PARTNET = Licence(
    id="LicenseRef-PartNet-Mobility",
    text="PartNet-Mobility: gated, non-commercial research; never handed on.",
    distributable=False,
)
KNOWN: Mapping[str, Licence] = {
    licence.id: licence
    for licence in (
        OURS,
        Licence(id="CC0-1.0", text="Public domain dedication.", distributable=True),
        Licence(id="MIT", text="MIT License, with notice.", distributable=True),
        Licence(id="BSD-3-Clause", text="BSD License, with notice.", distributable=True),
        Licence(id="Apache-2.0", text="Apache License 2.0, with notice.", distributable=True),
        Licence(id="CC-BY-4.0", text="Creative Commons, name the maker.", distributable=True),
        Licence(id="CC-BY-SA-4.0", text="Creative Commons, share alike.", distributable=True),
        Licence(id="CC-BY-NC-4.0", text="Creative Commons, non-commercial.", distributable=True),
        Licence(
            id="CC-BY-NC-SA-4.0",
            text="Creative Commons, non-commercial, share alike.",
            distributable=True,
        ),
        UNSTATED,
        PARTNET,
    )
}
"""From the freest to the most restrictive; a licence not listed here counts by its flag."""
ORDER = tuple(KNOWN)
UNLISTED = ORDER.index(PARTNET.id) - 0.5
"""Rank of a licence that is not listed: it binds more than any whose works may be handed on."""
FOLDED = {id.casefold(): licence for id, licence in KNOWN.items()}
"""SPDX identifiers mean the same in capitals."""
OF_DATASETS: Mapping[str, Licence] = {"partnet-mobility": PARTNET}
"""Terms of data sets, whatever else is said of what was made from them."""
SHARE_ALIKE = "CC-BY-SA-4.0"
"""Works made with it are handed on under these very terms, so with nothing that asks for more."""


def rank(licence: Licence) -> tuple[bool, float, str]:
    """Sorts licences from free to restrictive: what may not be handed on binds most; among what
    may, an unlisted one binds more than any that is listed."""
    place = ORDER.index(licence.id) if licence.id in KNOWN else UNLISTED
    return not licence.distributable, place, licence.id


def most_restrictive(licences: Iterable[Licence]) -> Licence:
    """The one that binds a work made from all of them.

    Where one asks that works be shared alike and another asks for more, no licence satisfies both:
    the two together bind, and the work may not be handed on.
    """
    bound: dict[str, Licence] = {}
    for licence in licences:
        kept = bound.setdefault(licence.id, licence)
        bound[licence.id] = max(kept, licence, key=rank)
    most = max(bound.values(), key=rank)
    alike = KNOWN[SHARE_ALIKE]
    if SHARE_ALIKE not in bound or not most.distributable or rank(most) <= rank(alike):
        return most
    text = f"{alike.id} asks to share alike, which {most.id} does not allow; never handed on."
    return Licence(id=f"{alike.id} AND {most.id}", text=text, distributable=False)


def stated_licence(stated: object) -> Licence:
    """The licence that is stated as such, or in JSON as an identifier or as an object.

    What a listed licence allows is known: a statement can narrow it, not widen it. An unlisted one
    allows what it says outright; what cannot be understood allows nothing.
    """
    entry = {"id": stated} if isinstance(stated, str) else stated
    entry = vars(entry) if isinstance(entry, Licence) else entry
    if not isinstance(entry, Mapping) or not isinstance(entry.get("id"), str):
        return UNSTATED
    known = FOLDED.get(entry["id"].casefold())
    allowed = entry.get("distributable", known is not None) is True
    return Licence(
        id=entry["id"] if known is None else known.id,
        text=str(entry.get("text", (known or UNSTATED).text)),
        distributable=allowed and (known is None or known.distributable),
    )


def licence_of(manifest: Mapping[str, Any]) -> Licence:
    """What binds a bundle: the most restrictive of what its manifest states under `licence`, of the
    data sets that it names and of the sources of its parts.

    Ours where it states nothing, as the generators do, and `NOASSERTION` where it names a foreign
    source without terms.
    """
    stated = manifest.get("licence")
    whole = None if stated is None else stated_licence(stated)
    bound = [] if whole is None else [whole]
    if whole is None and "source" in manifest:
        bound.append(UNSTATED)
    bound += [OF_DATASETS[name] for name in sorted(datasets_of(manifest)) if name in OF_DATASETS]
    for _, id in sources_of(manifest):
        bound.append(whole if whole is not None and whole.id == id else stated_licence(id))
    return most_restrictive(bound) if bound else OURS


def datasets_of(manifest: Mapping[str, Any]) -> frozenset[str]:
    """The data sets that a manifest, or the note of an export, names: as its source, which may be
    several for an assembled object, or before the colon of a family."""
    source, donors = manifest.get("source"), manifest.get("donors")
    stated = source if isinstance(source, Mapping) else {}
    families = [manifest.get("family"), stated.get("family")]
    families += donors if isinstance(donors, list | tuple) else []
    named = [str(family).partition(":")[0] for family in families if family is not None]
    return frozenset([*str(stated.get("dataset", "")).split("+"), *named])


def sources_of(manifest: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """What the parts of an assembled object come from: source and identifier of its licence."""
    entries = manifest.get("sources")
    for entry in entries if isinstance(entries, list | tuple) else ():
        if isinstance(entry, Mapping):
            yield str(entry.get("source", "")), str(entry.get("licence", UNSTATED.id))
