"""The vocabulary of roles, and the table that the documentation shows of it."""

from pathlib import Path

import pytest

from artgen.articulation.roles import ROLES, role_of, roles_table
from artgen.core.errors import KinematicError

PAGE = Path(__file__).parents[3] / "docs" / "conventions.md"


def test_the_document_shows_the_table_as_the_code_has_it() -> None:
    """After a change of ROLES: put what `roles_table()` returns between the two comments."""
    assert f"-->\n{roles_table()}\n<!-- end of roles -->" in PAGE.read_text()


@pytest.mark.parametrize("word", ROLES)
def test_spans_run_upwards_and_only_what_closes_has_an_edge_to_hinge_on(word: str) -> None:
    role = ROLES[word]
    for low, high in (role.turning, role.sliding):
        assert 0.0 <= low < high
    assert role.closes or not role.edged
    assert role.meaning


def test_a_word_outside_the_vocabulary_is_refused_with_the_nearest() -> None:
    with pytest.raises(KinematicError, match=r"'drawr' is no role.*did you mean 'drawer'"):
        role_of("drawr")
