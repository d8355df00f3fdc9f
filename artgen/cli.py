"""The `artgen` command: finds its sub-commands by entry point and turns errors into exit codes."""

import ast
import errno
import logging
import os
import select
import sys
from collections.abc import Callable, Sequence
from importlib.metadata import EntryPoint, entry_points
from importlib.util import find_spec
from pathlib import Path

from artgen import __version__
from artgen.core.errors import ArtgenError, UsageError

Command = Callable[[Sequence[str]], int]

FULL_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
DENIED = (errno.EACCES, errno.EPERM, errno.EROFS)

EXTRA_OF = {"torch": "model", "safetensors": "model", "skimage": "model", "tensorboard": "model"}
"""What to install where a module is missing that only some commands need."""

INTRODUCTION = """\
artgen {version}: procedural articulated 3D objects, from category rules to training shards.

usage: artgen COMMAND [OPTIONS]        (artgen COMMAND --help explains each option)

Start here:
  artgen doctor                                        is this machine ready?
  artgen generate --out out                            rules -> assets -> renders -> shards
  artgen generate --categories laptop cabinet --count 200 --seed 7 --workers 2
  artgen generate --categories safe --count 5 --set safe.lock=dial --out safes
  artgen sheet laptop --count 8                        what a category looks like
  artgen inspect out/assets/laptop/000000              what is in a bundle
  artgen ingest partnet ~/partnet-mobility             other people's objects as such bundles
  artgen assemble storage_furniture --count 20         new furniture of old parts
  artgen train debug                                   the reconstruction network, in a minute

Commands:
{commands}

Exit codes: 0 done, 1 done but some assets failed, 2 could not run, 130 interrupted (run again to
resume).
"""


def found_commands() -> dict[str, EntryPoint]:
    """Sub-commands by name, from every installed distribution."""
    return {entry.name: entry for entry in entry_points(group="artgen.commands")}


def run_command(name: str, argv: Sequence[str]) -> int:
    """Run one sub-command in this process; its exit code.

    Raises:
        UsageError: it needs packages of an extra that is not installed.
    """
    try:
        command: Command = found_commands()[name].load()
        return command(argv)
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        if module not in EXTRA_OF:
            raise
        raise UsageError(
            f"artgen {name} needs {module}, which is not installed: "
            f"pip install 'artgen[{EXTRA_OF[module]}]'"
        ) from error


def introduction() -> str:
    """The text of `artgen --help`."""
    lines = []
    for name, entry in sorted(found_commands().items()):
        lines.append(f"  {name:<12} {_first_line(entry)}")
    return INTRODUCTION.format(version=__version__, commands="\n".join(lines))


def _first_line(entry: EntryPoint) -> str:
    """Of a command's docstring, read from its source: loading all commands would load torch."""
    spec = find_spec(entry.module)
    if spec is None or spec.origin is None:
        return "(cannot be found; install artgen anew)"
    for node in ast.parse(Path(spec.origin).read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef) and node.name == entry.attr:
            return (ast.get_docstring(node) or "").partition("\n")[0]
    return "(cannot be found; install artgen anew)"


def main(argv: Sequence[str] | None = None) -> int:
    """Exit code of `artgen ARGV`; every expected fault is one line on stderr, never a traceback."""
    words = list(sys.argv[1:] if argv is None else argv)
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    try:
        return _dispatched(words)
    except ArtgenError as error:
        print(f"artgen: {error}", file=sys.stderr)  # noqa: T201
        return 2
    except OSError as error:
        print(f"artgen: {_explained(error)}", file=sys.stderr)  # noqa: T201
        return 2
    except KeyboardInterrupt:
        return _interrupted()
    except BrokenPipeError:
        if not _nobody_reads():
            return _interrupted()  # Ctrl-C reached a process that was just starting before us.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _interrupted() -> int:
    print(  # noqa: T201
        "artgen: interrupted; what was finished is kept, the same command resumes",
        file=sys.stderr,
    )
    return 130


def _nobody_reads() -> bool:
    """Whether the reader of our output is gone, as after `| head`."""
    poller = select.poll()
    poller.register(sys.stdout.fileno(), 0)
    gone = select.POLLERR | select.POLLHUP
    return any(event & gone for _, event in poller.poll(0))


def _dispatched(words: Sequence[str]) -> int:
    if not words or words[0] in ("-h", "--help", "help"):
        print(introduction())  # noqa: T201
        return 0 if words else 2
    if words[0] in ("-V", "--version", "version"):
        print(f"artgen {__version__}")  # noqa: T201
        return 0
    commands = found_commands()
    if words[0] not in commands:
        known = ", ".join(sorted(commands))
        print(f"artgen: no command {words[0]!r}; known: {known}", file=sys.stderr)  # noqa: T201
        return 2
    return run_command(words[0], words[1:])


def _explained(error: OSError) -> str:
    """One line for a fault of the file system; others are passed on with their own words."""
    place = error.filename or "the output folder"
    if error.errno in FULL_DISK:
        return (
            f"{place}: no space left; free some or choose another --out, then run the same command"
        )
    if error.errno in DENIED:
        return f"{place}: not writable ({error.strerror}); choose another --out"
    return f"{place}: {error.strerror or error}"
