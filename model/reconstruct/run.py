"""From a capture and a checkpoint to a folder: bundle, films, pictures, the prediction as JSON."""

import re
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from artgen.articulation.types import ArticulatedObject, State
from artgen.core.errors import UsageError
from artgen.core.jsonio import file_hash, fill_folder_atomically, write_bytes, write_json
from artgen.core.mesh import Floats
from artgen.export import write_bundle
from artgen.textures.library import TextureLibrary
from artgen.validate import Report, validate_bundle
from artgen.worker import BlenderWorker
from model.config import Config
from model.reconstruct import films
from model.reconstruct.agreement import agreeing
from model.reconstruct.assemble import Assembled, Wishes, assemble
from model.reconstruct.cameras import Rig
from model.reconstruct.capture import Capture, read_capture
from model.reconstruct.choice import chosen_views
from model.reconstruct.draw import Painter
from model.reconstruct.front import faced, told_front
from model.reconstruct.hull import VisualHull, check_cameras
from model.reconstruct.masks import found_segmenter
from model.reconstruct.photo import Photo, PhotoColors
from model.reconstruct.record import record
from model.reconstruct.refine import refined
from model.reconstruct.rig import read_rig
from model.reconstruct.search import Finding, question, searched, told_of
from model.reconstruct.sight import Sphere, in_object, network_images, sphere_of
from model.reconstruct.skin import PaintOver
from model.reconstruct.surfaces import field_guess
from model.training.art_file import load_art
from model.training.distributed import device_named

BUNDLE = "bundle"
TURNTABLE = "turntable.gif"
ARTICULATION = "articulation.gif"
REPROJECTION = "reprojection.png"
PREDICTION = "prediction.json"


@dataclass(frozen=True, kw_only=True)
class Order:
    """What is to be reconstructed.

    Attributes:
        images: folder that image names in the camera file are relative to.
        cameras: camera file, or COLMAP's folder.
        parts: how many, base included; None asks the network.
        out: folder that receives the results; it must not exist.
        masks: folder of mask files; None where alpha, or the camera file, tells the foreground.
        segmenter: name of an installed one; empty for none.
        resolution: of the grid that each part is extracted on.
        photos: whether the colors come from the images where they show them, else from the field.
        films: whether GIFs and the reprojection are made.
        refine: whether states are fitted to the silhouettes.
        device: where the network predicts and its fields are meshed: cpu, cuda or auto.
    """

    images: Path
    cameras: Path
    checkpoint: Path
    parts: int | None
    out: Path
    masks: Path | None
    segmenter: str
    resolution: int
    wishes: Wishes
    photos: bool = True
    films: bool = True
    refine: bool = True
    device: str = "cpu"


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What came of it.

    Attributes:
        told: what a user should know of the input.
        seconds: by stage.
        ious: of input and reprojected silhouettes.
    """

    report: Report
    assembled: Assembled
    told: tuple[str, ...]
    seconds: Mapping[str, float]
    ious: tuple[float, ...]


class Stopwatch:
    """Seconds by stage; `advance` hears of each."""

    def __init__(self, advance: Callable[[str], None]) -> None:
        self.seconds: dict[str, float] = {}
        self._advance = advance
        self._last = time.perf_counter()

    def lap(self, stage: str) -> None:
        """Book the time since the last lap on `stage`."""
        now = time.perf_counter()
        self.seconds[stage] = now - self._last
        self._last = now
        self._advance(stage)


STAGES = (
    "checkpoint",
    "images",
    "network",
    "surfaces",
    "assembly",
    "export",
    "films",
    "validation",
)


def asset_name(images: Path) -> str:
    """A name for the asset's files, from the folder of the images."""
    word = re.sub(r"[^a-z0-9]+", "_", images.resolve().name.lower()).strip("_")
    return f"reconstruction_{word}" if word else "reconstruction"


@dataclass(frozen=True, kw_only=True)
class Made:
    """An object and what it was made of.

    Attributes:
        told: what a user should know of the input, a sentence each.
    """

    capture: Capture
    finding: Finding
    told: tuple[str, ...]
    config: Config
    assembled: Assembled


def reconstruct(order: Order, advance: Callable[[str], None]) -> Outcome:
    """Fill `order.out`.

    Raises:
        UsageError: the folder exists. ModelError: the checkpoint, the cameras or the images cannot
            be used. GeometryError: no object can be made of the prediction.
    """
    if order.out.exists() and any(order.out.iterdir()):
        raise UsageError(
            f"{order.out}: exists, and nothing is overwritten; choose another --out or remove it"
        )
    watch = Stopwatch(advance)
    made = made_object(order, watch)
    report: list[Report] = []
    ious: list[float] = []

    def fill(folder: Path) -> None:
        painter = Painter(made.assembled.object, made.assembled.color)
        thumbnail = films.thumbnail(made.assembled.object, painter)
        with ThreadPoolExecutor(max_workers=1) as aside:  # Blender, too, works beside us.
            filmed = aside.submit(write_films, folder, made, painter, films_too=order.films)
            export(folder / BUNDLE, made.assembled, thumbnail)
            watch.lap("export")
            seen = filmed.result()
        ious.extend(own.iou for own in seen)
        told = record(
            made.finding,
            made.assembled,
            seen,
            states=made.capture.states,
            checkpoint=told_checkpoint(order.checkpoint, made.config),
        )
        write_json(folder / PREDICTION, told)
        watch.lap("films")
        report.append(validate_bundle(folder / BUNDLE))
        write_json(folder / BUNDLE / "report.json", report[0].as_json())
        watch.lap("validation")

    fill_folder_atomically(order.out, fill)
    return Outcome(
        report=report[0],
        assembled=made.assembled,
        told=made.told,
        seconds=watch.seconds,
        ious=tuple(ious),
    )


def made_object(order: Order, watch: Stopwatch) -> Made:
    """What the network predicts of the images, as an object; nothing is written."""
    art, config, _ = load_art(order.checkpoint)
    art = art.to(device_named(order.device))
    watch.lap("checkpoint")
    rig = read_rig(order.cameras, order.images)
    capture, first = seen_object(order, rig)
    asked, facing = question(art, config, capture, first, parts=order.parts), list[str]()
    watch.lap("images")
    if not rig.front_stated:
        asked, front = faced(asked)
        facing.append(told_front(front))
    capture = asked.capture
    choice = chosen_views(capture, asked.about, config.data)
    finding = searched(asked, choice)
    prediction, sphere, seen = finding.prediction, finding.sphere, finding.seen
    watch.lap("network")
    field = None if prediction.planes_BP6CHW is None else prediction.field()
    guess = field_guess(
        field,
        prediction.articulation,
        0,
        resolution=order.resolution,
        radius=sphere.radius_m,
    )
    if field is not None:
        guess = agreeing(guess, seen)
    if order.refine:
        guess = refined(guess, seen)
    watch.lap("surfaces")
    provenance = {"source": "reconstruction", "checkpoint": file_hash(order.checkpoint)}

    def overlay(obj: ArticulatedObject, shift: Floats, states: Sequence[State]) -> PaintOver:
        return PhotoColors(obj, photos(capture, sphere, shift, states))

    assembled = assemble(
        guess, order.wishes, provenance=provenance, overlay=overlay if order.photos else None
    )
    watch.lap("assembly")
    return Made(
        capture=capture,
        finding=finding,
        told=(*facing, *choice.told, *told_of(finding, asked)),
        config=config,
        assembled=assembled,
    )


def seen_object(order: Order, rig: Rig) -> tuple[Capture, Sphere]:
    """The images and where the object is, after a look whether cameras and masks agree."""
    segmenter = found_segmenter(order.segmenter) if order.segmenter else None
    capture = read_capture(order.images, rig, masks=order.masks, segmenter=segmenter)
    hull: VisualHull = check_cameras(capture)
    return capture, sphere_of(rig, hull)


def photos(capture: Capture, sphere: Sphere, shift: Floats, states: Sequence[State]) -> list[Photo]:
    """Every input image with the state that the network saw in it.

    Args:
        shift: (3,) m, from the sphere's middle to the object frame.
        states: q of every joint in each state of the images.
    """
    count, views = capture.rgba.shape[:2]
    return [
        Photo(
            rgba=capture.rgba[t, v],
            intrinsics=capture.intrinsics[t, v],
            camera_from_object=in_object(capture.camera_from_world[t, v], sphere, shift),
            state=states[t] if t < len(states) else {},
        )
        for t in range(count)
        for v in range(views)
    ]


def told_checkpoint(path: Path, config: Config) -> dict[str, str]:
    """Which network it was."""
    return {"sha256": file_hash(path), "recipe": config.recipe, "size": config.size}


def reprojections(
    capture: Capture, sphere: Sphere, assembled: Assembled, *, size: int
) -> list[films.Reprojection]:
    """Every input image beside the object in the predicted state, without a lamp of ours."""
    painter = Painter(assembled.object, assembled.color, dim=1.0)
    images = network_images(capture, sphere, size=size, background="white")
    rgb = images.rgb_BTV3HW[0].permute(0, 1, 3, 4, 2).numpy()
    alpha = images.alpha_BTVHW[0, ..., None].numpy()
    found = []
    for t in range(rgb.shape[0]):
        state = assembled.states[t] if t < len(assembled.states) else {}
        for v in range(rgb.shape[1]):
            pose = in_object(capture.camera_from_world[t, v], sphere, assembled.shift)
            matrix = images.intrinsics_BTV33[0, t, v].double().numpy()
            found.append(
                films.Reprojection(
                    state=capture.states[t],
                    view=v,
                    seen=films.straight(rgb[t, v], alpha[t, v]),
                    shown=painter.paint(state, matrix, pose, (size, size)),
                )
            )
    return found


def write_films(
    folder: Path, made: Made, painter: Painter, *, films_too: bool
) -> list[films.Reprojection]:
    """Turntable, articulation, and inputs beside reprojections, which are returned."""
    seen = reprojections(made.capture, made.finding.sphere, made.assembled, size=films.SIDE)
    if films_too:
        obj = made.assembled.object
        write_bytes(folder / TURNTABLE, films.turntable(obj, painter))
        write_bytes(folder / ARTICULATION, films.articulation(obj, painter))
        write_bytes(folder / REPROJECTION, films.side_by_side(seen))
    return seen


def export(folder: Path, assembled: Assembled, thumbnail: bytes) -> None:
    """The bundle, by the same exporters as every asset; its picture is ours."""
    folder.mkdir()
    with tempfile.TemporaryDirectory() as scratch:
        library = TextureLibrary(Path(scratch) / "textures")
        library.keep(assembled.object.surfaces[0], assembled.images)
        with BlenderWorker(Path(scratch) / "blender.log") as worker:
            write_bundle(
                assembled.object,
                folder,
                library=library,
                worker=worker,
                thumbnail=thumbnail,
            )
