"""A small bundle to render: a chest with a door, a glass lid and a drawer."""

import math
from pathlib import Path

import pytest

from artgen.articulation.types import Body, Draft, DraftPart, Joint, Limit
from artgen.core.surface import SurfaceSpec
from artgen.export import Bundle, read_bundle, write_bundle
from artgen.finish import finish
from artgen.geometry.solid import Solid, box
from artgen.textures.library import TextureLibrary
from artgen.worker import BlenderWorker

SURFACES = (
    SurfaceSpec(name="paint", recipe="plain", color=(0.7, 0.2, 0.1)),
    SurfaceSpec(name="white", recipe="plain", color=(0.8, 0.8, 0.8)),
    SurfaceSpec(name="glass", recipe="plain", transmission=1.0, roughness=0.0),
)


def body(solid: Solid, surface: str) -> Body:
    return Body(solid=solid, surface=surface, density=600.0, collision=(solid,))


def chest() -> Draft:
    """0.4 x 0.3 x 0.3 m; the door swings at the left of the front, the drawer slides under it."""
    shell = box((0.4, 0.3, 0.3)) - box((0.36, 0.3, 0.26), at=(0.0, -0.02, 0.02))
    door = DraftPart(
        name="door",
        label="door",
        bodies=(
            body(box((0.35, 0.02, 0.12), at=(0.0, -0.14, 0.15)), "paint"),
            body(box((0.02, 0.02, 0.06), at=(0.15, -0.16, 0.18)), "white"),
        ),
    )
    pane = DraftPart(
        name="lid",
        label="lid",
        bodies=(body(box((0.4, 0.3, 0.006), at=(0.0, 0.0, 0.301)), "glass"),),
    )
    drawer = DraftPart(
        name="drawer",
        label="drawer",
        bodies=(body(box((0.34, 0.25, 0.1), at=(0.0, -0.01, 0.03)), "white"),),
    )
    return Draft(
        category="chest",
        parts=(
            DraftPart(name="base", label="body", bodies=(body(shell, "paint"),)),
            door,
            pane,
            drawer,
        ),
        joints=(
            hinge("door_hinge", "door", (0.0, 0.0, -1.0), (-0.18, -0.14, 0.0)),
            hinge("lid_hinge", "lid", (-1.0, 0.0, 0.0), (0.0, 0.15, 0.301)),
            Joint(
                name="slide",
                type="prismatic",
                parent="base",
                child="drawer",
                axis=(0.0, -1.0, 0.0),
                limit=Limit(lower=0.0, upper=0.2),
                friction=5.0,
                damping=1.0,
                effort=50.0,
            ),
        ),
        surfaces=SURFACES,
    )


def hinge(
    name: str, child: str, axis: tuple[float, float, float], origin: tuple[float, float, float]
) -> Joint:
    return Joint(
        name=name,
        type="revolute",
        parent="base",
        child=child,
        axis=axis,
        origin=origin,
        limit=Limit(lower=0.0, upper=math.pi / 2),
        friction=1.0,
        damping=0.1,
        effort=10.0,
    )


def written(draft: Draft, folder: Path, blender: BlenderWorker) -> Bundle:
    """The bundle of a draft, edges sharp, without a thumbnail."""
    obj = finish(
        draft,
        asset_id=f"{draft.category}_{folder.name}",
        rounder=lambda bodies: [(raw.vertices, raw.faces) for raw in bodies],
        provenance={"seed": 3, "index": int(folder.name)},
    )
    folder.mkdir(parents=True)
    library = TextureLibrary(folder.parent / "textures")
    write_bundle(obj, folder, library=library, worker=blender, thumbnail=b"png")
    return read_bundle(folder)


@pytest.fixture(scope="session")
def bundle(blender: BlenderWorker, tmp_path_factory: pytest.TempPathFactory) -> Bundle:
    return written(chest(), tmp_path_factory.mktemp("chest") / "000001", blender)
