"""What a network predicted, put together as `artgen reconstruct` does, and driven in MuJoCo."""

import tempfile
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from artgen.articulation.types import Precondition
from artgen.core.errors import ArtgenError
from artgen.export import layout
from artgen.export.files import write_meshes
from artgen.export.urdf import urdf_text
from artgen.validate.bounds import shipped_bounds
from artgen.validate.subject import Source
from artgen.validate.urdf_subject import UrdfSubject
from model.evaluation.gates import Gates, subject_gates
from model.network.prediction import Prediction
from model.reconstruct.assemble import Wishes, assemble
from model.reconstruct.surfaces import field_guess


def prediction_gates(prediction: Prediction, *, radius: float, resolution: int) -> Gates:
    """The gates of object 0 of a prediction; what cannot be put together does not load.

    Args:
        radius: m in one radius.
        resolution: of marching cubes; 0 stands boxes for parts, as for a network without planes.
    """
    try:
        field = None if prediction.planes_BP6CHW is None else prediction.field()
        guess = field_guess(field, prediction.articulation, 0, resolution=resolution, radius=radius)
        made = assemble(guess, Wishes()).object
    except ArtgenError as error:
        return Gates(
            loads=False, stable=None, settles=None, opens=None, clear=None,
            reasons={"loads": f"it cannot be put together: {error}"},
        )  # fmt: skip
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        write_meshes(made, folder)
        file = folder / layout.URDF
        file.write_text(urdf_text(made), encoding="utf-8")
        source = Source(format="urdf", file=file, root=folder)
        return subject_gates(
            AssembledSubject(source=source, bounds=shipped_bounds(), waits=made.preconditions)
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class AssembledSubject(UrdfSubject):
    """A URDF, and which of its joints wait for others, which a URDF cannot say."""

    waits: tuple[Precondition, ...]

    @property
    def preconditions(self) -> tuple[Precondition, ...]:
        """As the object states them."""
        return self.waits

    @cached_property
    def passages(self) -> tuple[Precondition, ...]:
        """The same."""
        return self.waits
