"""`python -m tests.bench.shards RUN`: reading and sizes of a run's samples, into docs/shards.csv.

All in one process, page cache hot, CPU seconds, so that a busy machine does not show. The 144 views
are the run's own views repeated under other names: bytes are real, their number is what is asked.
"""

import argparse
import csv
import io
import tempfile
import time
from collections import defaultdict
from collections.abc import Callable, Iterable
from pathlib import Path
from statistics import mean

import numpy as np
import webdataset

from artgen.dataset import codec
from artgen.dataset.members import EncodedSample
from artgen.dataset.reader import OpenShard, ShardDataset, open_shard
from artgen.dataset.sample import Sample
from artgen.dataset.sampler import ResumableSampler
from artgen.dataset.shard import write_shard

STATES, VIEWS = 12, 12
PICKED = 8
COPIES = 10
DOCS = Path("docs")
DECODERS: dict[str, Callable[[bytes], object]] = {
    "rgba.webp": codec.read_rgba,
    "part.png": codec.read_gray8,
    "depth.png": codec.read_gray16,
    "normal.webp": codec.read_rgb,
    "parts.rgba.webp": codec.read_rgba,
    "parts.depth.png": codec.read_gray16,
    "parts.normal.webp": codec.read_rgb,
    "linear.exr": codec.read_linear,
    "flow.exr": codec.read_flow,
}


def cpu_ms(act: Callable[[], object], repeats: int = 5) -> float:
    """Least CPU time of several runs, ms."""
    times = []
    for _ in range(repeats):
        started = time.process_time()
        act()
        times.append(1e3 * (time.process_time() - started))
    return min(times)


def of_kind(shards: Iterable[OpenShard]) -> dict[str, list[bytes]]:
    """Members of all samples by kind."""
    found = defaultdict(list)
    for shard in shards:
        for asset_id in shard.manifest.ids:
            for name, data in shard.members(asset_id).items():
                found[name.split(".", 1)[1] if name[0] == "s" else name].append(data)
    return found


def candidates(sample: Sample) -> dict[str, tuple[Callable[[], bytes], Callable[[bytes], object]]]:
    """What else the composite's depth and color could be stored as: encoder, decoder."""
    depth, color = sample.depth[0, 0], sample.rgba[0, 0]
    linear = (color / 255.0).astype(np.float16)  # the size of noise-free color is a lower bound
    return {
        "depth as half EXR": (
            lambda: codec.exr(depth[..., None].astype(np.float16), ["Z"]),
            lambda data: codec.read_exr(data, ["Z"]),
        ),
        "depth as float EXR": (
            lambda: codec.exr(depth[..., None], ["Z"]),
            lambda data: codec.read_exr(data, ["Z"]),
        ),
        "color as PNG": (lambda: png(color), codec.read_rgba),
        "color as half EXR": (lambda: codec.linear_exr(linear), codec.read_linear),
    }


def png(image: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    codec.Image.fromarray(image).save(buffer, "PNG", compress_level=6)
    return buffer.getvalue()


def many_views(shards: list[OpenShard], path: Path) -> int:
    """A shard of COPIES samples with 144 views each; bytes of their members."""
    shard = shards[0]
    members = shard.members(shard.manifest.ids[0])
    first = [(name, data) for name, data in members.items() if name[0] != "s"]
    views = [
        [(n.split(".", 1)[1], d) for n, d in members.items() if n.startswith(f"{prefix}.")]
        for prefix in dict.fromkeys(n.split(".")[0] for n in members if n[0] == "s")
    ]
    images = [
        (f"s{t}v{v:02d}.{name}", data)
        for t in range(STATES)
        for v in range(VIEWS)
        for name, data in views[(t * VIEWS + v) % len(views)]
    ]
    samples = (
        EncodedSample(asset_id=f"laptop_{k:06d}", members=(*first, *images)) for k in range(COPIES)
    )
    write_shard(path, samples)
    return sum(len(data) for _, data in [*first, *images])


def reading_rows(shards: list[OpenShard], folder: Path) -> list[tuple[str, float]]:
    """Samples a CPU second: 8 random views of 144 by index, and the same views by webdataset."""
    tar = folder / "train-000000.tar"
    size = many_views(shards, tar)
    dataset, rng = ShardDataset(folder), np.random.default_rng(0)
    order = list(ResumableSampler(len(dataset), seed=0))
    picks = [
        (k, [int(rng.integers(STATES))], sorted(rng.permutation(VIEWS)[:PICKED].tolist()))
        for k in order
    ]

    def by_index() -> None:
        for k, states, views in picks:
            shard, asset_id = dataset.shard(k)
            shard.members(asset_id, states=states, views=views)

    def by_webdataset() -> None:
        for item in webdataset.WebDataset(str(tar), shardshuffle=False):
            [item[f"s0v{v:02d}.rgba.webp"] for v in range(PICKED)]

    by_index()
    index, foreign = cpu_ms(by_index), cpu_ms(by_webdataset, 3)
    shard, asset_id = dataset.shard(0)
    read = len(shard.index.chosen(asset_id, states=[0], views=range(PICKED)))
    return [
        ("sample of 144 views, MB", size / 1e6),
        ("8 of 144 views by index, samples a CPU s", 1e3 * COPIES / index),
        ("webdataset, whole samples in order, samples a CPU s", 1e3 * COPIES / foreign),
        ("ratio", foreign / index),
        ("members a CPU s by index", 1e3 * COPIES * read / index),
        ("tar over its members, %", 100 * (tar.stat().st_size / (COPIES * size) - 1)),
    ]


def codec_rows(shards: list[OpenShard]) -> list[tuple[str, float, float, float]]:
    """Kind, members, mean KiB, CPU ms to decode one."""
    rows = []
    for kind, found in of_kind(shards).items():
        decode = DECODERS.get(kind)
        cost = cpu_ms(lambda d=decode, f=found: [d(x) for x in f]) / len(found) if decode else 0.0
        rows.append((kind, len(found), mean(map(len, found)) / 1024, cost))
    samples = [shard.read(asset_id) for shard in shards for asset_id in shard.manifest.ids]
    for name in candidates(samples[0]):
        encoded = [candidates(sample)[name][0]() for sample in samples]
        decode = candidates(samples[0])[name][1]
        cost = cpu_ms(lambda d=decode, e=encoded: [d(x) for x in e]) / len(encoded)
        rows.append((name, len(encoded), mean(map(len, encoded)) / 1024, cost))
    return rows


def main() -> None:
    """Measure and rewrite docs/shards.csv."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=Path, help="folder of `artgen generate`, packed")
    run = parser.parse_args().run
    shards = [open_shard(path) for path in sorted((run / "shards").glob("*.tar"))]
    with tempfile.TemporaryDirectory() as scratch:
        reading = reading_rows(shards, Path(scratch))
    with (DOCS / "shards.csv").open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(("what", "members", "KiB or figure", "decode, CPU ms"))
        for kind, count, kib, cost in codec_rows(shards):
            table.writerow((kind, count, round(kib, 2), round(cost, 2)))
        for what, figure in reading:
            table.writerow((what, "", round(figure, 2), ""))
    print((DOCS / "shards.csv").read_text())  # noqa: T201


if __name__ == "__main__":
    main()
