"""Checks of a bundle from its files: structure, meshes, inertia, MuJoCo, motion, meaning."""

from collections.abc import Iterable
from pathlib import Path

from artgen.validate import files, inertia, mesh, models, semantics, simulate, structure
from artgen.validate.report import Finding, Level, Report, Skipped, run_levels
from artgen.validate.subject import Subject

__all__ = ["Finding", "Report", "Skipped", "validate_bundle"]

LEVELS: Iterable[Level[Subject]] = (
    Level(name="L0 files", needs=(), checks=(files.readable,)),
    Level(
        name="L0 structure",
        needs=("L0 files",),
        checks=(
            files.hashes,
            files.paths,
            structure.tree,
            structure.links,
            structure.axes,
            structure.limits,
            structure.dynamics,
            structure.agreement,
            inertia.rigid,
        ),
    ),
    Level(name="L0 manifest", needs=("L0 structure",), checks=(structure.typed,)),
    Level(name="L1 mesh files", needs=("L0 manifest",), checks=(mesh.readable,)),
    Level(
        name="L1 meshes",
        needs=("L1 mesh files",),
        checks=(
            mesh.closed,
            mesh.volumes,
            mesh.sizes,
            mesh.triangles,
            mesh.atlas,
            mesh.stated,
            mesh.glb,
            mesh.collision,
        ),
    ),
    Level(
        name="L2 inertia",
        needs=("L1 meshes",),
        checks=(inertia.densities, inertia.centers, inertia.integrals),
    ),
    Level(name="L3 compile", needs=("L0 manifest",), checks=(models.compiles,)),
    Level(name="L3 model", needs=("L3 compile",), checks=(models.joints, models.bodies)),
    Level(name="L3 masses", needs=("L3 model",), checks=(models.masses,)),
    Level(name="L4 kinematics", needs=("L3 model",), checks=(simulate.kinematics,)),
    Level(
        name="L4 clearance",
        needs=("L4 kinematics", "L1 meshes"),
        checks=(simulate.collisions, simulate.exact_overlaps),
    ),
    Level(name="L4 settle", needs=("L4 clearance", "L3 masses"), checks=(simulate.settles,)),
    Level(
        name="L5 semantics",
        needs=("L1 meshes",),
        checks=(
            semantics.order,
            semantics.ground,
            semantics.bands,
            semantics.hinges,
            semantics.closed_at_rest,
        ),
    ),
)


def validate_bundle(folder: Path) -> Report:
    """The verdict on the bundle in `folder`, from its files alone; a bad bundle never raises."""
    subject = Subject(folder=folder)
    return run_levels(_asset_name(subject), subject, LEVELS)


def _asset_name(subject: Subject) -> str:
    """The manifest's asset_id, or the folder's name where there is none."""
    try:
        return str(subject.manifest["asset_id"])
    except (OSError, ValueError, LookupError, TypeError):
        return subject.folder.name
