"""Progress of long work, where no terminal shows a bar: one line now and then, always the last."""

import pytest

from artgen.progress import progress


def test_the_last_item_is_told_with_its_number(capsys: pytest.CaptureFixture[str]) -> None:
    with progress("objects", 2) as advance:
        advance("one")
        advance("two")
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("objects: 2/2, ")
    assert line.endswith("ETA 0 s, last two")


@pytest.mark.parametrize("note", ["a[/b]c", "[red]x", "/" + 40 * "long/"])
def test_notes_are_told_as_they_are(note: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A path with brackets was taken for markup, and ended the run that it was a note of."""
    with progress("objects", 1) as advance:
        advance(note)
    (line,) = capsys.readouterr().err.splitlines()
    assert line.endswith(f"last {note}")
