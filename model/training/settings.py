"""Settings given by hand: `train.steps=2000` changes one value of a configuration."""

import json
from collections.abc import Sequence
from typing import Any

from artgen.core.errors import UsageError, did_you_mean
from artgen.core.jsonio import canonical_json, plain
from model.config import Config


def changed(config: Config, words: Sequence[str]) -> Config:
    """The configuration with `KEY=VALUE` applied; keys are dotted, values JSON or plain words.

    Raises:
        UsageError: a word has another form, or its key does not exist.
        ModelError: a value is of another type than the key's.
    """
    if not words:
        return config
    tree = plain(config)
    for word in words:
        key, equals, text = word.partition("=")
        if not (equals and key and text):
            raise UsageError(f"--set {word}: expected KEY=VALUE, such as train.steps=2000")
        *above, last = key.split(".")
        table = tree
        for step in above:
            table = _entry(table, step, word)
        _entry(table, last, word)
        table[last] = _value(text)
    return Config.from_json(canonical_json(tree))


def _entry(table: Any, key: str, word: str) -> Any:
    if not isinstance(table, dict):
        raise UsageError(f"--set {word}: nothing lies below the key before {key!r}")
    if key not in table:
        raise UsageError(
            f"--set {word}: no {key!r}{did_you_mean(key, list(table))}; known: {', '.join(table)}"
        )
    return table[key]


def _value(text: str) -> Any:
    try:
        return json.loads(text)
    except json.JSONDecodeError:
        return text
