"""The whole route: rules to shards, the same bytes whatever happens on the way."""

import csv
import hashlib
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from artgen.dataset import ShardDataset

pytestmark = [pytest.mark.blender, pytest.mark.slow, pytest.mark.xdist_group("end_to_end")]

SMALL = ["--categories", "cabinet", "dishwasher", "laptop", "--count", "3", "--seed", "5"]
SMALL += ["--views", "2", "--states", "2", "--size", "32"]
OTHERS = {"logs", "work", ".lock", "render_report.json"}
"""Times, caches and the lock: not part of a run's content."""


def generate(out: Path, *words: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "artgen", "generate", *SMALL, "--out", str(out), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def finished(running: subprocess.Popen[str]) -> tuple[int, str, str]:
    told, said = running.communicate(timeout=600)
    return running.returncode, told, said


def content(out: Path) -> dict[str, str]:
    return {
        path.relative_to(out).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(out.rglob("*"))
        if path.is_file() and path.relative_to(out).parts[0] not in OTHERS
    }


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("run") / "out"
    code, told, said = finished(generate(out, "--workers", "2"))
    assert code == 0, told + said
    return out


def test_a_run_leaves_what_it_promises(run: Path) -> None:
    with (run / "summary.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert [row["asset_id"] for row in rows] == [
        "cabinet_000000",
        "dishwasher_000000",
        "laptop_000000",
    ]
    assert {row["verdict"] for row in rows} == {"passed"}
    for row in rows:
        assert int(row["files"]) <= 30
        assert int(row["bytes"]) <= 3_000_000
    assert (run / "contact_sheet.png").stat().st_size > 1000
    log = (run / "logs" / "run.log").read_text()
    for stage in ("build", "finish", "export", "validate"):
        assert f"laptop_000000 {stage} " in log


def test_the_shards_hold_every_asset_with_its_targets(run: Path) -> None:
    samples = list(ShardDataset(run / "shards"))
    assert sorted(sample.meta.asset_id for sample in samples) == [
        "cabinet_000000",
        "dishwasher_000000",
        "laptop_000000",
    ]
    for sample in samples:
        assert sample.rgba.shape == (2, 2, 32, 32, 4)
        assert sample.rgba[..., 3].any()


def test_one_worker_gives_the_same_bytes_as_two(run: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    code, told, said = finished(generate(out, "--workers", "1"))
    assert code == 0, told + said
    assert content(out) == content(run)


def test_a_killed_run_resumes_to_the_same_bytes(run: Path, tmp_path: Path) -> None:
    """Killed twice: while assets are made, and while they are rendered."""
    out = tmp_path / "out"
    for sign in ("work/staged", "samples"):
        running = generate(out, "--workers", "2")
        while not (out / sign).exists() and running.poll() is None:
            time.sleep(0.02)
        time.sleep(0.5)
        os.killpg(running.pid, signal.SIGKILL)
        running.communicate()
    code, told, said = finished(generate(out, "--workers", "2"))
    assert code == 0, told + said
    assert content(out) == content(run)


def test_the_same_command_again_makes_nothing_new(run: Path) -> None:
    before = {path: path.stat().st_mtime_ns for path in (run / "assets").rglob("*")}
    content_before = content(run)
    code, told, said = finished(generate(run, "--workers", "2"))
    assert code == 0, told + said
    assert {path: path.stat().st_mtime_ns for path in (run / "assets").rglob("*")} == before
    assert content(run) == content_before


def test_a_full_disk_stops_with_one_line_and_keeps_nothing_half_written(tmp_path: Path) -> None:
    """A limit on file size stands in for a full disk: writes fail with EFBIG as with ENOSPC."""
    out = tmp_path / "out"
    told = subprocess.run(
        [sys.executable, "-m", "artgen", "generate", *SMALL, "--out", str(out)],
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (30_000, 30_000)),
    )
    assert told.returncode != 0
    assert "Traceback" not in told.stderr
    assert not list(out.glob("assets/*/*"))
