"""What every category promises; a new one is found by its rule file and asked the same."""

import dataclasses
import math
import subprocess
import sys

import numpy as np
import pytest

from artgen.articulation.canonical import canonical_order, canonicalize
from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.roles import role_of
from artgen.articulation.states import required_state
from artgen.articulation.types import ArticulatedObject, Joint, Limit
from artgen.core.transform import apply
from artgen.generators import load_builder
from artgen.geometry.measure import open_edges, total_volume
from artgen.geometry.unwrap import texel_density
from artgen.rules import load_rule
from tests.made import CATEGORIES, SEED, drafted, drawn, finished, object_hash
from tests.texels import density_ratio, shared_area

OWN_WORKER = {name: pytest.mark.xdist_group(name) for name in CATEGORIES}
"""A category is made by one worker, which keeps its drafts and finished objects."""
ASSETS = [
    pytest.param(category, index, marks=OWN_WORKER[category])
    for category in CATEGORIES
    for index in (0, 1)
]
ALONG = ("door", "sash")
"""Roles that may slide along the face they close."""
every_asset = pytest.mark.parametrize(("category", "index"), ASSETS)
every_category = pytest.mark.parametrize(
    "category", [pytest.param(name, marks=OWN_WORKER[name]) for name in CATEGORIES]
)


def joint_id(joint: Joint) -> str:
    return f"{joint.name} ({joint.type})"


@every_category
def test_the_rule_has_many_numbers_and_choices(category: str) -> None:
    rule = load_rule(category)
    kinds = [type(draw.distribution).__name__ for draw in rule.draws.values()]
    assert sum(kind in ("Uniform", "LogUniform", "Normal", "Integer") for kind in kinds) >= 12
    assert sum(kind in ("Choice", "Chance", "Integer") for kind in kinds) >= 3
    assert dataclasses.is_dataclass(load_builder(category).params_type)


@every_category
def test_the_same_seed_gives_the_same_object_in_a_fresh_process(category: str) -> None:
    code = (
        "from tests.made import finished, object_hash;"
        f"print(object_hash(finished({category!r}, 0)))"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == object_hash(finished(category, 0))


@every_category
def test_different_indices_give_different_objects(category: str) -> None:
    assert object_hash(finished(category, 0)) != object_hash(finished(category, 1))
    assert drawn(category, 0).params != drawn(category, 1).params


@every_asset
def test_parts_and_joints_are_in_canonical_form(category: str, index: int) -> None:
    obj = finished(category, index)
    bounds = [part.mesh.bounds for part in obj.parts]
    assert canonical_order(bounds) == list(range(len(bounds)))
    noise = np.random.Generator(np.random.PCG64(SEED)).uniform(-1e-6, 1e-6, (len(bounds), 2, 3))
    assert canonical_order([b + n for b, n in zip(bounds, noise, strict=True)]) == list(
        range(len(bounds))
    )
    once = canonicalize(drafted(category, index))
    assert canonicalize(once).joints == once.joints


@every_asset
def test_it_stands_on_the_floor_in_the_middle(category: str, index: int) -> None:
    boxes = np.array([part.mesh.bounds for part in finished(category, index).parts])
    lower, upper = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    # Vertices are rounded to 1e-7 m, each end by half of that.
    assert abs(lower[2]) <= 1e-7
    assert np.abs(lower + upper)[:2].max() <= 2e-7


@every_asset
def test_every_body_is_closed_outward_and_thick(category: str, index: int) -> None:
    for part in finished(category, index).parts:
        for body in np.unique(part.mesh.body):
            faces = part.mesh.faces[part.mesh.body == body]
            own = dataclasses.replace(
                part.mesh, faces=faces, uv=None, atlas=None, slot=None, body=None
            )
            assert open_edges(faces) == 0
            assert total_volume(own) > 1e-12  # A cube of 0.1 mm.


@every_asset
def test_names_say_what_parts_are(category: str, index: int) -> None:
    obj = finished(category, index)
    assert obj.base.name == obj.base.label == "base"
    assert all(role_of(part.label) for part in obj.parts)
    grips = [grip.name for part in obj.parts for grip in part.grips]
    assert len(set(grips)) == len(grips)
    assert {surface.name for surface in obj.surfaces} >= {
        obj.surfaces[slot].name for part in obj.parts for slot in np.unique(part.mesh.slot)
    }


def base_middle(obj: ArticulatedObject) -> np.ndarray:
    """The middle of the base's box."""
    return obj.base.mesh.bounds.mean(axis=0)


def movers(obj: ArticulatedObject) -> list[Joint]:
    """Joints that open; one without limits (a spray arm, a wheel) has no closed end."""
    return [joint for joint in obj.joints if joint.mimic is None and joint.limit is not None]


@every_asset
def test_positive_q_opens(category: str, index: int) -> None:
    """What closes starts forwards or upwards, away from the closed object; a sliding door or sash
    runs along the face it closes instead, and a tray may leave by any side."""
    obj = finished(category, index)
    parts = {part.name: part for part in obj.parts}
    for joint in movers(obj):
        part = parts[joint.child]
        along = joint.type == "prismatic" and abs(joint.axis[1]) < 0.5 and part.label in ALONG
        if along or not role_of(part.label).closes:
            continue
        middle = part.mesh.bounds.mean(axis=0)
        before = required_state(joint.name, obj.preconditions)
        step = 0.05 * (joint.limit.upper if joint.limit else 1.0)
        poses = [
            forward_kinematics("base", obj.joints, {**before, joint.name: q}) for q in (0.0, step)
        ]
        moved = apply(poses[1][joint.child], middle) - apply(poses[0][joint.child], middle)
        away = moved @ (middle - base_middle(obj)) if part.label == "tray" else 0.0
        assert max(-moved[1], moved[2], away) > 0.0, joint_id(joint)


@every_asset
def test_people_can_move_it(category: str, index: int) -> None:
    """Every part resists as its role says (a door with 0.5 to 5 N m, a drawer with 5 to 50 N), and
    the effort limit is above friction, latch and spring together."""
    obj = finished(category, index)
    labels = {part.name: part.label for part in obj.parts}
    for joint in obj.joints:
        role = role_of(labels[joint.child])
        lower, upper = role.sliding if joint.type == "prismatic" else role.turning
        assert joint.mimic or lower <= joint.friction <= upper, joint_id(joint)
        latch = joint.latch.force if joint.latch else 0.0
        assert joint.effort > joint.friction + latch, joint_id(joint)


@every_asset
def test_preconditions_can_be_met(category: str, index: int) -> None:
    obj = finished(category, index)
    limits = {
        joint.name: joint.limit or Limit(lower=-math.pi, upper=math.pi) for joint in obj.joints
    }
    for rule in obj.preconditions:
        assert 0.0 < rule.at_least <= limits[rule.requires].upper


@every_asset
def test_textures_are_in_scale_and_the_atlas_in_its_square(category: str, index: int) -> None:
    """Box projection shortens a face by at most sqrt(3), so the root of its area by 3^(1/4); decals
    are laid flat and left out. Rounding UV to 1e-6 m moves triangles above 10 mm2 by under 1 %."""
    obj = finished(category, index)
    bodies = [body for part in drafted(category, index).parts for body in part.bodies]
    decals = {body.surface for body in bodies if body.decal is not None}
    tiled = np.array([surface.name not in decals for surface in obj.surfaces])
    for part in obj.parts:
        corners = part.mesh.triangles
        area = np.linalg.norm(
            np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
        )
        density = texel_density(corners, part.mesh.uv)[(area > 2e-5) & tiled[part.mesh.slot]]
        assert density.size == 0 or density.min() > 3**-0.25 - 1e-2
        assert density.size == 0 or density.max() < 1.0 + 1e-2
        assert part.mesh.atlas.min() >= 0.0
        assert part.mesh.atlas.max() <= 1.0


@every_asset
def test_no_two_places_share_a_texel(category: str, index: int) -> None:
    """The union of all triangles on the atlas is as large as their sum, but for rounding: corners
    lie on a grid of 1e-6, so an edge of length 1e-3 may lean over its neighbor by 1e-9."""
    atlas = np.concatenate([part.mesh.atlas for part in finished(category, index).parts])
    assert shared_area(atlas) < 2e-4


@every_asset
def test_texels_are_alike_all_over_an_asset(category: str, index: int) -> None:
    """One scale for all charts, flattened along an axis."""
    parts = finished(category, index).parts
    corners = np.concatenate([part.mesh.triangles for part in parts])
    atlas = np.concatenate([part.mesh.atlas for part in parts])
    assert density_ratio(corners, atlas) <= 2.0
