"""PartNet-Mobility folders for tests, small and with any trap in them."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from artgen.export.partnet.nodes import Leaf, Motion, Node, mobility_json
from artgen.export.partnet.rule import link_name, urdf_text

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""Sides -x, +x, -y, +y, -z, +z of the unit cube, counter-clockwise seen from outside."""
Span = tuple[Sequence[float], Sequence[float]]


def box_obj(
    span: Span, *, name: str, doubled: bool = False, sides: Sequence[int] = range(6)
) -> str:
    """A box as PartNet writes fragments: no `vt`, triangles, `a//c`; `doubled` repeats every face
    turned around, on vertices of its own."""
    lower, upper = np.array(span[0], float), np.array(span[1], float)
    points = lower + CORNERS * (upper - lower)
    faces = []
    for side in sides:
        a, b, c, d = QUADS[side]
        faces += [(a, b, c), (a, c, d)]
    lines = [f"# SSTK version 0.8.0\nmtllib {name}.mtl\no {name}/box#1\nusemtl material_0_0"]
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    lines += ["vn 0 0 1"]
    lines += [f"f {a + 1}//1 {b + 1}//1 {c + 1}//1" for a, b, c in faces]
    if doubled:
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
        lines += [f"f {c + 9}//1 {b + 9}//1 {a + 9}//1" for a, b, c in faces]
    return "\n".join(lines) + "\n"


@dataclass(kw_only=True)
class Folder:
    """The files of one object, to be changed and then written.

    Attributes:
        boxes: stem to its box, mesh frame.
        objs: leaf id to stems.
        numbers: node id to number of its link, where junk shifts it.
    """

    nodes: list[Node]
    boxes: dict[str, Span]
    objs: dict[int, list[str]]
    words: dict[str, tuple[str, str]]
    category: str = "StorageFurniture"
    root_name: str = "storage_furniture"
    doubled: bool = False
    urdf: str | None = None
    extra: dict[str, str] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)

    def write(self, root: Path) -> Path:
        """The folder at `root`."""
        (root / "textured_objs").mkdir(parents=True)
        for stem, span in self.boxes.items():
            text = self.texts.get(stem) or box_obj(span, name=stem, doubled=self.doubled)
            (root / f"textured_objs/{stem}.obj").write_text(text)
            (root / f"textured_objs/{stem}.mtl").write_text(
                "newmtl material_0_0\nillum 3\nd 1\nNs 10\nKd 0.5 0.4 0.3\nKs 0 0 0\n"
            )
        put(root / "mobility_v2.json", mobility_json(self.nodes))
        leaves = [
            {"id": leaf, "name": "leaf", "text": "leaf", "objs": stems}
            for leaf, stems in self.objs.items()
        ]
        put(root / "result.json", [{"id": 0, "name": self.root_name, "children": leaves}])
        put(root / "meta.json", {"model_id": "m", "anno_id": root.name, "model_cat": self.category})
        lines = (f"{link} {kind} {word}\n" for link, (kind, word) in self.words.items())
        (root / "semantics.txt").write_text("".join(lines))
        urdf = self.urdf or urdf_text(self.nodes, self.objs, name="partnet_m")
        (root / "mobility.urdf").write_text(urdf)
        for name, text in self.extra.items():
            (root / name).write_text(text)
        return root


def put(path: Path, value: Any) -> None:
    path.write_text(json.dumps(value))


def leaf(number: int, name: str = "leaf") -> tuple[Leaf, ...]:
    return (Leaf(id=number, name=name),)


def hinge(a: float, b: float, *, origin: Sequence[float], direction: Sequence[float]) -> Motion:
    """Degrees."""
    return Motion(origin=tuple(origin), direction=tuple(direction), a=a, b=b)


def slide(
    a: float, b: float, *, direction: Sequence[float] = (0.0, 0.0, 1.0), **more: Any
) -> Motion:
    """Mesh units."""
    return Motion(origin=(0.0, 0.0, 0.0), direction=tuple(direction), a=a, b=b, **more)


def cabinet(*, drawer: Motion | None = None, door: Motion | None = None) -> Folder:
    """A case of five boards, a drawer above a door with its hinge on the left; front +z, y up.

    As in the data set the root is the last node, and the door's axis stands on its edge.
    """
    drawer = drawer or slide(0.0, 0.4)
    door = door or hinge(0.0, -90.0, origin=(-0.5, 0.0, 0.3), direction=(0.0, 1.0, 0.0))
    boards: Mapping[str, Span] = {
        "original-1": ((-0.6, -0.8, -0.4), (-0.5, 0.8, 0.3)),
        "original-2": ((0.5, -0.8, -0.4), (0.6, 0.8, 0.3)),
        "original-3": ((-0.5, -0.8, -0.4), (0.5, -0.7, 0.3)),
        "original-4": ((-0.5, 0.7, -0.4), (0.5, 0.8, 0.3)),
        "original-5": ((-0.5, -0.7, -0.4), (0.5, 0.7, -0.35)),
        "original-6": ((-0.48, 0.22, -0.3), (0.48, 0.68, 0.35)),
        "original-7": ((-0.5, -0.68, 0.301), (0.56, 0.18, 0.35)),
        "original-8": ((0.46, -0.3, 0.35), (0.5, 0.0, 0.4)),
    }
    nodes = [
        Node(id=0, parent=2, kind="slider", name="drawer", leaves=leaf(6, "drawer_front"),
             motion=drawer),
        Node(id=1, parent=2, kind="hinge", name="cabinet_door",
             leaves=(*leaf(7, "cabinet_door_surface"), *leaf(8, "handle")), motion=door),
        Node(id=2, parent=-1, kind="heavy", name="shelf",
             leaves=tuple(leaf(k, "board")[0] for k in range(1, 6))),
    ]  # fmt: skip
    return Folder(
        nodes=nodes,
        boxes=dict(boards),
        objs={k: [f"original-{k}"] for k in range(1, 9)},
        words={
            link_name(0): ("slider", "drawer"),
            link_name(1): ("hinge", "rotation_door"),
            link_name(2): ("heavy", "furniture_body"),
        },
    )
