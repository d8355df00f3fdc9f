"""What a manifest says of the terms of an object: one and the same, wherever it says it."""

import dataclasses
from collections.abc import Mapping

import pytest

from artgen.core.jsonio import plain
from artgen.core.licence import KNOWN, OURS, PARTNET, UNSTATED, licence_of
from artgen.export.manifest import LICENSE, license_text


@pytest.mark.parametrize(
    ("provenance", "text"),
    [
        ({}, LICENSE),
        ({"licence": OURS}, LICENSE),
        ({"licence": PARTNET}, PARTNET.text),
        ({"licence": plain(PARTNET)}, PARTNET.text),
        ({"licence": dataclasses.replace(KNOWN["MIT"], text="(c) A. Maker")}, "(c) A. Maker"),
        ({"source": {"dataset": "urdf", "id": "x"}}, UNSTATED.text),
        ({"sources": ({"source": "x", "licence": PARTNET.id},)}, PARTNET.text),
    ],
)
def test_the_line_for_people_says_what_the_licence_does(
    provenance: Mapping[str, object], text: str
) -> None:
    """Assembled from PartNet-Mobility, a bundle said that it is its maker's: its licence was no
    JSON yet when the line was written."""
    assert license_text(provenance) == text
    assert license_text(plain(provenance)) == text
    free = licence_of(plain(provenance)).distributable
    assert free == (text in (LICENSE, "(c) A. Maker"))
