"""The page that names every source file with the first line of its docstring."""

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "tree.md"
PACKAGES = ("artgen", "blender_scripts", "category_rules", "renders", "model")
HEAD = "# Every source file\n\nWritten by `make goldens` from the files' own first lines.\n"


def page() -> str:
    """The whole page."""
    return HEAD + "".join(f"\n{line}" for package in PACKAGES for line in lines(package)) + "\n"


def lines(package: str) -> Iterator[str]:
    """Headings for folders, a line for each file."""
    for folder in sorted({path.parent for path in (ROOT / package).rglob("*.py")}):
        yield f"## {folder.relative_to(ROOT).as_posix()}/\n"
        for path in sorted(folder.glob("*.py")):
            text = (ast.get_docstring(ast.parse(path.read_text())) or "").split("\n\n")[0]
            yield f"- `{path.name}` {' '.join(text.split())}"
        yield ""
