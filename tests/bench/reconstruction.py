"""`python -m tests.bench.reconstruction LIBRARY`: which share of reconstructions works in MuJoCo,
and how long they take, into docs/reconstruction.csv.

Predictions of known quality: held-out objects of the library (`artgen train-data`), every number
of their layout and their shapes disturbed by noise; and what networks say, untrained or trained,
whose images of those objects they see. CPU seconds of one process with one thread.
"""

import argparse
import csv
import dataclasses
import io
import statistics
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch

from artgen.core.errors import ArtgenError
from artgen.core.jsonio import write_bytes
from artgen.core.stream import Stream
from artgen.export import write_bundle
from artgen.progress import progress
from artgen.textures.library import TextureLibrary
from artgen.validate import validate_bundle
from artgen.validate.subject import Source
from artgen.worker import BlenderWorker
from model.batch import Articulation
from model.config import Config
from model.data.config import DataConfig
from model.data.library import packed, read_library
from model.data.soup_source import SoupSource
from model.evaluation.gates import Gates, gates
from model.evaluation.held_out import HeldOut, held_out
from model.field.plane_field import Field
from model.infer import predict
from model.network.art import Art
from model.reconstruct.assemble import Assembled, Wishes, assemble
from model.reconstruct.surfaces import field_guess
from model.training.art_file import load_art
from model.training.recipes import RECIPES
from tests.bench.known_fields import disturbed, known_field

NOISES = (0.0, 0.01, 0.03, 0.1, 0.3)
RESOLUTION = 64
SLOTS = 8
TINY = DataConfig(views=1, input_px=16, render_px=20, target_px=16)
PICTURE = b"none"


@dataclass(frozen=True, kw_only=True)
class Row:
    """One reconstruction.

    Attributes:
        source: `noise 0.03`, `untrained 0`, or a checkpoint's name.
        valid: whether the bundle passed all validators; the gates are those of MuJoCo.
        joints: that are left, of `parts` - 1.
        seconds: CPU, from the field to the validated bundle, films left out.
        why: what was found first.
    """

    source: str
    asset: str
    parts: int
    joints: int
    loads: bool
    stable: bool
    opens: bool
    clear: bool
    valid: bool
    seconds: float
    why: str

    @property
    def passed(self) -> bool:
        """All four gates."""
        return self.loads and self.stable and self.opens and self.clear


@dataclass(frozen=True, kw_only=True)
class Case:
    """A prediction to be put together."""

    source: str
    asset: str
    field: Field
    articulation: Articulation
    radius: float


def few(library: Path, count: int) -> SoupSource:
    """Some held-out objects, evenly spread over a library."""
    source = SoupSource(read_library(library), split="test", slots=SLOTS)
    places = np.linspace(0, len(source) - 1, count).astype(int)
    chosen = [source.library[source.positions[place]] for place in places]
    return SoupSource(packed(chosen), split=None, slots=SLOTS)


def cases(
    source: SoupSource, noises: Sequence[float], seeds: int, checkpoints: Sequence[Path]
) -> Iterator[Case]:
    """All predictions, noise by noise, then network by network."""
    for noise in noises:
        for item in held_out(source, TINY, count=len(source)):
            yield known_case(item, noise)
    networks: list[tuple[str, Art, Config]] = []
    for seed in range(seeds):
        torch.manual_seed(seed)
        config = RECIPES["multiview"]("nano")
        networks.append((f"untrained {seed}", Art(config.model).eval(), config))
    for path in checkpoints:
        art, config, _ = load_art(path)
        networks.append((path.stem, art, config))
    for name, art, config in networks:
        for item in held_out(source, config.data, count=len(source)):
            yield network_case(item, name, art, config)


def known_case(item: HeldOut, noise: float) -> Case:
    """The truth, disturbed."""
    stream = Stream(0, "bench", item.name, f"{noise:g}")
    truth = item.shown.truth
    listed = [mesh for mesh in item.layout.meshes if mesh is not None]
    return Case(
        source=f"noise {noise:g}",
        asset=item.name,
        field=known_field(listed, truth, noise=noise / 2.0, stream=stream.child("field")),
        articulation=disturbed(truth, noise=noise, stream=stream.child("layout")),
        radius=float(item.shown.radius_B[0]),
    )


def network_case(item: HeldOut, name: str, art: Art, config: Config) -> Case:
    """What a network says, that is told how many parts there are."""
    parts = int(item.shown.truth.valid_BP.sum())
    said = predict(art, config, item.shown.images, parts=parts)
    return Case(
        source=name,
        asset=item.name,
        field=said.field(),
        articulation=said.articulation,
        radius=float(item.shown.radius_B[0]),
    )


def judged(case: Case, worker: BlenderWorker, scratch: Path) -> Row:
    """From the field to the validated bundle."""
    parts = int(case.articulation.valid_BP.sum())
    started = time.process_time()
    try:
        done = put_together(case)
        bundle = scratch / "bundle"
        bundle.mkdir()
        library = TextureLibrary(scratch / "textures")
        library.keep(done.object.surfaces[0], done.images)
        write_bundle(done.object, bundle, library=library, worker=worker, thumbnail=PICTURE)
        report = validate_bundle(bundle)
    except ArtgenError as error:
        seconds = time.process_time() - started
        return row_of(case, parts, 0, failed(str(error)), False, seconds, str(error))
    seconds = time.process_time() - started
    found = gates(Source(format="bundle", file=bundle / "manifest.json", root=bundle))
    why = "; ".join(map(str, [*found.reasons.values(), *report.findings]))
    return row_of(case, parts, len(done.object.joints), found, report.ok, seconds, why)


def put_together(case: Case) -> Assembled:
    """As `artgen reconstruct` does, without photographs."""
    guess = field_guess(case.field, case.articulation, 0, resolution=RESOLUTION, radius=case.radius)
    return assemble(guess, Wishes())


def failed(reason: str) -> Gates:
    """No gate was reached."""
    return Gates(
        loads=False, stable=None, settles=None, opens=None, clear=None, reasons={"loads": reason}
    )


def row_of(
    case: Case, parts: int, joints: int, found: Gates, valid: bool, seconds: float, why: str
) -> Row:
    """A line of the table."""
    return Row(
        source=case.source,
        asset=case.asset,
        parts=parts,
        joints=joints,
        loads=found.loads,
        stable=bool(found.stable),
        opens=found.opens is not False and found.loads,
        clear=bool(found.clear),
        valid=valid,
        seconds=round(seconds, 2),
        why=why,
    )


def table(rows: Sequence[Row]) -> str:
    """A line a source: shares in percent, joints kept, seconds."""
    lines = [
        "| prediction | objects | loads | stable | opens | clear | all four | valid bundle | "
        "joints kept | median s | longest s |",
        "|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for source in dict.fromkeys(row.source for row in rows):
        own = [row for row in rows if row.source == source]
        shares = [
            sum(getattr(row, name) for row in own) / len(own)
            for name in ("loads", "stable", "opens", "clear", "passed", "valid")
        ]
        joints = sum(row.joints for row in own) / max(sum(row.parts - 1 for row in own), 1)
        seconds = [row.seconds for row in own]
        told = " | ".join(f"{100.0 * share:.0f} %" for share in (*shares, joints))
        lines.append(
            f"| {source} | {len(own)} | {told} | {statistics.median(seconds):.1f} "
            f"| {max(seconds):.1f} |"
        )
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measure, write, print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("library", type=Path)
    parser.add_argument("--count", type=int, default=20, help="objects a source")
    parser.add_argument("--noises", type=float, nargs="*", default=NOISES)
    parser.add_argument("--seeds", type=int, default=3, help="untrained networks")
    parser.add_argument("--checkpoints", type=Path, nargs="*", default=())
    parser.add_argument("--out", type=Path, default=Path("docs/reconstruction.csv"))
    asked = parser.parse_args()
    torch.set_num_threads(1)
    source = few(asked.library, asked.count)
    total = len(source) * (len(asked.noises) + asked.seeds + len(asked.checkpoints))
    rows: list[Row] = []
    with (
        tempfile.TemporaryDirectory() as folder,
        BlenderWorker(Path(folder) / "blender.log") as worker,
        progress("reconstructions", total) as advance,
    ):
        listed = cases(source, asked.noises, asked.seeds, asked.checkpoints)
        for k, case in enumerate(listed):
            scratch = Path(folder) / str(k)
            scratch.mkdir()
            rows.append(judged(case, worker, scratch))
            keep(asked.out, rows)
            advance(f"{case.source} {case.asset}")
    print(table(rows))  # noqa: T201


def keep(path: Path, rows: Sequence[Row]) -> None:
    """A line a reconstruction."""
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(dataclasses.asdict(rows[0])), lineterminator="\n")
    writer.writeheader()
    writer.writerows(dataclasses.asdict(row) for row in rows)
    write_bytes(path, text.getvalue().encode())


if __name__ == "__main__":
    main()
