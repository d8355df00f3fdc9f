"""JSON that carries its own digest, so that a flipped bit anywhere in it is found."""

import json
from collections.abc import Mapping
from typing import Any

from artgen.core.errors import ShardError
from artgen.core.jsonio import content_hash, plain


def sealed(facts: Mapping[str, Any]) -> dict[str, Any]:
    """The facts and their `digest`: the sha256 of their canonical JSON."""
    return {**plain(facts), "digest": content_hash(facts)}


def unsealed(data: bytes, *, where: str, schema: str) -> dict[str, Any]:
    """The facts of a text that `sealed` made, digest included.

    Raises:
        ShardError: it is no JSON, of another schema, or not what was written.
    """
    try:
        facts = json.loads(data)
    except ValueError as error:
        raise ShardError(
            f"{where}: is not JSON (offset {fault_offset(error)}: {error}); copy it again, or "
            "pack again"
        ) from error
    found = facts.get("schema") if isinstance(facts, dict) else None
    if found != schema:
        raise ShardError(
            f"{where}: schema is {found!r}, this release reads {schema!r}; pack again from the "
            "samples, or use the release that wrote it"
        )
    stated = {key: value for key, value in facts.items() if key != "digest"}
    if content_hash(stated) != facts.get("digest"):
        raise ShardError(
            f"{where}: its digest is not that of its content; it is corrupt: copy it again, or "
            "pack again"
        )
    return dict(facts)


def fault_offset(error: ValueError) -> int:
    """Where JSON's parser, or UTF-8's decoder, stopped; bytes."""
    if isinstance(error, json.JSONDecodeError):
        return len(error.doc[: error.pos].encode())
    return error.start if isinstance(error, UnicodeDecodeError) else 0
