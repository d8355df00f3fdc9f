"""The most restrictive licence binds a work made from several sources."""

from itertools import permutations

from artgen.assembly.licence import (
    KNOWN,
    OURS,
    UNSTATED,
    Licence,
    licence_of,
    most_restrictive,
)

PARTNET = KNOWN["LicenseRef-PartNet-Mobility"]
STRANGE = Licence(id="LicenseRef-x", text="only on Sundays", distributable=True)


def test_what_may_not_be_handed_on_binds_whatever_the_order():
    for order in permutations([OURS, KNOWN["CC-BY-4.0"], PARTNET]):
        assert most_restrictive(order) == PARTNET
    assert most_restrictive([OURS, KNOWN["CC0-1.0"]]).id == "CC0-1.0"
    assert most_restrictive([OURS, STRANGE, KNOWN["CC-BY-NC-4.0"]]) == STRANGE


def test_a_manifest_without_a_licence_is_ours_unless_its_source_is_foreign():
    assert licence_of({"seed": 1}) == OURS
    assert licence_of({"source": {"dataset": "urdf"}}) == UNSTATED
    stated = {"id": PARTNET.id, "text": "as downloaded"}
    found = licence_of({"source": {}, "licence": stated})
    assert (found.id, found.text, found.distributable) == (PARTNET.id, "as downloaded", False)


def test_unknown_terms_are_not_taken_for_free():
    assert not licence_of({"licence": {"id": "LicenseRef-unheard-of"}}).distributable
