"""`artgen study render-field`; torch-free, so that the list of studies stays light."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import tyro

from artgen.core.stream import Stream

NAME = "render_field"


@dataclass(frozen=True, kw_only=True)
class RenderField:
    """Samples per ray, plane resolution, precision and marching cubes: error against time.

    A hollow cabinet known in closed form is taught to hexa-planes and rendered in many ways. Takes
    some minutes on one CPU core.
    """

    out: Annotated[Path, tyro.conf.Positional] = Path("docs/studies")
    """Folder that receives render_field_*.csv, render_field_*.png and render_field.md."""
    device: Literal["cpu", "cuda"] = "cpu"
    """Where to measure; on `cpu`, times are CPU times of this process."""
    px: int = 24
    """Width and height of the images."""
    steps: int = 250
    """Updates of planes and networks when they are taught the scene."""
    seed: int = 0
    """Root of all chance."""


def study(argv: Sequence[str]) -> int:
    """Rendered fields and extracted meshes: samples, planes, precision, cells."""
    command = tyro.cli(RenderField, args=list(argv), prog="artgen study render-field")
    from model.field_study.run import measured  # Torch takes seconds to import.

    path = measured(
        command.out,
        device=command.device,
        px=command.px,
        steps=command.steps,
        stream=Stream(command.seed, NAME),
    )
    print(f"page: {path}")  # noqa: T201
    return 0
