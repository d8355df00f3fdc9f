"""Rules of the house that no linter knows."""

import ast
import subprocess
from pathlib import Path

import pytest

from artgen.cli import found_commands

ROOT = Path(__file__).parent.parent
PACKAGES = ("artgen", "renders", "blender_scripts", "category_rules", "model")
SOURCES = sorted(path for name in PACKAGES for path in (ROOT / name).rglob("*.py"))
LEFT_BEHIND = {".glb", ".tar", ".blend", ".npz", ".db", ".sqlite", ".log", ".partial", ".lock"}
"""Suffixes of what runs, tests and tools write."""
ROOTS = (
    *PACKAGES,
    *(".ci", "docs", "examples", "tests"),
    *(".gitignore", "CHANGELOG.md", "LICENSE", "Makefile", "README.md", "pyproject.toml"),
)
"""All that lies at the root."""
BANNED_NAMES = {"utils", "util", "common", "helpers", "base", "manager", "misc"}


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_files_and_functions_stay_small_and_speak(path: Path) -> None:
    text = path.read_text()
    assert text.count("\n") <= 400
    assert path.stem not in BANNED_NAMES
    tree = ast.parse(text)
    assert ast.get_docstring(tree)
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            assert (node.end_lineno or 0) - node.lineno < 60, node.name


CATEGORIES = sorted(
    path.stem
    for path in (ROOT / "category_rules").glob("*.toml")
    if not path.stem.startswith("_surfaces")
)


@pytest.mark.parametrize("category", CATEGORIES)
def test_a_rule_and_its_builder_are_small(category: str) -> None:
    """What is long, or could serve another category, lies in the kit."""
    rule = ROOT / "category_rules" / f"{category}.toml"
    builder = ROOT / "artgen" / "generators" / f"{category}.py"
    assert rule.read_text().count("\n") + builder.read_text().count("\n") <= 250


def test_generators_are_builders_and_their_kit() -> None:
    builders = {path.stem for path in (ROOT / "artgen" / "generators").glob("*.py")}
    assert builders - {"__init__"} == set(CATEGORIES)


def _tracked() -> list[str]:
    """Paths that git lists, of files and links that are there."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split("\0")
    return [name for name in filter(None, listed) if (ROOT / name).is_file()]


def test_nothing_large_or_foreign_is_tracked() -> None:
    for name in _tracked():
        path = ROOT / name
        ships = name.startswith("model/checkpoints/")
        assert path.stat().st_size <= (30_000_000 if ships else 1_500_000), name
        assert path.suffix not in LEFT_BEHIND, name


def test_what_a_run_leaves_at_the_root_is_not_tracked() -> None:
    """Tests once left `run/` there and a data base beside it. What is new at the root is written
    into `ROOTS` by whoever means it."""
    assert {name.partition("/")[0] for name in _tracked()} == set(ROOTS)


def test_the_readme_names_every_command() -> None:
    readme = (ROOT / "README.md").read_text()
    for name in found_commands():
        assert f"`artgen {name}" in readme
