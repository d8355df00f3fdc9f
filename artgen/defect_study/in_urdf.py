"""Defects of a URDF's text."""

import math

import numpy as np

from artgen.defect_study.defect import Defect
from artgen.defect_study.urdf_edits import (
    about_link_origin,
    collision_boxes,
    extra_joint,
    friction_above_effort,
    in_text,
    in_tree,
    inertia_set,
    limits_times,
    loose_frame,
    mimic,
    on_joint,
    on_link,
    rest_shifted,
    reversed_axis,
    scaled,
    second_root,
    shifted,
    tilted,
    twin,
    visual_as_collision,
    without,
    without_limits,
)

TREE = (
    ("two_roots", "a joint is forgotten", in_tree(second_root)),
    ("duplicate_link", "two links share a name", twin("link")),
    ("duplicate_joint", "two joints share a name", twin("joint")),
    ("unknown_parent", "a joint names a link that is not there", on_joint("parent", "link", "nix")),
    ("unknown_child", "a joint moves a link that is not there", on_joint("child", "link", "nix")),
    ("cycle", "a link is its own ancestor", extra_joint("first", "base")),
    ("self_loop", "a joint joins a link to itself", extra_joint("first", "first")),
    ("two_parents", "a link hangs on two joints", extra_joint("base", "first")),
    ("joint_type", "a joint type that does not exist", on_joint(".", "type", "hinge")),
    ("no_joint_type", "a joint without a type", on_joint(".", "type", "")),
    ("frame_loose", "a frame without mass on a hinge", in_tree(loose_frame)),
    ("mimic_unknown", "a joint follows one that is not there", mimic("nix")),
    ("mimic_self", "a joint follows itself", mimic("self")),
    ("truncated", "half the file was written", in_text(lambda text: text[: len(text) // 2])),
    ("empty", "nothing was written", in_text(lambda text: "")),
)
MOTION = (
    ("axis_zero", "an axis of no length", on_joint("axis", "xyz", "0 0 0")),
    ("axis_tiny", "an axis of length 1e-6", on_joint("axis", "xyz", "0 0 1e-6")),
    ("axis_long", "an axis that was not normalized", on_joint("axis", "xyz", "0 3 0")),
    ("axis_nan", "an axis that is not a number", on_joint("axis", "xyz", "nan 0 0")),
    ("axis_two_numbers", "an axis of two numbers", on_joint("axis", "xyz", "0 1")),
    ("axis_commas", "numbers with commas", on_joint("axis", "xyz", "0,0,1")),
    ("axis_reversed", "the door opens inwards", reversed_axis("revolute")),
    ("slide_reversed", "the drawer opens inwards", reversed_axis("prismatic")),
    ("axis_tilted", "a hinge 3 degrees off", tilted(3.0)),
    (
        "pivot_off",
        "the pivot lies 50 mm beside the edge",
        shifted("origin", "xyz", (0.05, 0.05, 0)),
    ),
    ("pivot_mm", "a pivot in millimeters", shifted("origin", "xyz", (500.0, 0, 0))),
    ("pivot_nan", "a pivot that is not a number", on_joint("origin", "xyz", "nan 0 0")),
    ("limits_swapped", "lower above upper", limits_times(-1.0, "revolute", "prismatic")),
    ("limits_equal", "a joint that cannot move", limits_times(0.0, "revolute", "prismatic")),
    ("limits_missing", "a hinge without limits", in_tree(without_limits)),
    (
        "limits_nan",
        "a limit that is not a number",
        on_joint("limit", "upper", "nan", "revolute", "prismatic"),
    ),
    (
        "limits_infinite",
        "a limit without end",
        on_joint("limit", "upper", "inf", "revolute", "prismatic"),
    ),
    ("limits_degrees", "limits in degrees", limits_times(180 / math.pi, "revolute")),
    ("limits_beyond_turn", "a hinge of more than a turn", limits_times(6.0, "revolute")),
    (
        "limits_past_zero",
        "rest lies outside the limits",
        on_joint("limit", "lower", "0.2", "revolute", "prismatic"),
    ),
    ("travel_too_long", "the drawer leaves its rails", limits_times(3.0, "prismatic")),
    ("rest_ajar", "drawn with the door ajar", rest_shifted(0.4)),
    ("effort_zero", "no force may be exerted", on_joint("limit", "effort", "0")),
    ("effort_negative", "a negative force limit", on_joint("limit", "effort", "-5")),
    ("velocity_zero", "no speed is allowed", on_joint("limit", "velocity", "0")),
    ("damping_negative", "damping that drives", on_joint("dynamics", "damping", "-1")),
    ("friction_negative", "friction that drives", on_joint("dynamics", "friction", "-1")),
    ("damping_nan", "damping that is not a number", on_joint("dynamics", "damping", "nan")),
    ("friction_above_effort", "friction that nothing overcomes", in_tree(friction_above_effort)),
)
MASS = (
    ("mass_zero", "no mass", on_link("inertial/mass", "value", "0")),
    ("mass_negative", "negative mass", on_link("inertial/mass", "value", "-1")),
    ("mass_nan", "a mass that is not a number", on_link("inertial/mass", "value", "nan")),
    ("mass_grams", "mass in grams", scaled("inertial/mass", "value", 1000.0)),
    ("mass_tonnes", "mass in tonnes", scaled("inertial/mass", "value", 0.001)),
    ("inertial_missing", "no inertia stated", without("inertial", of_joint=False)),
    ("inertia_zero", "an inertia of zero", inertia_set(lambda tensor, mass: 0.0 * tensor)),
    ("inertia_negative", "not positive definite", inertia_set(lambda tensor, mass: -tensor)),
    (
        "inertia_triangle",
        "no body has it: A + B < C",
        inertia_set(lambda tensor, mass: np.diag([1.0, 1.0, 3.0]) * np.trace(tensor) / 3.0),
    ),
    ("inertia_tenfold", "density forgotten", inertia_set(lambda tensor, mass: 10.0 * tensor)),
    ("inertia_grams_mm", "g mm2 read as kg m2", inertia_set(lambda tensor, mass: 1e9 * tensor)),
    ("inertia_identity", "the exporter's default", inertia_set(lambda tensor, mass: np.eye(3))),
    ("inertia_about_origin", "not about the center of mass", in_tree(about_link_origin)),
    ("center_at_origin", "center of mass at the hinge", on_link("inertial/origin", "xyz", "0 0 0")),
    ("center_far", "center of mass outside", on_link("inertial/origin", "xyz", "0.9 0.9 0.9")),
)
CONTACT = (
    ("collision_missing", "no collision on a moving link", without("collision", of_joint=False)),
    ("visual_missing", "nothing to see", without("visual", of_joint=False)),
    ("collision_is_visual", "one hull stands for a carcass", in_tree(visual_as_collision)),
    (
        "collision_shifted",
        "collision 50 mm beside the shape",
        collision_boxes(lambda center, size: (center + np.array([0.0, 0.05, 0.0]), size)),
    ),
    (
        "collision_grown",
        "collision a tenth too large",
        collision_boxes(lambda center, size: (center, 1.1 * size)),
    ),
    (
        "collision_flat",
        "a box of no thickness",
        collision_boxes(lambda center, size: (center, size * (1.0, 0.0, 1.0))),
    ),
    (
        "visual_path",
        "a mesh that is not there",
        on_link("visual/geometry/mesh", "filename", "meshes/nix.obj"),
    ),
    (
        "visual_outside",
        "a path out of the folder",
        on_link("visual/geometry/mesh", "filename", "../../../../etc/passwd"),
    ),
    (
        "visual_absolute",
        "the maker's own disk",
        on_link("visual/geometry/mesh", "filename", "/home/me/door.obj"),
    ),
    (
        "visual_package",
        "a package that is not here",
        on_link("visual/geometry/mesh", "filename", "package://nix/door.obj"),
    ),
    (
        "visual_scale",
        "a mesh in millimeters",
        on_link("visual/geometry/mesh", "scale", "0.001 0.001 0.001"),
    ),
)
URDF_DEFECTS = tuple(
    Defect(name=name, format="urdf", what=what, plant=plant)
    for name, what, plant in (*TREE, *MOTION, *MASS, *CONTACT)
)
