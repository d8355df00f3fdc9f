"""The most restrictive licence binds a work made from several sources."""

from itertools import permutations

import pytest

from artgen.core.licence import (
    KNOWN,
    OURS,
    PARTNET,
    UNSTATED,
    Licence,
    licence_of,
    most_restrictive,
    stated_licence,
)

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


@pytest.mark.parametrize("flag", [True, "yes", 1, None])
@pytest.mark.parametrize("id", [PARTNET.id, PARTNET.id.upper(), "NOASSERTION"])
def test_no_statement_widens_what_a_listed_licence_allows(id, flag):
    """A manifest that called the terms of PartNet-Mobility distributable was believed."""
    assert not licence_of({"licence": {"id": id, "distributable": flag}}).distributable


@pytest.mark.parametrize("flag", [False, "no", "false", 0, None])
def test_a_statement_may_narrow(flag):
    """`"no"` once counted as true."""
    assert not licence_of({"licence": {"id": "CC-BY-4.0", "distributable": flag}}).distributable
    assert licence_of({"licence": {"id": "CC-BY-4.0", "distributable": True}}).distributable


@pytest.mark.parametrize("stated", [7, [], {}, {"distributable": True}, {"id": 3}])
def test_what_cannot_be_understood_allows_nothing(stated):
    assert stated_licence(stated) == UNSTATED
    assert not licence_of({"licence": stated}).distributable


@pytest.mark.parametrize(
    "named",
    [
        {"source": {"dataset": "partnet-mobility", "id": "45940"}},
        {"source": {"dataset": "artgen+partnet-mobility", "id": "x"}},
        {"source": {"dataset": "artgen-export", "family": "partnet-mobility:45940"}},
        {"donors": ["cabinet_6_000001", "partnet-mobility:45940"]},
        {"sources": [{"part": "door", "source": "x", "licence": PARTNET.id}]},
    ],
)
def test_what_was_made_from_partnet_is_bound_whatever_the_manifest_calls_it(named):
    """The control is the same manifest without what names the data set."""
    stated = {"licence": {"id": "CC0-1.0", "distributable": True}}
    assert licence_of(stated).distributable
    assert licence_of({**stated, **named}) == PARTNET


def test_a_part_whose_licence_nobody_knows_binds_the_whole():
    stated = {"licence": {"id": "CC0-1.0", "distributable": True}}
    part = {"part": "door", "source": "x", "licence": "LicenseRef-x"}
    assert not licence_of({**stated, "sources": [part]}).distributable
    assert not licence_of({**stated, "sources": [{"part": "door"}]}).distributable
    own = {"licence": {"id": "LicenseRef-x", "text": "ask", "distributable": True}}
    assert licence_of({**own, "sources": [part]}).distributable


def test_what_has_to_be_shared_alike_goes_with_nothing_that_asks_for_more():
    """No one licence satisfies both CC-BY-SA and CC-BY-NC, so what is made from both is handed on
    by nobody; either alone may be."""
    alike, paid = KNOWN["CC-BY-SA-4.0"], KNOWN["CC-BY-NC-4.0"]
    for order in permutations([OURS, alike, paid]):
        both = most_restrictive(order)
        assert both.id == "CC-BY-SA-4.0 AND CC-BY-NC-4.0"
        assert not both.distributable
    assert most_restrictive([OURS, alike]) == alike
    assert most_restrictive([KNOWN["CC-BY-4.0"], alike]) == alike
    assert most_restrictive([paid, KNOWN["CC-BY-NC-SA-4.0"]]).distributable
    assert most_restrictive([alike, paid, PARTNET]) == PARTNET
    assert not stated_licence("CC-BY-SA-4.0 AND CC-BY-NC-4.0").distributable
