"""Convex decomposition of a closed mesh by CoACD (Wei et al., SIGGRAPH 2022), for foreign assets.

Our own assets author their collision pieces; a decomposition invents contact where a real opening
is. `artgen study simulate` measures how much.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from artgen.core.errors import GeometryError
from artgen.core.mesh import TriMesh

THRESHOLD = 0.03
"""Concavity that is left, relative to the mesh's size; CoACD's default 0.05 closes shallow bins."""
ITERATIONS = 40
"""Of the tree search for each cut, instead of 150."""


def decomposed(mesh: TriMesh, *, pieces: int, timeout_s: float = 600.0) -> tuple[TriMesh, ...]:
    """At most `pieces` convex meshes that together cover `mesh`; the same ones at every call.

    CoACD runs in a process of its own, which may die or hang without harm.

    Raises:
        GeometryError: CoACD is not installed, died, took too long, or found no piece.
    """
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder) / "mesh.npz", Path(folder) / "pieces.npz"
        np.savez(
            source,
            vertices=mesh.vertices,
            faces=mesh.faces,
            pieces=pieces,
            threshold=THRESHOLD,
            iterations=ITERATIONS,
        )
        command = [sys.executable, "-m", "artgen.geometry.decompose_process"]
        command += [str(source), str(target)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=timeout_s)
        except subprocess.TimeoutExpired as error:
            raise GeometryError(
                f"CoACD took more than {timeout_s:g} s for {len(mesh.faces)} triangles; simplify "
                "the mesh, or ask for fewer pieces"
            ) from error
        if done.returncode != 0 or not target.exists():
            cause = (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]
            raise GeometryError(
                f"CoACD made no pieces of {len(mesh.faces)} triangles ({cause}); close and clean "
                "the mesh, or install it: pip install 'artgen[qa]'"
            )
        found = np.load(target)
        count = len(found.files) // 2
        if count == 0:
            raise GeometryError("CoACD found no convex pieces; close the mesh first")
        return tuple(
            TriMesh(vertices=found[f"v{number}"], faces=found[f"f{number}"])
            for number in range(count)
        )
