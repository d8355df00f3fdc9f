"""The page of `artgen study simulate`, written from what was measured."""

from collections.abc import Mapping, Sequence

from artgen.simulation_study.dropping import Dropped, Saving
from artgen.simulation_study.measured import Measured
from artgen.simulation_study.presets import EVERYDAY, PROMISES, presets
from artgen.studies.table import markdown_table

Study = Mapping[str, Sequence[Measured]]

HEAD = """# What accuracy of simulation costs

Written by `artgen study simulate`, in one run on one thread; the CSV files beside this page hold
every number. Times move with the machine and its load, so read ratios.
"""
INTEGRATORS = """## Integrator and time step

Three everyday motions and a stiff one, each with a closed form (pendulum: Jacobi's elliptic
functions; drawer: Coulomb friction; door: damped oscillator). Below, the largest error over
{everyday} together,
and what they cost together; a preset is the cheapest setting on the front that keeps its promise.
RK4 wins wherever the motion is smooth and stays ahead under soft friction; but it diverges from
b dt / I = 2.8 on, and stops and contacts bring it back to first order, so checks that reach a stop
keep implicitfast at 2 ms.
"""
EFFECTS = """## Effects left off, and effects dropped

Settling for a second, and pushing each joint for a second: {tasks} simulations of {assets} assets.
With only the effects that were called for, {equal} paths equal those with everything on bit for
bit, and none differs by more than {difference:.1g} of its range; {full:.0f} CPU ms became
{lean:.0f} ({ratio:.1f} times less). Dropping an effect that was called for moves joints wrong by so
much of their range:
"""
NOTES = {
    "solvers": """## Solver, iterations, tolerance

Against the same scene with Newton, 1000 iterations, tolerance 1e-15, at the same time step. Newton
with a tolerance of 1e-12 costs no more than with 1e-8 and is right to rounding; a loose tolerance
forgets a light part on a heavy free base. So every preset is Newton at 1e-12.
""",
    "collision": """## Collision pieces

A drawer in its carcass and a door in its frame, 3 mm of air everywhere: the error is the largest
difference of MuJoCo's distance from the exact gap over nine poses, the price is per pose. Boxes and
single hulls fill what should be open; authored pieces are right to float32, so our assets author
theirs, and decomposition serves foreign assets alone.
""",
    "inertia": """## Inertia from meshes

Relative error of mass or principal moments, the larger. Only MuJoCo's `exact` mode is right for
hollow shapes, and URDF cannot ask for it; so masses are integrated in float64 and written down.
""",
    "sweeps": """## Poses of a sweep

How deep an intrusion may be that a sweep overlooks: a door's edge 0.9 m from its hinge passes a
post of 20 mm. Few poses step over the whole post; once the step is below its width, the error falls
with the square of the step. The 21 poses of the standard profile step 71 mm at such an edge, so
they see walls, shelves and neighbors, and may miss a thin post in mid-travel.
""",
}


def page(measured: Study, saving: Saving, dropped: Sequence[Dropped]) -> str:
    """Markdown."""
    return "\n".join(
        [
            HEAD,
            INTEGRATORS.format(everyday=", ".join(EVERYDAY)),
            _presets(measured["integrators"]),
            *(_pictures("integrators", measured["integrators"])),
            *(part for name in NOTES for part in _section(name, measured[name])),
            _effects(saving, dropped),
        ]
    )


def _effects(saving: Saving, dropped: Sequence[Dropped]) -> str:
    head = EFFECTS.format(
        assets=saving.assets,
        tasks=saving.tasks,
        equal=saving.equal,
        difference=saving.difference,
        lean=saving.cpu_ms,
        full=saving.cpu_ms_all,
        ratio=saving.cpu_ms_all / saving.cpu_ms,
    )
    rows = [
        [row.effect, str(row.tasks), f"{row.largest:.2g}", f"{row.median:.2g}"] for row in dropped
    ]
    header = ["dropped", "tasks that called for it", "largest error", "median error"]
    return head + "\n" + markdown_table(header, rows) + "\n"


def _presets(rows: Sequence[Measured]) -> str:
    return (
        markdown_table(
            ["preset", "promise", "integrator", "step", "worst error", "CPU ms"],
            [
                [
                    preset.name,
                    f"{PROMISES[preset.name]:g} rad or m",
                    preset.integrator,
                    f"{1e3 * preset.step:g} ms",
                    f"{preset.error:.2g}",
                    f"{preset.cpu_ms:.2g}",
                ]
                for preset in presets(rows)
            ],
        )
        + "\n"
    )


def _section(name: str, rows: Sequence[Measured]) -> list[str]:
    table = markdown_table(
        ["scene", "setting", "step or count", f"error, {rows[0].unit}", "CPU ms"],
        [
            [row.scene, row.setting, f"{row.step:g}", f"{row.error:.2g}", f"{row.cpu_ms:.2g}"]
            for row in _shown(rows)
        ],
    )
    return [NOTES[name], table + "\n", *_pictures(name, rows)]


def _shown(rows: Sequence[Measured]) -> Sequence[Measured]:
    """All rows of a short table, those with the most iterations of a long one."""
    most = max(row.step for row in rows)
    return rows if len(rows) <= 30 else [row for row in rows if row.step == most]


def _pictures(study: str, rows: Sequence[Measured]) -> list[str]:
    scenes = dict.fromkeys(row.scene for row in rows)
    return [f"![{study}: {scene}]({picture_name(study, scene)})\n" for scene in scenes]


def picture_name(study: str, scene: str) -> str:
    """File name of a plot."""
    return f"simulate_{study}_{scene.replace(' ', '_').replace(',', '')}.png"
