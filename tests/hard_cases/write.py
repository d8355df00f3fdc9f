"""`python -m tests.hard_cases.write`: measure every hard case and write docs/hard_cases.md."""

from pathlib import Path

from tests.hard_cases.case import HardCase
from tests.hard_cases.test_hard_cases import CASES

PAGE = Path(__file__).parents[2] / "docs" / "hard_cases.md"
HEAD = """# Hard cases

Cases that break simulators and geometry kernels. Each holds to a bound that is derived, not tuned;
`tests/hard_cases/` measures it at every run of the tests, and shows that what happens outside the
case does not pass silently. This page is written by `make hard-cases`.
"""


def page() -> str:
    """The page with fresh measurements."""
    return "\n".join([HEAD, *(_section(case) for case in CASES)])


def _section(case: HardCase) -> str:
    unit = f" {case.unit}" if case.unit else ""
    return (
        f"## {_capital(case.name)}\n\n"
        f"- **Why**: {case.reason}.\n"
        f"- **Bound**: {case.bound:.2g}{unit}; {case.derived}.\n"
        f"- **Measured**: {case.error():.2g}{unit}.\n"
        f"- **Outside**: {case.outside}.\n"
    )


def _capital(text: str) -> str:
    return text[0].upper() + text[1:]


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
