"""The battery: every check at its level, in the order in which they rely on each other."""

from collections.abc import Callable

from artgen.validate import (
    driven,
    dynamics,
    files,
    free,
    grips,
    inertia,
    interior,
    mechanism,
    mesh,
    models,
    motion,
    promise,
    second_opinion,
    semantics,
    structure,
)
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.levels import Check, Level, Said
from artgen.validate.subject import Subject


def ours(check: Callable[[BundleSubject], Said]) -> Callable[[Subject], Said]:
    """A check of bundles, for the table of all checks; its needs keep other subjects away."""

    def run(subject: Subject) -> Said:
        if not isinstance(subject, BundleSubject):
            raise TypeError(f"{check.__name__} is asked of a {subject.format}; list its needs")
        return check(subject)

    return run


OURS = ("manifest",)
SEEN = ("visual meshes",)

LEVELS: tuple[Level[Subject], ...] = (
    Level(
        name="L0 files",
        needs=(),
        checks=(Check(files.readable, ("files.readable",), profile="quick"),),
    ),
    Level(
        name="L0 structure",
        needs=("L0 files",),
        checks=(
            Check(ours(files.hashes), ("files.file", "files.hash", "files.budget"), OURS, "quick"),
            Check(ours(files.paths), ("files.path", "files.basename"), OURS, "quick"),
            Check(structure.tree, ("structure.tree",), (), "quick"),
            Check(ours(structure.links), ("structure.link",), OURS, "quick"),
            Check(structure.axes, ("structure.axis", "structure.origin"), (), "quick"),
            Check(
                structure.limits,
                ("structure.type", "structure.limit", "structure.rest", "structure.turn"),
                (),
                "quick",
            ),
            Check(
                structure.dynamics, tuple(f"structure.{n}" for n in structure.CAUSES), (), "quick"
            ),
            Check(ours(structure.agreement), ("structure.agreement",), OURS, "quick"),
            Check(inertia.rigid, ("inertia.mass", "inertia.tensor"), (), "quick"),
        ),
    ),
    Level(
        name="L0 model",
        needs=("L0 structure",),
        checks=(Check(structure.typed, ("structure.manifest", "structure.model"), (), "quick"),),
    ),
    Level(
        name="L0 grips",
        needs=("L0 model",),
        checks=(Check(ours(grips.stated), ("structure.grip",), OURS, "quick"),),
    ),
    Level(
        name="L1 mesh files",
        needs=("L0 model",),
        checks=(
            Check(mesh.readable, ("mesh.readable",), (), "quick"),
            Check(structure.complete, ("structure.link",), (), "quick"),
        ),
    ),
    Level(
        name="L1 meshes",
        needs=("L1 mesh files",),
        checks=(
            Check(mesh.closed, ("mesh.closed",), SEEN, "quick"),
            Check(mesh.volumes, ("mesh.volume",), SEEN, "quick"),
            Check(mesh.sizes, ("mesh.size",), SEEN, "quick"),
            Check(mesh.triangles, ("mesh.triangle",), SEEN, "quick"),
            Check(mesh.atlas, ("mesh.atlas",), OURS, "quick"),
            Check(ours(mesh.stated), ("mesh.manifest",), OURS, "quick"),
            Check(ours(mesh.glb), ("mesh.glb",), OURS, "quick"),
            Check(mesh.collision, ("mesh.convex", "mesh.reach"), ("collision",), "quick"),
        ),
    ),
    Level(
        name="L2 inertia",
        needs=("L1 meshes",),
        checks=(
            Check(inertia.densities, ("inertia.density",), SEEN),
            Check(inertia.centers, ("inertia.center", "inertia.extent"), SEEN),
            Check(inertia.integrals, ("inertia.integral",), (*SEEN, "densities")),
            Check(inertia.ratio, ("inertia.ratio",)),
            Check(inertia.uniform, ("inertia.uniform",), SEEN),
        ),
    ),
    Level(
        name="L3 compile",
        needs=("L0 model",),
        checks=(Check(models.compiles, ("compile.file",), (), "quick"),),
    ),
    Level(
        name="L3 model",
        needs=("L3 compile",),
        checks=(
            Check(models.joints, ("compile.dof", "compile.joint", "compile.limit"), (), "quick"),
            Check(models.effects, ("compile.effect",), (), "quick"),
            Check(models.bodies, ("compile.body",), (), "quick"),
        ),
    ),
    Level(
        name="L3 masses",
        needs=("L3 model",),
        checks=(Check(models.masses, ("compile.mass",)),),
    ),
    Level(
        name="L4 kinematics",
        needs=("L3 model",),
        checks=(
            Check(motion.kinematics, ("motion.kinematics",)),
            Check(second_opinion.pinocchio, ("motion.pinocchio",), (second_opinion.NEED,)),
        ),
    ),
    Level(
        name="L4 clearance",
        needs=("L4 kinematics", "L1 meshes"),
        checks=(
            Check(motion.passages, ("motion.passage",), ("collision",)),
            Check(motion.collisions, ("motion.collision",), ("collision",)),
            Check(motion.exact_overlaps, ("motion.overlap",), SEEN),
        ),
    ),
    Level(
        name="L5 semantics",
        needs=("L1 meshes",),
        checks=(
            Check(semantics.order, ("semantics.order",), OURS),
            Check(semantics.ground, ("semantics.ground",), OURS),
            Check(
                ours(semantics.bands),
                tuple(f"semantics.{name}" for name in ("width", "depth", "height", "mass")),
                OURS,
            ),
            Check(ours(semantics.roles), ("semantics.role",), OURS),
            Check(ours(grips.held), ("semantics.grip",), OURS),
            Check(mechanism.hinges, ("semantics.hinge",), SEEN),
            Check(mechanism.travels, ("semantics.travel",), SEEN),
            Check(semantics.together, ("semantics.apart",), SEEN),
            Check(mechanism.rests, ("semantics.rest",)),
            Check(mechanism.axes, ("semantics.tilt",)),
            Check(mechanism.closed_at_rest, ("semantics.closed",), SEEN),
            Check(ours(interior.own_interiors), ("semantics.interior",), OURS),
            Check(
                interior.foreign_interiors,
                ("semantics.interior",),
                ("stranger", *SEEN, "collision"),
                "full",
            ),
        ),
    ),
    Level(
        name="L5 reach",
        needs=("L5 semantics", "L4 clearance"),
        checks=(Check(interior.within_reach, ("semantics.reach",), SEEN, "full"),),
    ),
    Level(
        name="L6 dynamics",
        needs=("L4 clearance", "L3 masses"),
        checks=(
            Check(dynamics.settles, ("dynamics.settle",)),
            Check(ours(dynamics.holds), ("dynamics.hold",), OURS),
            Check(driven.opens, ("dynamics.open",)),
            Check(driven.closes, ("dynamics.close",)),
            Check(driven.stops, ("dynamics.stop",)),
            Check(driven.conserves, ("dynamics.energy",)),
            Check(promise.proven_sometimes, ("dynamics.effects",), (), "standard", "full"),
            Check(promise.proven, ("dynamics.effects",), (), "full"),
            Check(free.stands, ("dynamics.free",), ("collision",), "full"),
        ),
    ),
)
