"""Lines about a study while it runs, on the terminal."""


def tell(line: str) -> None:
    """Say it at once."""
    print(line, flush=True)  # noqa: T201
