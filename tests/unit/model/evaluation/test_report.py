"""The page: whole by itself, well nested, nothing unescaped."""

from html.parser import HTMLParser

import pytest

from model.evaluation.report import Report, histogram, page, ranking, shown
from model.evaluation.score import Protocol, failed, score
from model.evaluation.summary import summary
from tests.unit.model.evaluation.layouts import cabinet
from tests.unit.model.evaluation.test_score import QUICK

OPEN_ENDED = {"meta", "img", "br", "td", "th", "tr", "p"}
"""Elements that HTML closes by itself."""


class Nesting(HTMLParser):
    """Complains of an end without its start."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        if tag not in OPEN_ENDED:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: object) -> None:
        """Closed as it opens."""

    def handle_endtag(self, tag: str) -> None:
        if tag not in OPEN_ENDED:
            assert self.open.pop() == tag


@pytest.fixture(scope="module")
def report() -> Report:
    truth = cabinet("<i>a</i>")
    records = [score(truth, truth, QUICK), failed(cabinet("b"), "it <crashed> & burned")]
    return Report(
        system="<script>",
        truth="out",
        protocol=Protocol(),
        records=records,
        summary=summary(records),
        notes=("1 < 2",),
        pictures={"<i>a</i>": b"png"},
    )


def test_the_page_is_well_nested_and_escaped(report: Report) -> None:
    text = page(report)
    parser = Nesting()
    parser.feed(text)
    assert parser.open == []
    assert "<script>" not in text
    assert "<i>a</i>" not in text
    assert "it &lt;crashed&gt; &amp; burned" in text
    assert "1 &lt; 2" in text


def test_what_could_not_be_asked_is_a_dash(report: Report) -> None:
    assert shown(None) == "–"
    assert "<td>images.lpips<td>–" in page(report)


def test_objects_are_ranked_by_their_boxes(report: Report) -> None:
    assert [record.name for record in ranking(report.records)] == ["<i>a</i>"]


def test_a_histogram_counts_every_value() -> None:
    svg = histogram([0.0, 0.0, 1.0], "x", bins=2)
    assert svg.count("<rect") == 2
    assert 'height="60.0"' in svg
    assert 'height="30.0"' in svg
