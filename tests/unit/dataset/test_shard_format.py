"""docs/shard_format.md says what is true: its programs run, its tables list what files hold."""

import io
import re
from pathlib import Path

import duckdb
import numpy as np
import pytest

from artgen.dataset.catalog import ASSETS, SAMPLES
from artgen.dataset.folder import shard_folder
from artgen.dataset.members import encoded
from tests.unit.dataset.runs import WIDE, made_run
from tests.unit.dataset.scenes import made_sample, with_extras

DOCUMENT = (Path(__file__).parents[3] / "docs" / "shard_format.md").read_text(encoding="utf-8")
(SQL,) = re.findall(r"```sql\n(.*?)```", DOCUMENT, flags=re.DOTALL)
README = (Path(__file__).parents[3] / "README.md").read_text(encoding="utf-8")
READER, QUERY = re.findall(r"```python\n(.*?)```", DOCUMENT, flags=re.DOTALL)


@pytest.fixture
def in_run(tmp_path, monkeypatch):
    """The working directory holds a packed `out/`."""
    shard_folder(made_run(tmp_path / "out"))
    monkeypatch.chdir(tmp_path)


@pytest.mark.usefixtures("in_run")
def test_the_reader_runs_and_is_short(capsys):
    assert len([line for line in READER.splitlines() if line.strip()]) <= 15
    exec(compile(READER, "shard_format.md", "exec"), {})
    assert "laptop_000002 door" in capsys.readouterr().out


@pytest.mark.usefixtures("in_run")
def test_both_queries_find_the_wide_laptops(capsys):
    exec(compile(QUERY, "shard_format.md", "exec"), {})
    said = capsys.readouterr().out
    # The laptop that failed validation opens that wide too; each query prints each name once.
    assert all(said.count(name) == 2 for name in [*WIDE, "laptop_000004"])
    assert "laptop_000001" not in said


@pytest.mark.usefixtures("in_run")
def test_the_programs_of_the_readme_run(capsys):
    (reader,) = re.findall(r"```python\n(.*?)```", README, flags=re.DOTALL)
    exec(compile(reader, "README.md", "exec"), {})
    assert "laptop_000002 (" in capsys.readouterr().out
    (query,) = re.findall(r"```sql\n(.*?)```", README, flags=re.DOTALL)
    assert {*WIDE} <= {name for (name,) in duckdb.sql(query).fetchall()}


@pytest.mark.usefixtures("in_run")
def test_the_index_is_asked_without_artgen():
    rows = duckdb.sql(SQL).fetchall()
    assert {name for _, name, _, _ in rows} == {"s0v00.rgba.webp"}
    content = Path("out/shards/train-000000.tar").read_bytes()
    assert all(content[offset : offset + 4] == b"RIFF" for _, _, offset, _ in rows)


def test_every_member_and_array_is_in_the_tables():
    sample = encoded(with_extras(made_sample(states=1, views=4)))
    listed = re.findall(r"^\| `([\w.]+)` \|", DOCUMENT, flags=re.MULTILINE)
    for name, data in sample.members:
        if not re.match(r"s0v0[012]", name):
            assert name in listed
        if name == "arrays.npz":
            for array in np.load(io.BytesIO(data)).files:
                assert re.search(rf"^\| .*`{array}`", DOCUMENT, flags=re.MULTILINE), array


@pytest.mark.parametrize("column", [*ASSETS.names, *SAMPLES.names])
def test_every_column_of_the_catalog_is_in_the_tables(column):
    assert re.search(rf"^\| .*`{column}`", DOCUMENT, flags=re.MULTILINE)
