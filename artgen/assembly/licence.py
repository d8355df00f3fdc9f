"""Licences of what objects are made from, and which of several binds the whole."""

from collections.abc import Iterable, Mapping
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
KNOWN: Mapping[str, Licence] = {
    licence.id: licence
    for licence in (
        OURS,
        Licence(id="CC0-1.0", text="Public domain dedication.", distributable=True),
        Licence(id="Apache-2.0", text="Apache License 2.0, with notice.", distributable=True),
        Licence(id="MIT", text="MIT License, with notice.", distributable=True),
        Licence(id="CC-BY-4.0", text="Creative Commons, name the maker.", distributable=True),
        Licence(id="CC-BY-SA-4.0", text="Creative Commons, share alike.", distributable=True),
        Licence(id="CC-BY-NC-4.0", text="Creative Commons, non-commercial.", distributable=True),
        UNSTATED,
        Licence(
            id="LicenseRef-PartNet-Mobility",
            text="PartNet-Mobility: gated, non-commercial research; never handed on.",
            distributable=False,
        ),
    )
}
"""From the freest to the most restrictive; a licence not listed here counts by its flag."""
ORDER = tuple(KNOWN)


def rank(licence: Licence) -> tuple[bool, int, str]:
    """Sorts licences from free to restrictive: what may not be handed on binds most; among what
    may, an unlisted one binds more than any that is listed."""
    place = ORDER.index(licence.id) if licence.id in ORDER else len(ORDER)
    return not licence.distributable, place, licence.id


def most_restrictive(licences: Iterable[Licence]) -> Licence:
    """The one that binds a work made from all of them."""
    return max(licences, key=rank)


def licence_of(manifest: Mapping[str, Any]) -> Licence:
    """What a bundle's manifest states under `licence`; ours where it states nothing, as the
    generators do, and `NOASSERTION` where it names a foreign source without terms."""
    stated = manifest.get("licence")
    if isinstance(stated, Mapping) and isinstance(stated.get("id"), str):
        known = KNOWN.get(stated["id"], UNSTATED)
        return Licence(
            id=stated["id"],
            text=str(stated.get("text", known.text)),
            distributable=bool(stated.get("distributable", known.distributable)),
        )
    return UNSTATED if "source" in manifest else OURS
