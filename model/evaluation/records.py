"""Records kept as files, so that an interrupted evaluation goes on."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from artgen.core.jsonio import write_json
from model.evaluation.joints import JointErrors
from model.evaluation.score import Record

SCHEMA = "artgen-evaluation-object/2"


def record_path(folder: Path, name: str) -> Path:
    """Where the record of an object lies."""
    return folder / f"{name.replace('/', '__')}.json"


def picture_path(folder: Path, name: str) -> Path:
    """Where the picture of an object lies."""
    return record_path(folder, name).with_suffix(".png")


def keep_record(folder: Path, record: Record, key: str) -> None:
    """Write a record with what it depends on."""
    body = {"schema": SCHEMA, "key": key, "record": asdict(record)}
    write_json(record_path(folder, record.name), body)


def kept_record(folder: Path, name: str, key: str) -> Record | None:
    """The record of an earlier run, where nothing that it depends on has changed."""
    try:
        stated = json.loads(record_path(folder, name).read_text(encoding="utf-8"))
        if stated["schema"] != SCHEMA or stated["key"] != key:
            return None
        return _record(stated["record"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _record(stated: dict[str, Any]) -> Record:
    joints = tuple(JointErrors(**row) for row in stated.pop("joints"))
    return Record(**stated, joints=joints)
