"""What came back from a farm, as images of the plans they were rendered for."""

import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import RenderError
from artgen.farm_manifest import DONE, Item, count_items, damage, read_items
from renders.backends import CYCLES, Backend, ExrImages
from renders.farm.folder import MANIFEST, portable
from renders.pictures import Pictures
from renders.plan import RenderPlan


@dataclass(frozen=True, kw_only=True)
class Returned:
    """An item of the manifest and what is known of its images.

    Attributes:
        number, digest: of the item.
        fault: why it cannot be collected; None where it can.
        blender: the version that rendered it, or None.
    """

    number: int
    digest: str
    fault: str | None
    blender: str | None


def returned(root: Path, images: Path) -> dict[str, Returned]:
    """Every item of a farm's manifest by its name, every image of it checked.

    Args:
        images: what `render_shard.py` was given as `--out`.

    Raises:
        UsageError: the manifest cannot be read.
    """
    manifest = root / MANIFEST
    count = range(count_items(manifest))
    items = read_items(manifest, count)
    return {item.name: _returned(number, item, images) for number, item in items}


def _returned(number: int, item: Item, images: Path) -> Returned:
    fault, blender = damage(images / item.name, item), None
    if fault is None:
        done = json.loads((images / item.name / DONE).read_text(encoding="utf-8"))
        blender = str(done.get("blender"))
    else:
        fault = _reported(images / f"{item.name}.error.json", item) or fault
    return Returned(number=number, digest=item.digest, fault=fault, blender=blender)


def _reported(path: Path, item: Item) -> str | None:
    """The fault that a task wrote down for this very item."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        return str(record["error"]) if record["item"] == item.digest else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def blenders(items: Mapping[str, Returned]) -> Counter[str]:
    """How many items each version of Blender rendered."""
    return Counter(item.blender for item in items.values() if item.blender is not None)


def frames(numbers: list[int]) -> str:
    """Numbers as `render_shard.py --frames` takes them: `0-4,7`."""
    spans: list[list[int]] = []
    for number in sorted(numbers):
        if spans and number == spans[-1][1] + 1:
            spans[-1][1] = number
        else:
            spans.append([number, number])
    return ",".join(f"{a}-{b}" if b > a else f"{a}" for a, b in spans)


class FarmBackend:
    """Images that a farm rendered, in place of rendering them.

    Args:
        images: holds a folder for each item.
        digests: of the manifest's items by name.
    """

    shading = CYCLES

    def __init__(self, images: Path, digests: Mapping[str, str]) -> None:
        self._images = images
        self._digests = digests

    def pictures(self, plan: RenderPlan, _: Path) -> Pictures:
        """The images of the plan's item.

        Raises:
            RenderError: the item was planned from other files or settings than the plan.
        """
        name = plan.bundle.asset_id
        item, _files = portable(plan)
        if item.digest != self._digests.get(name):
            raise RenderError(
                f"{name}: its bundle, or this program, changed since `artgen farm plan`; plan and "
                "render it again"
            )
        folder = self._images / name
        done = json.loads((folder / DONE).read_text(encoding="utf-8"))
        return Pictures(
            images=ExrImages(plan, folder),
            cpu=done["cpu"],
            effects=plan.job.transport.described(),
        )


def farm_backend(images: Path, digests: Mapping[str, str], _log: Path, _threads: int) -> Backend:
    """The backend of a process that collects; `functools.partial` binds the first two."""
    return FarmBackend(images, digests)
