"""The table of metrics: whole, consistent, documented."""

from pathlib import Path

from model.evaluation.metrics import HEADLINES, METRICS
from model.evaluation.published import TABLES

PAGE = Path(__file__).parents[4] / "docs" / "evaluation.md"


def test_headlines_are_metrics() -> None:
    assert set(HEADLINES) <= set(METRICS)


def test_what_has_a_worst_value_says_which_way_is_better() -> None:
    for name, metric in METRICS.items():
        assert metric.worst is None or metric.better, name


def test_every_metric_is_defined_on_the_page() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for name in METRICS:
        group, _, own = name.partition(".")
        leaves = [own[k:] for k in (0, *(i + 1 for i, c in enumerate(own) if c == "."))]
        assert f"`{group}`" in text or f"`{group}." in text, name
        assert any(f"`{leaf}`" in text for leaf in (*leaves, name)), name


def test_published_numbers_stand_on_the_page_too() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for table in TABLES:
        for row in table.rows:
            assert set(row.numbers) == set(table.rows[0].numbers) <= set(table.ours)
            for number in row.numbers.values():
                assert f"{number:g}" in text, row.system
        assert set(table.ours.values()) <= set(METRICS)
