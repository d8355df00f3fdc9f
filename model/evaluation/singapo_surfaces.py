"""SINGAPO's dCD (metrics/cd.py): squared Chamfer distance of matched parts, over states.

Both directions of the many-to-one mapping are averaged; 2048 points a part; the base counts; the
object is centered and stretched as for the box metrics. The original stretches meshes by the
inverse factor and leaves the centers as they are, which looks like a mistake: here meshes, centers
and pivots are stretched alike.
"""

import numpy as np

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.transform import apply
from model.evaluation.layout import Layout
from model.evaluation.matching import singapo_mapping
from model.evaluation.singapo import STATES, compared_as_published, published_poses
from model.evaluation.surfaces import chamfer_squared, sampled

POINTS = 2048


def published_chamfers(
    predicted: Layout, true: Layout, *, handles: bool = True
) -> tuple[float | None, float | None]:
    """(RS-dCD, AS-dCD) in the unit of the layouts squared; None where a part has no surface."""
    predicted, true = compared_as_published(predicted, true, handles=handles)
    stream = Stream(0, "evaluation", "singapo_surfaces", true.name)
    clouds = [_points(own, stream.child(str(k))) for k, own in enumerate((predicted, true))]
    if clouds[0] is None or clouds[1] is None:
        return None, None
    found = np.zeros(STATES)
    for row, share in enumerate(np.linspace(0.0, 1.0, STATES).tolist()):
        moved = [
            [apply(pose, points) for pose, points in zip(published_poses(own, share), cloud,
                                                         strict=True)]
            for own, cloud in zip((predicted, true), (clouds[0], clouds[1]), strict=True)
        ]  # fmt: skip
        ways = ((predicted, true, moved[0], moved[1]), (true, predicted, moved[1], moved[0]))
        for source, target, mine, theirs in ways:
            mapping = singapo_mapping(source.centers, target.centers)
            gaps = [chamfer_squared(mine[k], theirs[other]) for k, other in enumerate(mapping)]
            found[row] += np.mean(gaps) / 2.0
    return float(found[0]), float(found.mean())


def _points(layout: Layout, stream: Stream) -> list[Floats] | None:
    found = []
    for part, mesh in enumerate(layout.meshes):
        if mesh is None:
            return None
        found.append(sampled(mesh.triangles, POINTS, stream.child(part).generator()).points)
    return found or None
