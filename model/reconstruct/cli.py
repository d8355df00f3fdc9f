"""`artgen reconstruct`: the option list, and the help."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
import tyro
from rich.console import Console

from artgen.articulation.types import ArticulatedObject, Joint
from artgen.core.errors import ModelError, UsageError
from artgen.export.layout import MJCF
from artgen.progress import progress
from artgen.system_libraries import check_libraries
from model.reconstruct import run
from model.reconstruct.assemble import CATEGORY, CLEARANCE, Wishes
from model.reconstruct.physics import DENSITY

RESOLUTION = 64
FEWEST, MOST = 8, 512


@dataclass(frozen=True, kw_only=True)
class Reconstruct:
    """Turn images of an object in two or more states into a bundle: GLB, URDF, MJCF, USD.

    IMAGES is a folder; --cameras says where each of its images was taken from and in which state:
    our own JSON, NeRF's transforms.json, or a folder with COLMAP's text files. The foreground comes
    from the alpha channel, from --masks or from --segmenter. The result passes the validators that
    every asset passes; OUT receives bundle/, turntable.gif, articulation.gif, reprojection.png and
    prediction.json. Exit code 1: the bundle was written, but did not pass.

    For example:

    artgen reconstruct examples/cabinet --parts 4

    artgen reconstruct photos --cameras sparse/0 --masks masks --parts 3

    artgen reconstruct kettle --parts 3 --checkpoint art_nano_all

    Photographs of each state go into state_0/, state_1/ ... before COLMAP sees them, or their names
    begin so. docs/reconstruct.md describes the formats.
    """

    images: Annotated[Path, tyro.conf.arg(metavar="IMAGES"), tyro.conf.Positional]
    """Folder of the images."""
    cameras: Path | None = None
    """Camera file, or COLMAP's folder; cameras.json, transforms.json or images.txt in IMAGES if not
    given."""
    checkpoint: Path | None = None
    """A trained network (art.safetensors), or one of those that ship: art_nano, the default, knows
    ten categories; art_nano_all knows all 27, less exactly."""
    parts: int | None = None
    """How many parts the object has, base included; if not given, the network counts."""
    out: Path | None = None
    """New folder for the results; out/reconstruct/NAME if not given, NAME as of IMAGES."""
    masks: Path | None = None
    """Folder of mask files, named like the images: bright, or opaque, is foreground."""
    segmenter: str = ""
    """An installed segmenter (entry point in artgen.segmenters) for images without alpha."""
    resolution: int = RESOLUTION
    """Grid on which each part's surface is looked for, 8 to 512."""
    colors: Literal["photos", "field"] = "photos"
    """photos: those of the images where they show a point, else the field's; field: its alone."""
    category: str = CATEGORY
    """Category of the bundle; one that `artgen categories` lists is held to its sizes."""
    density: float = DENSITY
    """kg/m3 of all parts; images do not show weight."""
    clearance: float = CLEARANCE
    """m of air between parts at rest."""
    films: bool = True
    """Also make the GIFs and the reprojection."""
    refine: bool = True
    """Fit the states of joints to the silhouettes of all images; else they are as the network
    says."""
    device: Literal["auto", "cpu", "cuda"] = "cpu"
    """Where the network predicts and its fields become surfaces; auto takes a GPU if there is one.
    """


def reconstruct(argv: Sequence[str]) -> int:
    """Images of an object in several states to a simulation-ready bundle."""
    command = tyro.cli(Reconstruct, args=list(argv), prog="artgen reconstruct")
    order = ordered(command)
    check_libraries()
    with progress("stages", len(run.STAGES)) as advance:
        outcome = run.reconstruct(order, advance)
    announce(order, outcome)
    return 0 if outcome.report.ok else 1


def ordered(command: Reconstruct) -> run.Order:
    """The order behind the options.

    Raises:
        UsageError: a number is out of range, or a file is not there.
    """
    if not FEWEST <= command.resolution <= MOST:
        raise UsageError(f"--resolution {command.resolution}: expected {FEWEST} to {MOST}")
    if not (command.density > 0.0 and command.clearance > 0.0):
        raise UsageError(
            f"--density {command.density:g} and --clearance {command.clearance:g} must be more "
            "than 0"
        )
    if not command.images.is_dir():
        raise UsageError(f"{command.images}: is no folder; name the folder of the images")
    name = run.asset_name(command.images)
    return run.Order(
        images=command.images,
        cameras=command.cameras or cameras_beside(command.images),
        checkpoint=checkpoint_of(command.checkpoint),
        parts=command.parts,
        out=command.out or Path("out/reconstruct") / command.images.resolve().name,
        masks=command.masks,
        segmenter=command.segmenter,
        resolution=command.resolution,
        wishes=Wishes(
            asset_id=name,
            category=command.category,
            clearance=command.clearance,
            density=command.density,
        ),
        photos=command.colors == "photos",
        films=command.films,
        refine=command.refine,
        device=command.device,
    )


NAMES = ("cameras.json", "transforms.json", "images.txt")


def cameras_beside(images: Path) -> Path:
    """The camera file in the folder of the images.

    Raises:
        UsageError: there is none.
    """
    for name in NAMES:
        if (images / name).is_file():
            return images / name
    raise UsageError(f"{images}: holds none of {', '.join(NAMES)}; say --cameras FILE")


SHIPPED = "art_nano"


def checkpoint_of(said: Path | None) -> Path:
    """The file of a network: one of ours by its bare name, or what was said.

    Raises:
        ModelError: it is no file and not the name of a network that ships.
    """
    if said is not None and (said.suffix or said.is_file()):
        return said
    return shipped_checkpoint(said)


def shipped_checkpoint(name: Path | str | None = None) -> Path:
    """A network that comes with the package; the one of ten categories if none is named.

    Raises:
        ModelError: this installation has no such network.
    """
    folder = Path(str(files("model"))) / "checkpoints"
    path = folder / f"{name or SHIPPED}.safetensors"
    if not path.is_file():
        known = sorted(file.stem for file in folder.glob("*.safetensors"))
        raise ModelError(
            f"{path}: no such checkpoint ships with this installation, which has "
            f"{', '.join(known) or 'none'}; train one by `artgen train` and say --checkpoint FILE"
        )
    return path


def announce(order: run.Order, outcome: run.Outcome) -> None:
    """What was found, what was made of it, where everything lies, and what took how long."""
    console = Console(highlight=False, soft_wrap=True)
    obj = outcome.assembled.object
    verdict = "valid" if outcome.report.ok else "INVALID"
    mean = sum(outcome.ious) / max(len(outcome.ious), 1)
    console.print(
        f"{obj.asset_id}: {len(obj.parts)} parts, {verdict}; silhouettes agree to {mean:.2f} "
        f"(mean IoU of {len(outcome.ious)} images)"
    )
    for line in (*part_lines(obj), *outcome.told):
        console.print(f"  {line}", markup=False)
    if outcome.assembled.changes:
        console.print("made of the prediction:")
    for change in outcome.assembled.changes:
        console.print(f"  {change}", markup=False)
    for finding in outcome.report.findings:
        console.print(f"  {finding}", markup=False)
    told = ", ".join(f"{stage} {seconds:.1f}" for stage, seconds in outcome.seconds.items())
    console.print(f"seconds: {sum(outcome.seconds.values()):.1f} ({told})")
    console.print("written:")
    for path in sorted(order.out.iterdir()):
        console.print(f"  {path}")
    console.print(f"try it: python -m mujoco.viewer --mjcf={order.out / run.BUNDLE / MJCF}")


def part_lines(obj: ArticulatedObject) -> Iterator[str]:
    """A line a part: how large it is, and how it moves."""
    joints = {joint.child: joint for joint in obj.joints}
    for part in obj.parts:
        size = " x ".join(f"{side:.3g}" for side in np.ptp(part.mesh.bounds, axis=0))
        line = f"{part.name}: {size} m"
        if part.name in joints:
            line += f", {way_of(joints[part.name])} on {joints[part.name].parent}"
        yield line


def way_of(joint: Joint) -> str:
    """`turns by 90 degrees`."""
    if joint.limit is None:
        return "turns all around"
    lower, upper = joint.limit.lower, joint.limit.upper
    unit, scale, verb = (
        ("m", 1.0, "slides") if joint.type == "prismatic" else ("degrees", 180.0 / np.pi, "turns")
    )
    far = f"{scale * upper:.3g} {unit}"
    return f"{verb} by {far}" if lower == 0.0 else f"{verb} by {far} both ways"
