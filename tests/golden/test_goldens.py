"""The same seed gives the object it gave when its category's version was last raised."""

import json

import pytest

from artgen.core.jsonio import plain
from tests.golden.summary import FOLDER, summary
from tests.golden.tree import PAGE, page
from tests.made import CATEGORIES, finished


@pytest.mark.parametrize(
    "category", [pytest.param(name, marks=pytest.mark.xdist_group(name)) for name in CATEGORIES]
)
def test_the_object_is_the_one_on_record(category: str) -> None:
    recorded = json.loads((FOLDER / f"{category}.json").read_text())
    assert json.loads(json.dumps(plain(summary(finished(category, 0))))) == recorded


def test_the_page_of_source_files_is_up_to_date() -> None:
    assert PAGE.read_text() == page()


def test_every_record_belongs_to_a_category() -> None:
    assert {path.stem for path in FOLDER.glob("*.json")} == set(CATEGORIES)
