"""Finished tasks come back from disk as they were; half-written ones do not count."""

from dataclasses import asdict, replace

import numpy as np
import pytest

from artgen.assembly_study.chunks import read_chunk, save_chunk
from artgen.assembly_study.page import page
from artgen.assembly_study.rows import ChunkTask, measured_by


@pytest.fixture(scope="module")
def chunk(market):
    return measured_by(market, ChunkTask(library=market.library.folder, seed=1, start=0, stop=6))


def test_a_chunk_is_read_as_it_was_written(chunk, tmp_path):
    save_chunk(tmp_path / "a" / "0-6.json", chunk)
    found = read_chunk(tmp_path / "a" / "0-6.json")
    assert found.rows == chunk.rows
    assert found.density_left == pytest.approx(chunk.density_left, rel=1e-12)
    assert len(found.faces) == sum(row.accepted for row in chunk.rows) >= 5
    for one, same in zip(chunk.faces, found.faces, strict=True):
        assert (one.index, one.template) == (same.index, same.template)
        assert np.array_equal(one.points, same.points)
        assert np.array_equal(one.sizes, same.sizes)


def test_rows_tell_what_was_drawn(chunk, market):
    for row in (row for row in chunk.rows if row.accepted):
        assert 0 <= row.bare <= row.filled <= row.parts - 1
        assert 0 <= row.shorter <= row.parts - 1
        assert not row.pushed or row.bare == row.filled
        assert row.diagonal > 0.5


def test_the_page_counts_near_duplicates(chunk, market):
    """The same objects under other numbers are duplicates, each of its first; with other looks they
    are so in shape alone."""
    rows = [replace(row, index=row.index + 100) for row in chunk.rows]
    faces = tuple(replace(face, index=face.index + 100) for face in chunk.faces)
    repainted = [replace(rows[0], looks="other"), *rows[1:]]
    twice = page(market, [chunk, replace(chunk, rows=tuple(repainted), faces=faces)],
                 seed=1, sheet=False)  # fmt: skip
    count = len(chunk.faces)
    once = page(market, [chunk], seed=1, sheet=False)
    assert fact(once, "nearer than") == "0"
    assert fact(twice, "nearer than") == f"{2 * count}"
    assert fact(twice, "of these with the looks") == f"{2 * count - 2}"
    assert fact(twice, "left if near-duplicates") == f"{count}"


def fact(text, start):
    line = next(line for line in text.splitlines() if line.startswith(f"| {start}"))
    return line.split("|")[2].strip()


def test_every_accepted_object_is_in_a_cell(chunk, market):
    text = page(market, [chunk], seed=1, sheet=False)
    table = text.split("## Sizes and part counts")[1].split("##")[0]
    cells = [cell for line in table.splitlines() if " m |" in line
             for cell in line.split("|")[2:-1]]  # fmt: skip
    assert sum(int(cell) for cell in cells if cell.strip()) == len(chunk.faces)
    assert asdict(chunk.rows[0])["looks"]
