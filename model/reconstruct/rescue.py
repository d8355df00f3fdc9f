"""A joint that is blocked where it leaves rest is given the nearest place, or the direction, that
lets it go.

A hinge that is predicted a little inside of its part turns the part's rim into what carries it;
about an edge of the part it does not. A slide may be predicted with the wrong sign.
"""

import dataclasses
from collections.abc import Iterator

import numpy as np

from artgen.articulation.types import Joint
from model.reconstruct.freedom import ENOUGH, free_share
from model.reconstruct.scene import Scene

GAIN = 0.15
"""Share of its way that another place must free more."""
FARTHEST = 0.25
"""Share of a part's diagonal by which its hinge may be off; an edge beyond is another hinge."""


def unblocked(scene: Scene) -> Scene:
    """The scene with blocked joints moved to edges of their parts, or turned around."""
    for name in [joint.name for joint in scene.joints]:
        share = free_share(scene, name)
        if share < ENOUGH:
            scene = _better(scene, name, share)
    return scene


def _better(scene: Scene, name: str, share: float) -> Scene:
    """The scene with the first of the other places of a joint that frees most of its way."""
    best: tuple[float, Scene] = (share + GAIN, scene)
    for joint, text in places(scene, scene.joint(name)):
        tried = scene.with_joint(joint)
        found = free_share(tried, name)
        if found > best[0] + 1e-9:
            best = found, tried.told(f"{name} {text}, as it could not leave rest where it was")
        if best[0] >= 1.0:
            break
    return best[1]


def places(scene: Scene, joint: Joint) -> Iterator[tuple[Joint, str]]:
    """Other statements of a joint, the nearest first, and how each differs."""
    axis = np.array(joint.axis)
    back = tuple((-axis + 0.0).tolist())
    turned = dataclasses.replace(joint, axis=back)
    along = int(np.argmax(np.abs(axis)))
    if joint.type != "prismatic" and abs(axis[along]) > 1.0 - 1e-9:
        bounds, origin = scene.solids[joint.child].bounds, np.array(joint.origin)
        others = [k for k in range(3) if k != along]
        edges = []
        for corner in np.ndindex(2, 2):
            edge = origin.copy()
            edge[others] = [bounds[end, k] for end, k in zip(corner, others, strict=True)]
            edges.append(edge)
        reach = FARTHEST * float(np.linalg.norm(bounds[1] - bounds[0]))
        for edge in sorted(edges, key=lambda own: float(np.linalg.norm(own - origin))):
            way = float(np.linalg.norm(edge - origin))
            if way > reach:
                break
            x, y, z = edge.tolist()
            moved = dataclasses.replace(joint, origin=(x, y, z))
            yield moved, f"was moved by {way:.3g} m to an edge of {joint.child}"
    yield turned, "was turned around"
