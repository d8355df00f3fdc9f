"""What README and docs say of the program is so: commands parse, links lead somewhere, names are.

A program in a page (```python, ```sql) is run by the tests of what it is about.
"""

import ast
import importlib.util
import re
import shlex
import tomllib
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import get_args, get_type_hints

import pytest

from artgen.cli import introduction
from artgen.rules import parse_override
from model.config import Config
from model.training.cli import Train
from model.training.recipes import RECIPES
from model.training.settings import changed
from tests.documents import (
    PAGES,
    ROOT,
    anchors,
    commands,
    dotted_names,
    examples,
    help_of,
    parsed,
    parsers,
    prose,
    spans,
)

PACKAGES = ("artgen", "renders", "model", "blender_scripts", "category_rules", "tests")
SOURCES = [path for name in PACKAGES for path in (ROOT / name).rglob("*.py")]
DOCS = ROOT / "docs"
BLOCKS = re.MULTILINE | re.DOTALL
TARGETS = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), flags=re.MULTILINE))
pages = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())


@pages
def test_every_command_is_understood(page: Path) -> None:
    for command in commands(page.read_text()):
        check_command(command)


def test_every_example_of_the_help_is_understood() -> None:
    found = re.findall(r"^  (artgen [a-z].*?)(?:  |$)", introduction(), flags=re.MULTILINE)
    for path in SOURCES:
        if path.name != "documents.py" and "tyro.cli(" in (text := path.read_text()):
            found += examples(text)
    assert len(found) > 30  # Fewer, and they are overlooked.
    for example in found:
        for command in commands(f"```\n{example}\n```"):
            check_command(command)


def check_command(command: str) -> None:
    """A command of ours is one that its parser takes; modules, files and targets are there."""
    if not command.startswith(("artgen ", "python ", "pytest ", "make ")):
        return
    match shlex.split(re.split(r" [|<>] ", command)[0]):
        case ["artgen", *rest] if "--help" not in rest:
            check_settings(parsed(rest))
        case ["python", "-m", module, *_]:
            assert importlib.util.find_spec(module), command
        case ["python" | "pytest", file, *_]:
            assert (ROOT / file).exists() or "/" not in file, command
        case ["make", *rest]:
            assert {word for word in rest if "=" not in word} <= TARGETS, command


def check_settings(command: object) -> None:
    """Settings given as KEY=VALUE are those of the rules, or of the recipe."""
    words = getattr(command, "set", ())
    if isinstance(command, Train):
        changed(RECIPES[command.recipe](command.size), words)
    else:
        for word in words:
            parse_override(word)


def test_what_is_not_understood_is_found() -> None:
    """The negative control of the test above."""
    for command in (
        "artgen render out --veiws 3",
        "artgen study shift --library x.npz",
        "python -m tests.bench.nothing",
        "pytest tests/nothing.py",
        "make nothing",
    ):
        with pytest.raises((SystemExit, AssertionError)):
            check_command(command)


@pytest.mark.parametrize("page", ["art_model", "validation"])
def test_programs_that_need_no_files_run(page: str) -> None:
    (program,) = re.findall(r"^```python\n(.*?)^```$", (DOCS / f"{page}.md").read_text(), BLOCKS)
    exec(compile(program, page, "exec"), {})


def test_the_rule_that_is_shown_is_the_one_that_ships() -> None:
    """Shortened: fewer parameters, the source cut off; what is shown of it is equal."""
    (text,) = re.findall(r"^```toml\n(.*?)^```$", (DOCS / "add_a_category.md").read_text(), BLOCKS)
    shown = tomllib.loads(text)
    rule = tomllib.loads((ROOT / "category_rules" / "toolbox.toml").read_text())
    assert shown["category"] == rule["category"]
    for table in ("band", "sample"):
        kept = {key: value for key, value in shown[table].items() if key != "source"}
        assert kept == {key: rule[table][key] for key in kept}


@pages
def test_every_option_in_the_prose_exists(page: Path) -> None:
    beside = (ROOT / "blender_scripts" / "render_shard.py").read_text()
    for span in spans(page.read_text()):
        named = re.match(r"artgen ([a-z-]+)(?: ([a-z-]+))?", span)
        words = named.groups() if named else ()
        assert not named or words[:1] in parsers(), span
        for option in re.findall(r"(?<![\w-])--[a-z][\w.-]*", span):
            asked = [words if words in parsers() else words[:1]] if named else sorted(parsers())
            helps = ["" if named else beside, *(help_of(*one) for one in asked)]
            whole = re.compile(rf"(?<![\w-]){re.escape(option)}(?![\w-])")
            assert any(whole.search(text) for text in helps), span


@pages
def test_every_link_leads_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)\s\"]+)\)", prose(page.read_text())):
        if target.startswith(("https:", "http:")):
            continue
        file, _, anchor = target.partition("#")
        there = page.parent / file if file else page
        assert there.exists(), target
        assert not anchor or anchor in anchors(there.read_text()), target


@pages
def test_every_dotted_name_exists(page: Path) -> None:
    """Settings, modules and what they define; files and groups of entry points are neither."""
    known = setting_names(Config) | {"artgen.commands", "artgen.segmenters"}
    files = (".json", ".safetensors", ".toml", ".md", ".npz", ".py")
    for name in dotted_names(page.read_text()):
        assert name in known or name.endswith(files) or is_defined(name), name


@pages
def test_every_file_and_test_exists(page: Path) -> None:
    tests = {path.stem for path in SOURCES}
    for span in spans(page.read_text()):
        if re.fullmatch(rf"(?:{'|'.join(PACKAGES)}|docs|examples)/[\w./*-]+", span):
            assert "NAME" in span or list(ROOT.glob(span.rstrip("/"))), span
        if re.fullmatch(r"test_\w+", span):
            assert span in tests, span


def setting_names(kind: type, prefix: str = "") -> set[str]:
    """Dotted names of all settings below a class, tables included."""
    hints, found = get_type_hints(kind), set()
    for name in (field.name for field in fields(kind)):
        found.add(prefix + name)
        for inner in (hints[name], *get_args(hints[name])):
            if is_dataclass(inner) and isinstance(inner, type):
                found |= setting_names(inner, f"{prefix}{name}.")
    return found


def is_defined(name: str) -> bool:
    """Whether a dotted name is a module, or something that a module defines or passes on."""
    *above, last = name.split(".")
    place = ROOT.joinpath(*above, last)
    if place.is_dir() or place.with_suffix(".py").exists():
        return True
    place = ROOT.joinpath(*above)
    source = place / "__init__.py" if place.is_dir() else place.with_suffix(".py")
    if not source.exists():
        return len(above) > 1 and is_defined(".".join(above))
    nodes = list(ast.walk(ast.parse(source.read_text())))
    keys = ("name", "asname", "id")
    return last in {getattr(node, key, None) for node in nodes for key in keys}
