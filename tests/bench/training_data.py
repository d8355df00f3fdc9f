"""`python -m tests.bench.training_data`: what training items cost, into docs/training_data*.csv,
and a sheet of them, docs/studies/training_items.png.

CPU seconds of one process with one thread, so that a busy machine does not show.
"""

import argparse
import csv
import io
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
import torch
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from PIL import Image

from artgen.core.jsonio import write_bytes
from artgen.core.stream import Stream
from artgen.rules import rule_names
from model.data.cameras import state_cameras
from model.data.config import DataConfig
from model.data.library import Library, packed, write_library
from model.data.loader import batches
from model.data.scene import Scene
from model.data.soup import seed_soup
from model.data.soup_source import SoupSource, shown
from model.data.stage import cast, photographs, staged

CPU = torch.device("cpu")
DOCS = Path("docs")
SIZES = {
    "nano, articulation alone": DataConfig(input_px=48, render_px=60, views=2, rays=0),
    "nano": DataConfig(input_px=48, render_px=60, target_px=48, views=2, rays=256),
    "64 px": DataConfig(input_px=64, render_px=80, target_px=64, rays=512),
    "s": DataConfig(input_px=128, render_px=160, target_px=128, rays=1024),
    "256 px": DataConfig(input_px=256, render_px=320, target_px=256, rays=2048),
}
SHEET = DataConfig(seed=2, batch=12, views=4, input_px=96, render_px=120, rays=0)


def cpu_ms(act: Callable[[], object]) -> float:
    """CPU time of one call, ms."""
    started = time.process_time()
    act()
    return 1e3 * (time.process_time() - started)


def asset_rows(per_category: int, seed: int) -> tuple[list[Library], list[dict[str, object]]]:
    """Libraries a category, and what each costs an object."""
    libraries, rows = [], []
    for category in rule_names():
        seed_soup(category, seed, 0)  # Imports and rules are read once a process.
        started = time.process_time()
        soups = [seed_soup(category, seed, k) for k in range(per_category)]
        seconds = (time.process_time() - started) / per_category
        library = packed(soups)
        path = Path("out/training_data_bench.npz")
        write_library(path, library)
        rows.append(
            {
                "category": category,
                "parts": f"{min(library.part_counts)}-{max(library.part_counts)}",
                "fit_8_slots_pct": round(100.0 * float((library.part_counts <= 8).mean())),
                "triangles": round(len(library.columns["corner"]) / per_category),
                "kB": round(path.stat().st_size / per_category / 1e3, 1),
                "build_ms": round(1e3 * seconds),
            }
        )
        path.unlink()
        libraries.append(library)
    return libraries, rows


def item_rows(source: SoupSource, count: int) -> list[dict[str, object]]:
    """What an item costs at several sizes."""
    rows: list[dict[str, object]] = []
    for name, config in SIZES.items():
        source.batch([source.plan(0, config, Stream(0))], config, CPU)
        plans: list[Scene] = []

        def drawn(config: DataConfig = config, plans: list[Scene] = plans) -> None:
            places = [k * len(source) // count for k in range(count)]
            plans += [source.plan(place, config, Stream(1, place)) for place in places]

        plan_ms = cpu_ms(drawn) / count
        show_ms = cpu_ms(lambda p=plans, c=config: [shown([one], c, CPU) for one in p]) / count
        ours, embrees = casting_ms(plans, config)
        rows.append(
            {
                "size": name,
                "images": f"{config.states} x {config.views} of {config.input_px} px",
                "rays": config.rays,
                "plan_ms": round(plan_ms, 1),
                "show_ms": round(show_ms, 1),
                "items_per_core_s": round(1e3 / (plan_ms + show_ms), 1),
                "cast_inputs_ms": round(ours, 1),
                "embree_inputs_ms": round(embrees, 1),
            }
        )
    return rows


def casting_ms(plans: Sequence[Scene], config: DataConfig) -> tuple[float, float]:
    """First hits of all input pixels, an item: ours, and embree's with its trees."""
    ours = embrees = 0.0
    for plan in plans:
        stage, cameras = staged([plan], CPU), state_cameras([plan.inputs], CPU)
        ours += cpu_ms(lambda s=stage, c=cameras: cast(s, c, size=config.render_px))
        points = stage.points_VT3.numpy()
        rays = _rays(plan, config)
        embrees += cpu_ms(lambda p=points, f=plan.faces, r=rays: _embree(p, f, r))
    return ours / len(plans), embrees / len(plans)


def _rays(plan: Scene, config: DataConfig) -> list[list[tuple[np.ndarray, np.ndarray]]]:
    """Origins and directions of all pixels, state by state and view by view."""
    cameras = state_cameras([plan.inputs], CPU)
    pixel = torch.arange(config.render_px**2)
    rays = []
    for k in range(config.states * config.views):
        first = torch.zeros_like(pixel)
        ray = cameras.sights(first, first + k, pixel, config.render_px)
        origin = cameras.center_BN3[0, k].expand_as(ray)
        rays.append((origin.contiguous().numpy(), ray.contiguous().numpy()))
    return [rays[t * config.views : (t + 1) * config.views] for t in range(config.states)]


def _embree(
    points: np.ndarray, faces: np.ndarray, rays: list[list[tuple[np.ndarray, np.ndarray]]]
) -> None:
    for t, views in enumerate(rays):
        scene = EmbreeScene(robust=True)
        TriangleMesh(scene, np.ascontiguousarray(points[:, t]), np.asarray(faces, np.int32))
        for origin, ray in views:
            scene.run(origin, ray)


def simplification_rows(per_category: int, seed: int) -> list[dict[str, object]]:
    """What the tolerance changes in pictures of 128 px: share of pixels whose coverage differs."""
    config = DataConfig(views=4, states=2, rays=0, render_px=128, background="white")
    rows: list[dict[str, object]] = []
    exact = [
        seed_soup(c, seed, k, tolerance=0.0) for c in rule_names() for k in range(per_category)
    ]
    for tolerance in (0.002, 0.004, 0.008, 0.016):
        coarse = [
            seed_soup(c, seed, k, tolerance=tolerance)
            for c in rule_names()
            for k in range(per_category)
        ]
        off, on, colors, sizes = 0, 0, [], []
        for one, other in zip(exact, coarse, strict=True):
            a, b = (_photo(packed([soup]), config) for soup in (one, other))
            mask_a, mask_b = a[..., 3] > 0, b[..., 3] > 0
            off, on = off + int((mask_a ^ mask_b).sum()), on + int(mask_a.sum())
            both = mask_a & mask_b
            colors.append(np.abs(a[both][:, :3].astype(float) - b[both][:, :3]).mean() / 255.0)
            sizes.append(len(other.faces))
        rows.append(
            {
                "tolerance": tolerance,
                "triangles": round(float(np.mean(sizes))),
                "outline_pct": round(100.0 * off / on, 3),
                "color_pct": round(100.0 * float(np.mean(colors)), 2),
            }
        )
    return rows


def _photo(library: Library, config: DataConfig) -> np.ndarray:
    source = SoupSource(library, slots=32)
    plan = source.plan(0, DataConfig(**{**vars(config), "slots": 32}), Stream(0))
    cameras = state_cameras([plan.inputs], CPU)
    return photographs(staged([plan], CPU), cameras, size=config.render_px).numpy()


def write_sheet(source: SoupSource, path: Path) -> None:
    """Items as the network sees them: a row each, states side by side."""
    rgb = next(batches(source, SHEET)).images.rgb_BTV3HW
    rows = rgb.permute(0, 4, 1, 2, 5, 3).flatten(0, 1).flatten(1, 3)
    half = len(rows) // 2
    sheet = np.concatenate([rows[:half].numpy(), rows[half:].numpy()], axis=1)
    buffer = io.BytesIO()
    Image.fromarray((255.0 * sheet + 0.5).astype(np.uint8)).save(buffer, "PNG", optimize=True)
    write_bytes(path, buffer.getvalue())


def write_rows(path: Path, rows: Iterable[Mapping[str, object]]) -> None:
    """CSV."""
    listed = list(rows)
    text = io.StringIO()
    table = csv.DictWriter(text, list(listed[0]), lineterminator="\n")
    table.writeheader()
    table.writerows(listed)
    write_bytes(path, text.getvalue().encode())


def main() -> None:
    """Measure and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--per-category", type=int, default=4)
    parser.add_argument("--items", type=int, default=24)
    parser.add_argument("--seed", type=int, default=31)
    options = parser.parse_args()
    torch.set_num_threads(1)
    libraries, assets = asset_rows(options.per_category, options.seed)
    write_rows(DOCS / "training_data_assets.csv", assets)
    every = packed([soup for library in libraries for soup in library])
    source = SoupSource(every)
    write_sheet(source, DOCS / "studies" / "training_items.png")
    write_rows(DOCS / "training_data.csv", item_rows(source, options.items))
    write_rows(DOCS / "training_data_tolerance.csv", simplification_rows(1, options.seed))


if __name__ == "__main__":
    main()
