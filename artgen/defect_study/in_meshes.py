"""Defects of the mesh files that a URDF names."""

from collections.abc import Callable
from pathlib import Path

from artgen.defect_study.defect import Defect, Plant

Lines = list[str]


def in_mesh(change: Callable[[Lines], Lines]) -> Plant:
    """A plant that edits the lines of the last part's OBJ."""

    def plant(folder: Path) -> None:
        path = moving_mesh(folder)
        path.write_text("\n".join(change(path.read_text(encoding="utf-8").splitlines())) + "\n")

    return plant


def moving_mesh(folder: Path) -> Path:
    """The visible mesh of a part that moves."""
    moving = [path for path in sorted(folder.glob("meshes/*.obj")) if "_base" not in path.stem]
    if not moving:
        raise LookupError("no mesh of a moving part")
    return moving[0]


def scaled(factors: tuple[float, float, float]) -> Plant:
    """Vertices multiplied, per axis."""

    def change(lines: Lines) -> Lines:
        return [_vertex(line, factors) if line.startswith("v ") else line for line in lines]

    return in_mesh(change)


def faces(change: Callable[[Lines], Lines]) -> Plant:
    """Face lines changed as a list, the rest kept."""

    def edit(lines: Lines) -> Lines:
        listed = [line for line in lines if line.startswith("f ")]
        return [line for line in lines if not line.startswith("f ")] + change(listed)

    return in_mesh(edit)


def turned(line: str) -> str:
    """A face the other way round."""
    head, *corners = line.split()
    return " ".join([head, *reversed(corners)])


def spoilt_vertex(text: str) -> Plant:
    """The first vertex replaced."""

    def change(lines: Lines) -> Lines:
        first = next(k for k, line in enumerate(lines) if line.startswith("v "))
        return [*lines[:first], f"v {text}", *lines[first + 1 :]]

    return in_mesh(change)


def cut_short(folder: Path) -> None:
    """The file ends in the middle."""
    path = moving_mesh(folder)
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])


def emptied(folder: Path) -> None:
    """The file is empty."""
    moving_mesh(folder).write_bytes(b"")


def binary(folder: Path) -> None:
    """The file is another format under this name."""
    moving_mesh(folder).write_bytes(b"glTF\x02\x00\x00\x00" + bytes(64))


def _vertex(line: str, factors: tuple[float, float, float]) -> str:
    values = [float(word) for word in line.split()[1:4]]
    return "v " + " ".join(repr(f * v) for f, v in zip(factors, values, strict=True))


def _half_turned(lines: Lines) -> Lines:
    return [turned(line) if k % 2 else line for k, line in enumerate(lines)]


MESH_DEFECTS = tuple(
    Defect(name=name, format="urdf", what=what, plant=plant)
    for name, what, plant in (
        ("mesh_mm", "vertices in millimeters", scaled((1000.0, 1000.0, 1000.0))),
        ("mesh_wide", "a part 5 % too wide for its opening", scaled((1.05, 1.0, 1.0))),
        ("mesh_mirrored", "mirrored, winding not mended", scaled((-1.0, 1.0, 1.0))),
        ("mesh_flat", "squashed to a plane", scaled((1.0, 0.0, 1.0))),
        ("mesh_inside_out", "all faces inverted", faces(lambda f: [turned(line) for line in f])),
        ("mesh_half_turned", "winding at random", faces(_half_turned)),
        ("mesh_hole", "a face is missing", faces(lambda f: f[1:])),
        ("mesh_doubled", "every face twice", faces(lambda f: f + f)),
        ("mesh_face_doubled", "one face twice", faces(lambda f: [*f, f[0]])),
        ("mesh_no_faces", "vertices without faces", faces(lambda f: [])),
        (
            "mesh_bad_index",
            "a face of vertices that are not there",
            faces(lambda f: [*f, "f 999999 1 2"]),
        ),
        ("mesh_nan", "a vertex that is not a number", spoilt_vertex("nan 0 0")),
        ("mesh_spike", "a vertex far away", spoilt_vertex("100 100 100")),
        ("mesh_truncated", "half the file was written", cut_short),
        ("mesh_empty", "nothing was written", emptied),
        ("mesh_other_format", "a GLB called OBJ", binary),
    )
)
