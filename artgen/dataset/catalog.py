"""The catalog: Parquet tables of assets and of samples, for DuckDB, pandas or anything else.

Rows are sorted by asset id and files are zstd-compressed; equal assets give equal bytes.
"""

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from artgen.core.errors import ExportError, ShardError
from artgen.core.jsonio import read_object, replace_atomically
from artgen.dataset.listing import Listed, listed_assets
from artgen.dataset.packing import Packing
from artgen.dataset.reader import open_shard
from artgen.dataset.split import families_of, split_of

BUNDLE_SCHEMA = "artgen-bundle/2"

_JOINT = pa.struct(
    [
        ("name", pa.string()),
        ("type", pa.string()),
        ("parent", pa.string()),
        ("child", pa.string()),
        ("lower", pa.float64()),
        ("upper", pa.float64()),
        ("lower_deg", pa.float64()),
        ("upper_deg", pa.float64()),
        ("friction", pa.float64()),
    ]
)
ASSETS = pa.schema(
    [
        ("asset_id", pa.string()),
        ("category", pa.string()),
        ("seed", pa.int64()),
        ("index", pa.int64()),
        ("split", pa.string()),
        ("donors", pa.list_(pa.string())),
        ("verdict", pa.string()),
        ("reason", pa.string()),
        ("mass", pa.float64()),
        ("width", pa.float64()),
        ("depth", pa.float64()),
        ("height", pa.float64()),
        ("radius", pa.float64()),
        ("triangles", pa.int64()),
        ("parts", pa.list_(pa.struct([("name", pa.string()), ("label", pa.string())]))),
        ("joints", pa.list_(_JOINT)),
        ("opening_deg", pa.float64()),
        ("travel", pa.float64()),
        ("rule_version", pa.int64()),
        ("artgen", pa.string()),
        ("folder", pa.string()),
        ("files", pa.int64()),
        ("bytes", pa.int64()),
        ("shard", pa.string()),
    ]
)
"""Columns of assets.parquet; lengths in m, angles in rad, `*_deg` in degrees (null for sliders).

`opening_deg` is the farthest that a hinge opens, `travel` the farthest that a slider does.
"""
SAMPLES = pa.schema(
    [
        ("asset_id", pa.string()),
        ("category", pa.string()),
        ("split", pa.string()),
        ("shard", pa.string()),
        ("states", pa.int64()),
        ("views", pa.int64()),
        ("parts", pa.int64()),
        ("parts_left_out", pa.list_(pa.string())),
        ("height", pa.int64()),
        ("width", pa.int64()),
        ("shading", pa.string()),
        ("light", pa.string()),
        ("q", pa.list_(pa.map_(pa.string(), pa.float64()))),
        ("offset", pa.int64()),
        ("bytes", pa.int64()),
    ]
)
"""Columns of samples.parquet; `offset` is the first image byte's place in the shard."""


def write_catalog(out: Path, packing: Packing) -> tuple[Path, Path]:
    """Write `catalog/assets.parquet` and `catalog/samples.parquet` of a run's folder.

    Raises:
        ShardError: a bundle's manifest has another schema, or a shard does not open.
    """
    assets, samples = out / "catalog" / "assets.parquet", out / "catalog" / "samples.parquet"
    _write(assets, ASSETS, list(asset_rows(out, packing)))
    _write(samples, SAMPLES, list(sample_rows(out / "shards", packing)))
    return assets, samples


def asset_rows(out: Path, packing: Packing) -> Iterator[dict[str, Any]]:
    """One row per asset that passed or failed."""
    shard_of = packing.shard_of
    for asset in listed_assets(out):
        yield _bundle_columns(asset) | {
            "asset_id": asset.asset_id,
            "category": asset.category,
            "verdict": "valid" if asset.valid else "failed",
            "reason": packing.left_out.get(asset.asset_id),
            "folder": Path(os.path.relpath(asset.bundle, out)).as_posix(),
            "shard": shard_of.get(asset.asset_id),
        }


def sample_rows(shards: Path, packing: Packing) -> Iterator[dict[str, Any]]:
    """One row per packed sample."""
    for manifest in packing.shards:
        shard = open_shard(shards / manifest.file)
        for asset_id, places in shard.index.items():
            facts = shard.facts(asset_id)
            yield (
                {
                    "asset_id": asset_id,
                    "category": facts["category"],
                    "split": split_of(asset_id, facts["donors"]),
                    "shard": manifest.file,
                    "parts": len(facts["parts"]),
                    "q": [list(state.items()) for state in facts["states"]],
                    "offset": places[0].offset,
                    "bytes": sum(place.size for place in places),
                }
                | {key: facts["shape"][key] for key in ("states", "views", "height", "width")}
                | {key: facts[key] for key in ("parts_left_out", "shading", "light")}
            )


def _bundle_columns(asset: Listed) -> dict[str, Any]:
    """Columns from a bundle's manifest; nearly none for an asset that failed for lack of one."""
    path = asset.bundle / "manifest.json"
    number = asset.bundle.name
    nothing: dict[str, Any] = {
        "parts": [],
        "joints": [],
        "index": int(number) if number.isdigit() else None,
        "split": split_of(asset.asset_id),
        "donors": [],
    }
    try:
        facts = read_object(path, remedy="make the asset again")
    except ExportError:
        if not asset.valid:
            return nothing
        raise
    if facts.get("schema") != BUNDLE_SCHEMA and not asset.valid:
        return nothing
    if facts.get("schema") != BUNDLE_SCHEMA:
        raise ShardError(
            f"{path}: bundle schema is {facts.get('schema')!r}, the catalog reads "
            f"{BUNDLE_SCHEMA!r}; generate the asset again into a new folder"
        )
    (x0, y0, z0), (x1, y1, z1) = facts["bounds"]
    joints = [_joint_columns(joint) for joint in facts["joints"]]
    slides = [joint["upper"] for joint in joints if joint["type"] == "prismatic"]
    openings = [joint["upper_deg"] for joint in joints if joint["upper_deg"] is not None]
    donors = families_of(facts)
    return {
        "split": split_of(asset.asset_id, donors),
        "donors": list(donors),
        "seed": facts.get("seed"),
        "index": facts.get("index"),
        "mass": facts["mass"],
        "width": x1 - x0,
        "depth": y1 - y0,
        "height": z1 - z0,
        "radius": facts["radius"],
        "triangles": sum(part["triangles"] for part in facts["parts"]),
        "parts": [{"name": part["name"], "label": part["label"]} for part in facts["parts"]],
        "joints": joints,
        "opening_deg": max(openings, default=None),
        "travel": max(slides, default=None),
        "rule_version": facts.get("rule", {}).get("version"),
        "artgen": facts.get("versions", {}).get("artgen"),
        "files": len(facts["files"]),
        "bytes": sum(file["bytes"] for file in facts["files"].values()),
    }


def _joint_columns(joint: Mapping[str, Any]) -> dict[str, Any]:
    row = {key: joint.get(key) for key in _JOINT.names}
    for end in ("lower", "upper"):
        turns = joint["type"] != "prismatic" and joint[end] is not None
        row[f"{end}_deg"] = math.degrees(joint[end]) if turns else None
    return row


def _write(path: Path, columns: pa.Schema, rows: Sequence[Mapping[str, Any]]) -> None:
    ordered = sorted(rows, key=lambda row: str(row["asset_id"]))
    table = pa.Table.from_pylist(ordered, schema=columns)
    replace_atomically(path, lambda partial: pq.write_table(table, partial, compression="zstd"))
