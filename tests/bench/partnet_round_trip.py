"""`python -m tests.bench.partnet_round_trip`: our categories as PartNet-Mobility and back.

Object 0 of every category as the tests make it (`tests/made.py`: seed 101, edges left sharp) is
written with doubled faces and ingested as a stranger's; the table of docs/ingest.md is printed.
The same command again goes on with what is missing.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from artgen.cli import run_command
from artgen.core.jsonio import read_object
from artgen.export.partnet.write import write_partnet
from tests.made import CATEGORIES, finished


def write_sources(folder: Path) -> None:
    """A PartNet-Mobility folder for each category."""
    for category in CATEGORIES:
        own = folder / category
        if not own.exists():
            own.mkdir(parents=True)
            write_partnet(finished(category, 0), own, {}, doubled=True)


def lines(run: Path) -> Iterator[str]:
    """Category, verdict, number of collision pieces, first finding, as rows of a table."""
    yield "| category | verdict | pieces | finding |"
    yield "|---|---|---|---|"
    for entry in _read(run / "ingest_report.json")["entries"]:
        manifest = run / "assets" / entry["category"] / entry["asset_id"] / "manifest.json"
        parts = _read(manifest)["parts"] if manifest.exists() else []
        pieces = sum(len(part["collision"]) for part in parts)
        words = entry["category"].replace("_", " "), entry["status"], pieces, entry["message"]
        yield "| " + " | ".join(map(str, words)) + " |"


def _read(path: Path) -> dict[str, Any]:
    return read_object(path, remedy="run the command again")


def main() -> int:
    """The exit code of ingest."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/partnet_round_trip"))
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    write_sources(options.out / "src")
    words = ["--out", str(options.out / "run"), "--workers", str(options.workers)]
    code = run_command("ingest", ["partnet", str(options.out / "src"), *words])
    print("\n".join(lines(options.out / "run")))  # noqa: T201
    return code


if __name__ == "__main__":
    raise SystemExit(main())
