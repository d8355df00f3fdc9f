"""Assets for tests: drafts and finished objects of the shipped categories, made once a session."""

from functools import cache

from artgen.articulation.types import ArticulatedObject, Draft
from artgen.core.jsonio import content_hash
from artgen.core.stream import Stream
from artgen.finish import finish
from artgen.generators import load_builder
from artgen.rules import Sampled, load_rule, rule_names, sample

CATEGORIES = tuple(rule_names())
SEED = 101
"""Not the seed of any picture in the docs."""


@cache
def drawn(category: str, index: int) -> Sampled:
    """Params and surfaces of one asset."""
    builder = load_builder(category)
    return sample(
        load_rule(category),
        Stream(SEED, category, index),
        params_type=builder.params_type,
        invariants=builder.invariants,
    )


@cache
def drafted(category: str, index: int) -> Draft:
    """As the builder returns it."""
    sampled = drawn(category, index)
    return load_builder(category).build(sampled.params, sampled.surfaces)


@cache
def finished(category: str, index: int) -> ArticulatedObject:
    """Finished with sharp edges: all but Blender's share."""
    return finish(
        drafted(category, index),
        asset_id=f"{category}_{index:06d}",
        rounder=lambda bodies: [(body.vertices, body.faces) for body in bodies],
    )


def object_hash(obj: ArticulatedObject) -> str:
    """Of every number that the files carry."""
    return content_hash(
        [
            obj.joints,
            obj.preconditions,
            obj.surfaces,
            [
                [
                    p.name,
                    p.mesh.vertices,
                    p.mesh.faces,
                    p.mesh.uv,
                    p.mesh.atlas,
                    p.mass,
                    p.densities,
                ]
                for p in obj.parts
            ],
            [[c.vertices for c in p.collision] for p in obj.parts],
        ]
    )
