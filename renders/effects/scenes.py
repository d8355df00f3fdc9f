"""Small scenes, one for every effect of light transport: it calls for that effect, and what is seen
without it is known.

A stage of floor and wall, a red post on it, and a subject before them.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from artgen.articulation.types import ArticulatedObject, Body, Draft, DraftPart, Joint, Limit
from artgen.core.camera import framed, orbit_direction
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.export.glb import write_glb
from artgen.finish import finish
from artgen.geometry.solid import Solid, box, cylinder
from artgen.render_job import (
    Absorption,
    AreaLight,
    LightRig,
    Relief,
    RenderJob,
    Shot,
    Sky,
    Subsurface,
    ThinGlass,
    Transport,
)
from artgen.studio import Softbox, portrait_rig, softbox_light
from artgen.transport import needed_transport
from artgen.worker import BlenderWorker

MATTE = SurfaceSpec(name="stage", recipe="plain", color=(0.6, 0.6, 0.6), roughness=0.8)
RED = SurfaceSpec(name="post", recipe="plain", color=(0.7, 0.08, 0.05), roughness=0.6)
CENTER, RADIUS = (0.0, 0.0, 0.15), 0.4
SLIDE = 0.12
"""m that a moving subject travels while the shutter is open."""
LAMPS = 24


@dataclass(frozen=True, kw_only=True)
class Scene:
    """One scene.

    Attributes:
        subject: the solid before the post.
        surface: of the subject; its name is `subject`.
        stage: surface of floor and wall; its name is `stage`.
        lamps: how many small lamps hang over it; None is a portrait rig.
        moves: the subject slides while the shutter is open.
    """

    subject: Callable[[], Solid]
    surface: SurfaceSpec
    stage: SurfaceSpec = MATTE
    lamps: int | None = None
    moves: bool = False

    @property
    def surfaces(self) -> tuple[SurfaceSpec, ...]:
        """All of them."""
        return self.stage, self.surface, RED

    @property
    def rig(self) -> LightRig:
        """What shines."""
        if self.lamps is None:
            return portrait_rig(center=CENTER, radius=RADIUS)
        return LightRig(name="lamps", lights=tuple(_lamps(self.lamps)), sky=DARK)

    @property
    def transport(self) -> Transport:
        """What it calls for."""
        return needed_transport(self.surfaces, self.rig, motion_blur=self.moves)


@dataclass(frozen=True, kw_only=True)
class Effect:
    """An effect and what shows it.

    Attributes:
        scene: calls for it.
        off: fields of that scene's transport without it.
        idle: fields that switch it on for `PLAIN`, which does not call for it.
        alone: whether `PLAIN` must be seen by its subject alone for that: the effect is then on
            the other surfaces, or is light from one surface by way of another.
    """

    scene: Scene
    off: Mapping[str, object]
    idle: Mapping[str, object]
    alone: bool = False

    @property
    def without(self) -> Transport:
        """The scene's transport but for this effect."""
        return replace(self.scene.transport, **self.off)  # type: ignore[arg-type]


def _block() -> Solid:
    return box((0.14, 0.14, 0.2), at=(0.0, -0.05, 0.02))


def _pane() -> Solid:
    return box((0.3, 0.006, 0.24), at=(0.02, -0.1, 0.02))


def _cover() -> Solid:
    """A box over the post, open nowhere, with walls 1 cm thick."""
    return box((0.16, 0.16, 0.26), at=(0.1, 0.05, 0.02)) - box(
        (0.14, 0.14, 0.24), at=(0.1, 0.05, 0.02)
    )


def _screen() -> Solid:
    return box((0.02, 0.24, 0.24), at=(-0.08, 0.0, 0.02))


DARK = Sky(nadir=(0.0,) * 3, horizon=(0.0,) * 3, zenith=(0.0,) * 3)
STEEL = replace(MATTE, metallic=1.0, roughness=0.2, color=(0.8, 0.8, 0.8))
SUBJECT = SurfaceSpec(name="subject", recipe="plain", color=(0.75, 0.75, 0.72))
GLASS = replace(SUBJECT, transmission=1.0, roughness=0.0)
PLAIN = Scene(subject=_block, surface=replace(SUBJECT, roughness=0.5), lamps=1)
"""Calls for no effect: matte, and lit by one lamp."""

EFFECTS: Mapping[str, Effect] = {
    "thin_glass": Effect(
        scene=Scene(subject=_pane, surface=replace(GLASS, roughness=0.0)),
        off={"panes": ()},
        idle={"panes": (ThinGlass(surface="post", ior=1.5, tint=(1.0,) * 3, roughness=0.0),)},
        alone=True,
    ),
    "transmission": Effect(
        scene=Scene(subject=_block, surface=replace(GLASS, roughness=0.4)),
        off={"transmission": 0},
        idle={"transmission": 8, "transparent": 8},
    ),
    "refractive_caustics": Effect(
        scene=Scene(subject=_cover, surface=replace(GLASS, roughness=0.3)),
        off={"refractive_caustics": False},
        idle={"refractive_caustics": True},
    ),
    "glossy": Effect(
        scene=Scene(
            subject=_screen, surface=replace(SUBJECT, metallic=1.0, roughness=0.2), stage=STEEL
        ),
        off={"glossy": 1},
        idle={"glossy": 3},
        alone=True,
    ),
    "reflective_caustics": Effect(
        scene=Scene(subject=_screen, surface=replace(SUBJECT, metallic=1.0, roughness=0.3)),
        off={"reflective_caustics": False},
        idle={"reflective_caustics": True},
        alone=True,
    ),
    "subsurface": Effect(
        scene=Scene(subject=_screen, surface=replace(SUBJECT, roughness=0.4, subsurface=0.1)),
        off={"subsurface": ()},
        idle={"subsurface": (Subsurface(surface="stage", depth=0.03),)},
        alone=True,
    ),
    "volume": Effect(
        scene=Scene(
            subject=_block,
            surface=replace(GLASS, attenuation=0.05, color=(0.1, 0.5, 0.2)),
        ),
        off={"absorbing": ()},
        idle={"absorbing": (Absorption(surface="stage", density=(9.0, 5.0, 7.0)),)},
        alone=True,
    ),
    "displacement": Effect(
        scene=Scene(subject=_block, surface=replace(SUBJECT, relief=0.02, relief_size=0.05)),
        off={"relief": ()},
        idle={"relief": (Relief(surface="stage", height=0.01, size=0.04),)},
        alone=True,
    ),
    "motion_blur": Effect(
        scene=Scene(subject=_block, surface=replace(SUBJECT, roughness=0.5), moves=True),
        off={"motion_blur": False},
        idle={"motion_blur": True},
    ),
    "light_tree": Effect(
        scene=Scene(subject=_block, surface=replace(SUBJECT, roughness=0.5), lamps=LAMPS),
        off={"light_tree": False},
        idle={"light_tree": True},
    ),
}
"""Effect to its scene; the keys are those of `Transport.described`."""


def scene_job(scene: Scene, glb: Path, folder: Path, *, size: int, samples: int) -> RenderJob:
    """One image of the scene with what it calls for, raw, written to `folder`/view.exr."""
    corners = np.array([[x, y, z] for x in (-0.2, 0.2) for y in (-0.2, 0.18) for z in (0.0, 0.3)])
    view = framed(
        corners,
        direction=orbit_direction(math.radians(28.0), math.radians(22.0)),
        fov=math.radians(32.0),
        size=(size, size),
        fill=1.0,
    )
    still = {"stage": np.eye(4), "subject": np.eye(4)}
    whole = (0, 0, size, size)
    return RenderJob(
        glb=str(glb.resolve()),
        folder=str(folder.resolve()),
        cameras=(view.stated,),
        states=(still,),
        rig=scene.rig,
        transport=scene.transport,
        shots=(Shot(file="view.exr", camera=0, state=0, part=None, box=whole, samples=samples),),
        seed=0,
        denoise=False,
        exposures=(tuple(_slid(k / 4.0) for k in range(5)),) if scene.moves else (),
    )


def write_scene(scene: Scene, folder: Path, worker: BlenderWorker) -> Path:
    """The scene's GLB, `folder`/asset.glb.

    Raises:
        WorkerError: Blender failed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    write_glb(_object(scene), folder, {}, worker)
    return folder / "asset.glb"


def _object(scene: Scene) -> ArticulatedObject:
    floor = box((0.4, 0.4, 0.02)), box((0.4, 0.02, 0.28), at=(0.0, 0.19, 0.02))
    post = cylinder(0.03, 0.22, segments=32).at(0.1, 0.05, 0.02)
    stage = (*(_body(solid, "stage") for solid in floor), _body(post, "post"))
    draft = Draft(
        category="effect",
        parts=(
            DraftPart(name="stage", label="stage", bodies=stage),
            DraftPart(name="subject", label="subject", bodies=(_body(scene.subject(), "subject"),)),
        ),
        joints=(
            Joint(
                name="slide",
                type="prismatic",
                parent="stage",
                child="subject",
                axis=(-1.0, 0.0, 0.0),
                limit=Limit(lower=0.0, upper=SLIDE),
                friction=1.0,
                damping=1.0,
                effort=10.0,
            ),
        ),
        surfaces=scene.surfaces,
    )
    return finish(
        draft, asset_id="effect", rounder=lambda bodies: [(b.vertices, b.faces) for b in bodies]
    )


def _body(solid: Solid, surface: str) -> Body:
    return Body(solid=solid, surface=surface, density=1000.0, collision=(solid,))


def _slid(share: float) -> dict[str, Floats]:
    moved = np.eye(4)
    moved[0, 3] = -SLIDE * share
    return {"stage": np.eye(4), "subject": moved}


def _lamps(count: int) -> list[AreaLight]:
    """Small lamps low around the scene, each bright near itself and dim elsewhere."""
    turns = np.arange(count) * 2.399963  # the golden angle spreads any number evenly
    heights = 0.2 + 0.6 * (np.arange(count) + 0.5) / count
    return [
        softbox_light(
            Softbox(
                azimuth=float(turn),
                elevation=float(height),
                distance=1.4,
                side=0.1,
                white=2.4 / count,
            ),
            center=CENTER,
            radius=RADIUS,
        )
        for turn, height in zip(turns, heights, strict=True)
    ]
