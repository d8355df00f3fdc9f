"""The errors that artgen raises on purpose; each says where, what was found, what was expected,
what to do."""

import difflib
from collections.abc import Sequence


class ArtgenError(Exception):
    """A fault the user can act on; the command line prints it in one line and exits with 2."""


class RuleError(ArtgenError):
    """A category rule is misspelt, out of bounds, or impossible to satisfy."""


class GeometryError(ArtgenError):
    """A solid or mesh is open, empty, degenerate, or overlaps another."""


class KinematicError(ArtgenError):
    """A joint, limit, state or part tree is inconsistent."""


class ExportError(ArtgenError):
    """A bundle cannot be written or read."""


class RenderError(ArtgenError):
    """A render job failed or returned an image that cannot be right."""


class ShardError(ArtgenError):
    """A shard or catalog is truncated, corrupt, or of another schema."""


class WorkerError(ArtgenError):
    """A Blender process crashed, ran out of time or memory, or reported a fault."""


class ModelError(ArtgenError):
    """A checkpoint, images or training data of the model cannot be used, or training failed."""


class IngestError(ArtgenError):
    """A foreign object cannot be read, or cannot become one of ours."""


class UsageError(ArtgenError):
    """A command was given an argument, folder or machine it cannot work with."""


def did_you_mean(word: str, known: Sequence[str]) -> str:
    """` (did you mean 'x'?)`, or nothing."""
    close = difflib.get_close_matches(word, known, n=1)
    return f" (did you mean {close[0]!r}?)" if close else ""
