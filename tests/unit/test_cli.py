"""The command line: every expected fault is one line and exit code 2, never a traceback."""

import errno
import os
import signal
import subprocess
import sys
import time
from functools import partial
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from artgen import cli
from artgen.core.errors import RuleError


def run(*words: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "artgen", *words],
        capture_output=True,
        text=True,
        cwd=cwd,
        check=False,
    )


def test_help_teaches_every_command() -> None:
    told = run("--help")
    assert told.returncode == 0
    for name in cli.found_commands():
        assert f"\n  {name} " in told.stdout
    assert "cannot be found" not in told.stdout
    assert "Exit codes: 0 done" in told.stdout


def test_a_command_without_its_extra_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Help of all commands needs none of their packages."""
    source = 'import torch_that_is_not_there\n\ndef grow(argv):\n    """Grow trees."""\n'
    (tmp_path / "orchard.py").write_text(source)
    monkeypatch.syspath_prepend(str(tmp_path))
    entry = EntryPoint(name="grow", value="orchard:grow", group="artgen.commands")
    monkeypatch.setattr(cli, "found_commands", lambda: {"grow": entry})
    monkeypatch.setitem(cli.EXTRA_OF, "torch_that_is_not_there", "model")
    assert cli.main(["--help"]) == 0
    assert "  grow         Grow trees." in capsys.readouterr().out
    assert cli.main(["grow"]) == 2
    assert capsys.readouterr().err == (
        "artgen: artgen grow needs torch_that_is_not_there, which is not installed: "
        "pip install 'artgen[model]'\n"
    )


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["generat"], "no command 'generat'; known: "),
        (["generate", "--categories", "labtop"], "no category 'labtop' (did you mean 'laptop'?)"),
        (["generate", "--count", "0"], "--count 0 makes nothing"),
        (["generate", "--count", "-3"], "--count -3 makes nothing"),
        (["generate", "--workers", "0"], "--workers 0"),
        (["inspect", "nowhere"], "nowhere/manifest.json cannot be read"),
    ],
)
def test_bad_words_get_one_line_and_exit_code_2(tmp_path: Path, words, message) -> None:
    told = run(*words, cwd=tmp_path)
    assert told.returncode == 2
    assert message in told.stderr
    assert "Traceback" not in told.stderr
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_option_gets_a_suggestion_and_exit_code_2(tmp_path: Path) -> None:
    told = run("generate", "--cuont", "3", cwd=tmp_path)
    assert told.returncode == 2
    assert "--count" in told.stderr + told.stdout
    assert "Traceback" not in told.stderr


@pytest.mark.parametrize(
    ("fault", "code", "message"),
    [
        (RuleError("x.toml: [a] wrong"), 2, "artgen: x.toml: [a] wrong"),
        (OSError(errno.ENOSPC, "No space left on device", "out/a"), 2, "out/a: no space left"),
        (PermissionError(errno.EACCES, "Permission denied", "out"), 2, "out: not writable"),
        (KeyboardInterrupt(), 130, "the same command resumes"),
    ],
)
def test_expected_faults_become_exit_codes(monkeypatch, capsys, fault, code, message) -> None:
    def broken(words):
        raise fault

    monkeypatch.setattr(cli, "_dispatched", broken)
    assert cli.main(["generate"]) == code
    assert message in capsys.readouterr().err


def test_a_fault_of_ours_is_not_hidden(monkeypatch) -> None:
    def broken(words):
        raise ZeroDivisionError

    monkeypatch.setattr(cli, "_dispatched", broken)
    with pytest.raises(ZeroDivisionError):
        cli.main(["generate"])


def test_ctrl_c_ends_a_run_with_130_and_leaves_nothing_half_made(tmp_path: Path) -> None:
    out = tmp_path / "out"
    running = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "artgen",
            "generate",
            "--count",
            "3",
            "--workers",
            "1",
            "--out",
            str(out),
        ],
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # A background job of a script inherits deafness to Ctrl-C, as under nohup.
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),
    )
    while not list(out.glob("logs/blender-*")) and running.poll() is None:  # at work
        time.sleep(0.05)
    os.killpg(running.pid, signal.SIGINT)
    _, said = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "the same command resumes" in said
    assert "Traceback" not in said
    assert not list((out / "assets").glob("*/*.partial"))


def test_categories_lists_every_rule() -> None:
    told = run("categories", "--verbose")
    assert told.returncode == 0
    for name in ("laptop", "dishwasher", "cabinet"):
        assert name in told.stdout
