"""A made-up run folder: bundles' manifests, a failed asset, and staged samples."""

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from artgen.articulation.types import Limit
from artgen.core.jsonio import plain, write_json
from artgen.dataset.packing import stage
from artgen.export.manifest import manifest
from artgen.validate.report import Finding
from tests.strategies import chest, drawer_unit
from tests.unit.dataset.scenes import made_sample

OPENING_DEG: Mapping[str, float] = {
    "laptop_000000": 110.0,
    "laptop_000001": 119.5,
    "laptop_000002": 135.0,
    "laptop_000003": 180.0,
    "cabinet_000000": 170.0,
}
"""Upper limit of each hinge; `cabinet_000001` has drawers instead."""
WIDE = ["laptop_000002", "laptop_000003"]
"""Laptops whose hinge opens past 120 degrees."""


def made_run(out: Path) -> Path:
    """Six valid assets, of which `cabinet_000001` was not rendered, and two failed ones."""
    for asset_id, upper_deg in OPENING_DEG.items():
        write_bundle_manifest(out / "assets", asset_id, upper_deg=upper_deg)
        category, index = asset_id.split("_")
        sample = made_sample(asset_id, seed=int(upper_deg), views=1)
        stage(out / "samples" / category / f"{index}.tar", sample)
    write_json(
        out / "assets" / "cabinet" / "000001" / "manifest.json",
        manifest(replace(drawer_unit(), category="cabinet", asset_id="cabinet_000001"), out),
    )
    write_bundle_manifest(out / "failed", "laptop_000004", upper_deg=179.0)
    finding = Finding(
        check="L3.clearance", part="lid", value=1e-6, bound="0", cause="lid hits base", remedy="?"
    )
    report = {"findings": [plain(finding)]}
    write_json(out / "failed" / "laptop" / "000004" / "report.json", report)
    write_json(out / "failed" / "laptop" / "000005" / "error.json", {"error": "worker crashed"})
    return out


def write_bundle_manifest(root: Path, asset_id: str, *, upper_deg: float) -> None:
    """The manifest that export writes for a chest whose lid opens so far."""
    category, index = asset_id.split("_")
    obj = chest()
    joint = replace(obj.joints[0], limit=Limit(lower=0.0, upper=math.radians(upper_deg)))
    obj = replace(
        obj,
        category=category,
        asset_id=asset_id,
        joints=(joint, *obj.joints[1:]),
        provenance={"seed": 7, "index": int(index), "rule": {"version": 3, "digest": "d"}},
    )
    folder = root / category / index
    folder.mkdir(parents=True)
    (folder / "asset.glb").write_bytes(b"glb")
    write_json(folder / "manifest.json", manifest(obj, folder))
