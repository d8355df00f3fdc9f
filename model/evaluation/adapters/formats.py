"""Which format a folder holds, and its objects by name."""

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import ModelError, did_you_mean
from artgen.export.layout import MANIFEST
from model.evaluation.adapters.bundle import layout_of_bundle
from model.evaluation.adapters.mesh_joints import (
    layout_of_artgs,
    layout_of_dta,
    layout_of_paris,
    layout_of_two_states,
)
from model.evaluation.adapters.singapo_json import layout_of_singapo
from model.evaluation.adapters.urdf import layout_of_urdf, layout_of_urdformer
from model.evaluation.layout import Layout

Reader = Callable[[Path], Layout]
FOREIGN = (
    LookupError,
    ValueError,
    TypeError,
    AttributeError,
    ArithmeticError,
    OSError,
    StopIteration,
    RecursionError,
    SyntaxError,
    MemoryError,
)
"""What reading a stranger's file raises where it lacks something, or holds something else."""


@dataclass(frozen=True)
class Format:
    """How one system's output is found and read.

    Attributes:
        marks: patterns of the file that tells an object of this format.
        read: from that file, or from its folder where `whole` is set.
        whole: whether the folder is read.
        told: what it is, for help and messages.
    """

    marks: tuple[str, ...]
    read: Reader
    whole: bool
    told: str


FORMATS: Mapping[str, Format] = {
    "bundle": Format((MANIFEST,), layout_of_bundle, True, "artgen bundles"),
    "singapo": Format(("object.json",), layout_of_singapo, False, "SINGAPO's or CAGE's trees"),
    "dta": Format(
        ("init_motion.json", "init_p*_motion.json"), layout_of_dta, True, "Digital Twin Art"
    ),
    "paris": Format(("*_motion.json",), layout_of_paris, True, "PARIS"),
    "artgs": Format(
        ("pred_joint_list.json", "joints.json", "trans_pred.json"), layout_of_artgs, True, "ArtGS"
    ),
    "two_states": Format(("trans.json",), layout_of_two_states, True, "ground truth of PARIS"),
    "urdf": Format(("*.urdf",), layout_of_urdf, False, "any URDF, z up, front -y"),
    "urdformer": Format(("*.urdf",), layout_of_urdformer, False, "URDFormer's URDF, front +x"),
}
"""In the order in which a folder is tried; `urdformer` must be asked for, as it is a URDF."""


@dataclass(frozen=True)
class Place:
    """One object of a folder: its name there, its format, and what its reader takes."""

    name: str
    format: str
    path: Path

    def read(self) -> Layout:
        """Its layout.

        Raises:
            ArtgenError: whatever is wrong with its files.
        """
        try:
            return FORMATS[self.format].read(self.path)
        except FOREIGN as error:
            raise ModelError(
                f"{self.path} cannot be read as {self.format} ({error!r}); expected "
                f"{FORMATS[self.format].told}, see docs/evaluation.md"
            ) from error


def places(folder: Path, format_: str = "auto") -> dict[str, Place]:
    """Every object at or below a folder, by name.

    An object is named as the folder that holds it, or as its file where that folder holds several;
    of folders of one name, as their paths.

    Raises:
        ModelError: the folder or the format does not exist, or it holds no object of it.
    """
    if not folder.is_dir():
        raise ModelError(f"{folder} is no folder; name one that holds an object in each folder")
    if format_ != "auto" and format_ not in FORMATS:
        known = ", ".join(FORMATS)
        hint = did_you_mean(format_, tuple(FORMATS))
        raise ModelError(f"format {format_!r} is not known{hint}; known: {known}")
    tried = [key for key in FORMATS if key != "urdformer"] if format_ == "auto" else [format_]
    for key in tried:
        if found := list(_found(folder, key)):
            return _named(folder, found)
    raise ModelError(
        f"{folder} holds no {' or '.join(tried)}; look at its files, or name another --format"
    )


def _found(folder: Path, key: str) -> Iterator[Place]:
    form = FORMATS[key]
    seen: set[Path] = set()
    for mark in form.marks:
        for file in sorted(folder.rglob(mark)):
            place = file.parent if form.whole else file
            if place not in seen:
                seen.add(place)
                yield Place(_name(folder, file, form), key, place)


def _name(folder: Path, file: Path, form: Format) -> str:
    """A bundle's asset id; else its folder's name, or the file's own where a folder holds several
    or is the one that was named."""
    if file.name == MANIFEST:
        return _asset_id(file)
    alone = sum(1 for mark in form.marks for _ in file.parent.glob(mark)) == 1
    if form.whole or (alone and file.parent != folder):
        return file.parent.name
    return file.stem


def _asset_id(manifest: Path) -> str:
    """The id that a manifest states; of a damaged one, whose reader tells, that of its folder as
    `artgen generate` names them: `laptop/000000` holds laptop_000000."""
    try:
        return str(json.loads(manifest.read_text(encoding="utf-8"))["asset_id"])
    except FOREIGN:
        own = manifest.parent
        return f"{own.parent.name}_{own.name}" if own.name.isdigit() else own.name


def _named(folder: Path, found: list[Place]) -> dict[str, Place]:
    names = [place.name for place in found]
    if len(set(names)) == len(names):
        return dict(zip(names, found, strict=True))
    return {str(place.path.relative_to(folder)): place for place in found}
