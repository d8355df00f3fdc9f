"""What the pages say, in a form that can be checked: commands, code spans, headings."""

import io
import re
import shlex
from collections.abc import Iterator, Sequence
from contextlib import redirect_stdout, suppress
from dataclasses import dataclass
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any
from unittest.mock import patch

import tyro

from artgen.cli import found_commands

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
SHELL = {"", "sh", "bash"}
"""Languages of the blocks that hold commands; most have none."""

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", flags=re.MULTILINE | re.DOTALL)
INDENTED = re.compile(r"(?<=\n\n)(?:    .*\n)+")
BEFORE = re.compile(r"^(?:\w+=\S+ )*(?:torchrun (?:(?!--no-python).)*--no-python -- )?")
"""What may stand before a command: variables, and torchrun with its own words."""


@dataclass(frozen=True)
class Parsed(BaseException):
    """Ends a command where its words were understood, before it does anything."""

    command: object


def prose(text: str) -> str:
    """A page without its blocks of code."""
    return INDENTED.sub("", BLOCK.sub("", text))


def commands(text: str) -> Iterator[str]:
    """Every line of a page's blocks, and every command of a line, without what stands before."""
    blocks = [body for language, body in BLOCK.findall(text) if language in SHELL]
    blocks += [re.sub("^    ", "", body, flags=re.MULTILINE) for body in INDENTED.findall(text)]
    for block in blocks:
        for line in block.replace("\\\n", " ").splitlines():
            for command in re.sub(r"(^|\s)#.*", "", line).split("&&"):
                yield BEFORE.sub("", command.strip())


def spans(text: str) -> Iterator[str]:
    """The code spans of a page's prose."""
    yield from re.findall(r"(?<!`)`([^`]+)`(?!`)", prose(text).replace("\n", " "))


def dotted_names(text: str) -> set[str]:
    """Names such as `train.steps` and `artgen.core.stream.Stream` in a page's code spans."""
    first = "artgen|renders|model|train|weights|data|tests|blender_scripts"
    name = rf"(?<![\w./-])(?:{first})(?:\.\w+)+(?![\w/])"
    return {found for span in spans(text) for found in re.findall(name, span)}


def examples(source: str) -> Iterator[str]:
    """The commands that docstrings of a module show, each on a line of its own."""
    joined = re.sub(r"\\{1,2}\n\s*", "", source)
    yield from re.findall(r"^    ((?:artgen|torchrun) [^\n`(]+)$", joined, flags=re.MULTILINE)


def parsed(words: Sequence[str]) -> object:
    """What the command line's parser makes of `artgen WORDS`; nothing is run.

    Raises:
        SystemExit: it is not understood; stderr says why.
    """
    understood = tyro.cli

    def cli(*args: Any, **options: Any) -> object:
        raise Parsed(understood(*args, **options))

    with patch("tyro.cli", cli):
        try:
            found_commands()[words[0]].load()(list(words[1:]))
        except Parsed as found:
            return found.command
    raise AssertionError(f"artgen {shlex.join(words)} asks no parser")


@cache
def help_of(*words: str) -> str:
    """What `artgen WORDS --help` prints."""
    out = io.StringIO()
    with redirect_stdout(out), suppress(SystemExit):
        found_commands()[words[0]].load()([*words[1:], "--help"])
    return out.getvalue()


@cache
def parsers() -> set[tuple[str, ...]]:
    """The words that lead to a parser each."""
    studies = {("study", entry.name) for entry in entry_points(group="artgen.studies")}
    actions = {
        "farm": "plan export collect",
        "ingest": "partnet urdf static",
        "export": "partnet",
        "library": "build",
        "shard": "pack verify repack publish",
    }
    below = {(name, action) for name, listed in actions.items() for action in listed.split()}
    return studies | below | {(name,) for name in found_commands()}


def anchors(text: str) -> set[str]:
    """What links into a page can point at, by the rule of GitHub."""
    found = re.findall(r"^#+ (.+)$", BLOCK.sub("", text), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in found}
