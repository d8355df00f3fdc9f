"""What a bundle says of where it came from: terms that nobody lifts, families that stay whole."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from artgen.core.jsonio import plain
from artgen.core.licence import licence_of
from artgen.export.partnet.write import write_partnet
from artgen.ingest.account import borrowed, licence, source
from artgen.ingest.foreign import ForeignObject
from artgen.ingest.options import Options
from artgen.ingest.partnet.folder import read_partnet
from tests.made import finished

PARTNET = "LicenseRef-PartNet-Mobility"


def foreign(dataset: str, note: Mapping[str, object] | None = None) -> ForeignObject:
    return ForeignObject(
        dataset=dataset, id="7", category="c", digest="d", parts=(), joints=(),
        object_from_source=np.eye(3), note=note or {},
    )  # fmt: skip


@pytest.mark.parametrize("word", ["CC0-1.0", "LicenseRef-artgen-output", "LicenseRef-mine", None])
def test_no_word_of_the_user_lifts_the_terms_of_partnet(word: str | None) -> None:
    """`--licence CC0-1.0` made a PartNet-Mobility object distributable; a folder that we exported
    from one is as bound, whatever became of the line that says so."""
    exported = [
        foreign("artgen-export", {"source": {"dataset": name}})
        for name in ("partnet-mobility", "partnet-mobility+urdf")
    ]
    for one in (foreign("partnet-mobility"), *exported):
        terms = licence(one, Options(licence=word))
        assert not terms.distributable
        assert not licence_of({"licence": plain(terms)}).distributable


def test_terms_that_are_stated_can_be_narrowed_not_widened() -> None:
    stated = foreign("artgen-export", {"licence": {"id": "CC-BY-NC-4.0"}})
    assert licence(stated, Options()).id == "CC-BY-NC-4.0"
    assert licence(stated, Options(licence="MIT")).id == "CC-BY-NC-4.0"
    assert licence(stated, Options(licence="NOASSERTION")).id == "NOASSERTION"


def test_where_nothing_is_stated_the_user_is_heard() -> None:
    assert licence(foreign("urdf"), Options(licence="CC-BY-4.0")).id == "CC-BY-4.0"
    assert licence(foreign("urdf"), Options()).id == "NOASSERTION"


def test_a_family_is_that_of_the_data_set_and_the_id() -> None:
    assert source(foreign("urdf")) == {
        "dataset": "urdf", "id": "7", "family": "urdf:7", "digest": "d", "category": "c"
    }  # fmt: skip


@pytest.mark.parametrize(
    ("provenance", "family", "donors"),
    [
        ({}, "bucket_000000", None),
        ({"source": {"dataset": "partnet-mobility", "family": "partnet-mobility:9"}},
         "partnet-mobility:9", None),
        ({"donors": ["partnet-mobility:9", "cabinet_6_000001"]}, "bucket_000000",
         ["partnet-mobility:9", "cabinet_6_000001"]),
    ],
)  # fmt: skip
def test_what_was_exported_stays_with_its_family(
    provenance: Mapping[str, object], family: str, donors: list[str] | None, tmp_path: Path
) -> None:
    """Else an object and its copy in the other layout lie in different splits."""
    obj = dataclasses.replace(finished("bucket", 0), provenance=provenance)
    write_partnet(obj, tmp_path, {})
    back = read_partnet(tmp_path)
    assert back.family == family
    assert borrowed(back).get("donors") == donors
