"""What makes two objects the same, and what does not."""

from dataclasses import replace

import numpy as np

from artgen.articulation.types import Joint, Limit
from artgen.assembly.shape_hash import looks_hash, object_hash, shape_hash, tree_hash
from artgen.core.mesh import TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.geometry.solid import hull

MESH = hull([(0, 0, 0), (0.4, 0, 0), (0, 0.3, 0), (0, 0, 0.2), (0.1, 0.1, 0.3)]).trimesh()
OAK = SurfaceSpec(name="front", recipe="wood", detail={"species": "oak"})


def moved(scale, shift=(0.0, 0.0, 0.0)):
    return TriMesh(vertices=MESH.vertices * scale + shift, faces=MESH.faces)


def joint(parent, child, kind="prismatic"):
    limit = Limit(lower=0.0, upper=0.3)
    return Joint(
        name=f"{child}_joint",
        type=kind,
        parent=parent,
        child=child,
        axis=(0.0, -1.0, 0.0),
        limit=limit,
        friction=1.0,
        damping=1.0,
        effort=10.0,
    )


def test_place_size_and_mirroring_do_not_change_a_shape():
    wanted = shape_hash(MESH)
    assert shape_hash(moved(2.5, (1.0, 2.0, 3.0))) == wanted
    assert shape_hash(moved(np.array([-1.0, 1.0, 1.0]))) == wanted


def test_proportions_and_corners_do():
    assert shape_hash(moved(np.array([1.0, 1.0, 1.02]))) != shape_hash(MESH)
    dented = np.array(MESH.vertices)
    dented[0, 0] += 0.005
    assert shape_hash(TriMesh(vertices=dented, faces=MESH.faces)) != shape_hash(MESH)


def test_trees_are_told_by_labels_kinds_and_parents_alone():
    labels = {"base": "base", "a": "door", "b": "drawer"}
    wanted = tree_hash(labels, [joint("base", "a", "revolute"), joint("base", "b")], "base")
    renamed = {"base": "base", "x": "drawer", "y": "door"}
    same = tree_hash(renamed, [joint("base", "x"), joint("base", "y", "revolute")], "base")
    assert same == wanted
    for joints in (
        [joint("base", "a"), joint("base", "b")],
        [joint("base", "a", "revolute"), joint("a", "b")],
    ):
        assert tree_hash(labels, joints, "base") != wanted


def test_looks_are_told_whatever_their_names_and_order():
    glass = SurfaceSpec(name="glass", recipe="plain", transmission=1.0)
    assert looks_hash([OAK, glass]) == looks_hash([glass, replace(OAK, name="x")])
    assert looks_hash([OAK]) != looks_hash([replace(OAK, color=(0.1, 0.1, 0.1))])


def test_an_object_is_tree_shapes_and_looks_together():
    boxes = [MESH.bounds]
    wanted = object_hash("t", ["s"], boxes, "l")
    assert object_hash("t", ["s"], [MESH.bounds + 1e-5], "l") == wanted
    others = (("u", ["s"], boxes, "l"), ("t", ["r"], boxes, "l"), ("t", ["s"], boxes, "m"))
    assert all(object_hash(*other) != wanted for other in others)
    assert object_hash("t", ["s"], [MESH.bounds * 1.1], "l") != wanted
