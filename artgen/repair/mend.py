"""All mendings of one asset, in the order in which they rely on each other."""

from pathlib import Path

from artgen.core.errors import ArtgenError, UsageError
from artgen.repair.change import Left, Outcome
from artgen.repair.collision import PIECES, mended_collision
from artgen.repair.draft import Draft, copied
from artgen.repair.joints import limited_joints, mended_joints
from artgen.repair.masses import fitting_masses, rigid_masses
from artgen.repair.meshes import mended_meshes
from artgen.validate.structure import limits, tree
from artgen.validate.urdf_subject import UrdfSubject


def refusal(subject: UrdfSubject) -> str | None:
    """Why an asset is beyond mending, or None: files are missing, or the joints make no tree."""
    for file, problem in subject.problems():
        return f"{file}: {problem}"
    for finding in tree(subject):
        return str(finding)
    for finding in limits(subject):
        if finding.check == "structure.type":
            return str(finding)
    return None


def mended(
    original: UrdfSubject, out: Path, *, pieces: int = PIECES
) -> tuple[Draft, list[Outcome]]:
    """Write a mended copy of an asset below `out`; what was changed, and what was left.

    Raises:
        UsageError: the asset is beyond mending; nothing is written then.
    """
    if (problem := refusal(original)) is not None:
        raise UsageError(f"{original.source.file} cannot be mended: {problem}")
    draft, outcomes = copied(original, out)
    for mending in (mended_meshes, rigid_masses, mended_joints, limited_joints):
        outcomes += mending(draft)
    if (problem := _unreadable(draft.subject())) is not None:
        why = f"{problem}; so masses and collision were not looked at"
        return draft, [*outcomes, Left(subject=draft.source.file.name, why=why)]
    outcomes += fitting_masses(draft)
    outcomes += mended_collision(draft, pieces)
    return draft, outcomes


def _unreadable(subject: UrdfSubject) -> str | None:
    """Why the joints and parts still cannot be read as typed values, or None."""
    try:
        subject.assembly  # noqa: B018  (reading is the test)
    except (ArtgenError, ValueError) as error:
        return str(error)
    return None
