"""`make goldens`: rewrite the summaries; raise the category's version and note a data change."""

from artgen.core.jsonio import write_json
from tests.golden.summary import FOLDER, summary
from tests.golden.tree import PAGE, page
from tests.made import CATEGORIES, finished


def main() -> None:
    """One file a category, for index 0 of the tests' seed."""
    for category in CATEGORIES:
        write_json(FOLDER / f"{category}.json", summary(finished(category, 0)))
    PAGE.write_text(page())


if __name__ == "__main__":
    main()
