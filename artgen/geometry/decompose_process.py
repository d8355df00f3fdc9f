"""The process that runs CoACD: `python -m artgen.geometry.decompose_process IN.npz OUT.npz`.

CoACD brings an Embree of its own that breaks Blender's module, and dies on some meshes; so it is
imported here alone, and nothing imports this module.
"""

import sys

import coacd
import numpy as np


def main(source: str, target: str) -> None:
    """Read a mesh and settings, write the pieces."""
    given = np.load(source)
    coacd.set_log_level("error")
    parts = coacd.run_coacd(
        coacd.Mesh(given["vertices"], given["faces"]),
        threshold=float(given["threshold"]),
        max_convex_hull=int(given["pieces"]),
        preprocess_mode="off",
        mcts_iterations=int(given["iterations"]),
        seed=0,
    )
    arrays: dict[str, np.ndarray[tuple[int, ...], np.dtype[np.float64]]] = {}
    for number, (vertices, faces) in enumerate(parts):
        arrays |= {f"v{number}": vertices, f"f{number}": faces}
    np.savez(target, **arrays)


if __name__ == "__main__":
    main(*sys.argv[1:])
