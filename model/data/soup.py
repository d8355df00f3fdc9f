"""Soup: an object as triangles with colors and how its parts move; light enough to travel.

Bodies are not made disjoint as in finished assets: where two overlap or touch, the caster shows the
later one, which is what making them disjoint gives to see.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import manifold3d as m3
import numpy as np
from numpy.typing import NDArray

from artgen.articulation.canonical import canonicalize, part_bounds
from artgen.articulation.targets import swept_sphere
from artgen.articulation.types import Body, Draft, Joint, Precondition
from artgen.core.errors import ModelError
from artgen.core.mesh import Floats, Ints, frozen
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.generators import load_builder
from artgen.rules import load_rule, sample

TOLERANCE = 0.004
"""Radii by which triangles may leave the exact shape: a quarter of a pixel at 128 px."""
KEPT_VOLUME = 0.8
"""A body that loses more of its volume is thinner than the tolerance, and stays exact."""
GLASS = (0.10, 0.13, 0.15)
"""Linear color of panes: what a clear pane shows is mostly what it mirrors; here it is opaque."""
LOOK = 6
"""Numbers a surface: linear red, green and blue, roughness, metallic, emission."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Soup:
    """One object in canonical form; parts base first, F triangles, V vertices, S surfaces.

    Attributes:
        parts: names in canonical order.
        donors: ids of assets whose parts this one borrows; they decide its split.
        bounds: (P, 2, 3) of the exact parts at rest, m, object frame.
        center: (3,) of the sphere that holds the object in all its states, m.
        radius: of that sphere, m.
        vertices: (V, 3) float32 m, object frame at rest.
        faces: (F, 3) int32, counter-clockwise seen from outside.
        part: (F,) uint8 which part a triangle belongs to.
        body: (F,) uint16 which body, counted over the object; the later one is seen where two meet.
        surface: (F,) uint8 row of `looks`.
        looks: (S, 6) float32 linear RGB, roughness, metallic, emission; all in [0, 1].
    """

    asset_id: str
    category: str
    parts: tuple[str, ...]
    joints: tuple[Joint, ...]
    preconditions: tuple[Precondition, ...]
    bounds: Floats
    center: Floats
    radius: float
    vertices: NDArray[np.float32]
    faces: Ints
    part: NDArray[np.uint8]
    body: NDArray[np.uint16]
    surface: NDArray[np.uint8]
    looks: NDArray[np.float32]
    donors: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        kinds: dict[str, type[np.generic]] = {
            "bounds": np.float64,
            "center": np.float64,
            "vertices": np.float32,
            "faces": np.int32,
            "part": np.uint8,
            "body": np.uint16,
            "surface": np.uint8,
            "looks": np.float32,
        }
        for name, kind in kinds.items():
            object.__setattr__(self, name, frozen(getattr(self, name), kind))
        count = len(self.faces)
        if not count or not len(self.part) == len(self.body) == len(self.surface) == count:
            raise ModelError(
                f"{self.asset_id}: {count} triangles with {len(self.part)} parts, {len(self.body)} "
                f"bodies and {len(self.surface)} surfaces; each triangle has one of each"
            )


def seed_soup(category: str, seed: int, index: int, *, tolerance: float = TOLERANCE) -> Soup:
    """Object `index` of a category at a seed: the shape that `artgen generate` makes of them, its
    edges sharp.

    Raises:
        RuleError: there is no such category, or no valid sample.
    """
    builder = load_builder(category)
    sampled = sample(
        load_rule(category),
        Stream(seed, category, index),
        params_type=builder.params_type,
        invariants=builder.invariants,
    )
    draft = builder.build(sampled.params, sampled.surfaces)
    return draft_soup(draft, asset_id=f"{category}_{index:06d}", tolerance=tolerance)


def draft_soup(draft: Draft, *, asset_id: str, tolerance: float = TOLERANCE) -> Soup:
    """A draft's soup.

    Args:
        tolerance: radii by which triangles may leave the exact shape.
    """
    draft = canonicalize(draft)
    bounds = np.stack([part_bounds(part) for part in draft.parts])
    names = tuple(part.name for part in draft.parts)
    center, radius = swept_sphere(names, list(bounds), draft.joints)
    rows = {surface.name: k for k, surface in enumerate(draft.surfaces)}
    bodies = [(p, body) for p, part in enumerate(draft.parts) for body in part.bodies]
    meshes = [_triangles(body, tolerance * radius) for _, body in bodies]
    starts = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    counts = [len(faces) for _, faces in meshes]
    return Soup(
        asset_id=asset_id,
        category=draft.category,
        parts=names,
        joints=draft.joints,
        preconditions=draft.preconditions,
        bounds=bounds,
        center=center,
        radius=radius,
        vertices=np.concatenate([vertices for vertices, _ in meshes]).astype(np.float32),
        faces=np.concatenate([f + start for (_, f), start in zip(meshes, starts, strict=False)]),
        part=np.repeat([p for p, _ in bodies], counts),
        body=np.repeat(np.arange(len(bodies)), counts),
        surface=np.repeat([rows[body.surface] for _, body in bodies], counts),
        looks=np.array([_look(surface) for surface in draft.surfaces], np.float32),
    )


def _triangles(body: Body, tolerance: float) -> tuple[Floats, Ints]:
    mesh = simplified(body.solid.manifold, tolerance).to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, np.int32)


def simplified(solid: m3.Manifold, tolerance: float) -> m3.Manifold:
    """Fewer triangles within the tolerance; thin solids, which would vanish, get a finer one."""
    for finer in (1.0, 0.5, 0.25):
        simple = solid.simplify(finer * tolerance) if tolerance > 0.0 else solid
        if simple.volume() >= KEPT_VOLUME * solid.volume():
            return simple
    return solid


def _look(surface: SurfaceSpec) -> Sequence[float]:
    color = GLASS if surface.transmission > 0.5 else surface.color
    shines = min(surface.emission, 1.0)
    return (*color, surface.roughness, surface.metallic, shines)
