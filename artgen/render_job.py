"""RenderJob: what Blender is asked to render, as plain data.

Standard library alone: Blender's own Python on a render farm need not have anything else.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Self

from artgen.core.errors import RenderError
from artgen.core.stated_camera import StatedCamera

Color = tuple[float, float, float]
Point = tuple[float, float, float]
Prefilter = Literal["none", "fast", "accurate"]
DenoiseQuality = Literal["high", "balanced", "fast"]
Pass = Literal["depth", "part", "albedo"]
"""Planar depth, m; 1 + index of the part among the sorted names; color of the diffuse lobe."""


@dataclass(frozen=True, kw_only=True)
class AreaLight:
    """A rectangle that shines to one side, as a softbox does.

    Attributes:
        position: of its middle, m, world.
        target: the point it faces, m, world.
        size: (width, height) m.
        radiance: linear RGB; a white wall that sees nothing but this light shows its radiance.
    """

    position: Point
    target: Point
    size: tuple[float, float]
    radiance: Color


@dataclass(frozen=True, kw_only=True)
class Sky:
    """A smooth surrounding, linear RGB radiance by direction: from below, level, from above."""

    nadir: Color
    horizon: Color
    zenith: Color


@dataclass(frozen=True, kw_only=True)
class Environment:
    """A surrounding as an image of radiance, in place of the sky.

    Column j of row i in an image of H rows and 2 H columns shows the direction with azimuth
    2 pi (j + 0.5) / (2 H) - pi, from the front (-y) towards +x, and elevation
    pi / 2 - pi (i + 0.5) / H above the horizon.

    Attributes:
        file: absolute path of an EXR, linear RGB.
        strength: factor on every pixel.
    """

    file: str
    strength: float = 1.0


@dataclass(frozen=True, kw_only=True)
class Ground:
    """A floor that shows nothing but the shadow it catches.

    Attributes:
        height: m, world z.
        center: (x, y) m.
        radius: m.
    """

    height: float
    center: tuple[float, float]
    radius: float


@dataclass(frozen=True, kw_only=True)
class LightRig:
    """Everything that shines, and the floor it falls on.

    Attributes:
        name: the rig's identifier.
        environment: replaces `sky` where given; `sky` is then its mean by height.
    """

    name: str
    lights: tuple[AreaLight, ...]
    sky: Sky
    environment: Environment | None = None
    ground: Ground | None = None


@dataclass(frozen=True, kw_only=True)
class ThinGlass:
    """A flat pane, rendered by Fresnel's law without refraction."""

    surface: str
    ior: float
    tint: Color
    roughness: float


@dataclass(frozen=True, kw_only=True)
class Subsurface:
    """A surface under which light travels `depth` m on average before it leaves elsewhere."""

    surface: str
    depth: float


@dataclass(frozen=True, kw_only=True)
class Absorption:
    """A refracting body that leaves exp(-density * way) of the light; 1/m, linear RGB."""

    surface: str
    density: Color


@dataclass(frozen=True, kw_only=True)
class Relief:
    """Bumps of width `size` m carved up to `height` m into a surface."""

    surface: str
    height: float
    size: float


@dataclass(frozen=True, kw_only=True)
class Transport:
    """Which light transport is computed; what a scene does not call for is off.

    Attributes:
        diffuse: bounces; 0 renders direct light alone.
        glossy: bounces.
        transmission: bounces inside refracting bodies; 0 without any.
        transparent: panes that a ray may cross.
        clamp_indirect: largest indirect contribution of one path, linear.
        panes: surfaces that are rendered as thin glass.
        subsurface, absorbing, relief: surfaces that get these effects.
        reflective_caustics: matte surfaces receive light by way of mirrors.
        refractive_caustics: matte surfaces receive light by way of refracting bodies.
        light_tree: lamps are chosen by what they add at a point, not by power alone.
        motion_blur: parts move while the shutter is open, as `RenderJob.exposures` states.
        reasons: effect to why it is on or off.
    """

    diffuse: int
    glossy: int
    transmission: int
    transparent: int
    clamp_indirect: float
    panes: tuple[ThinGlass, ...]
    subsurface: tuple[Subsurface, ...] = ()
    absorbing: tuple[Absorption, ...] = ()
    relief: tuple[Relief, ...] = ()
    reflective_caustics: bool = False
    refractive_caustics: bool = False
    light_tree: bool = False
    motion_blur: bool = False
    reasons: Mapping[str, str] = field(default_factory=dict)

    @property
    def settings(self) -> dict[str, object]:
        """Effect to what Blender is told: bounces, names of surfaces, or yes and no."""
        return {
            "transmission": self.transmission,
            "thin_glass": [pane.surface for pane in self.panes],
            "glossy": self.glossy,
            "reflective_caustics": self.reflective_caustics,
            "refractive_caustics": self.refractive_caustics,
            "subsurface": [body.surface for body in self.subsurface],
            "volume": [body.surface for body in self.absorbing],
            "displacement": [body.surface for body in self.relief],
            "motion_blur": self.motion_blur,
            "light_tree": self.light_tree,
        }

    def described(self) -> dict[str, dict[str, object]]:
        """Effect to whether it is on, how it is set and why; for reports and sample metadata."""
        return {
            effect: {"on": bool(value), "set": value, "why": self.reasons.get(effect, "as asked")}
            for effect, value in self.settings.items()
        }


@dataclass(frozen=True, kw_only=True)
class Shot:
    """One image.

    Attributes:
        file: name of the EXR in the job's folder.
        camera, state: indices into the job.
        part: the only part in the scene, or None for all.
        box: (left, top, right, bottom) px, half open; the EXR holds this window of the image.
        samples: paths a pixel."""

    file: str
    camera: int
    state: int
    part: str | None
    box: tuple[int, int, int, int]
    samples: int


@dataclass(frozen=True, kw_only=True)
class RenderJob:
    """Images of one GLB.

    Attributes:
        glb: absolute path.
        folder: absolute path of a folder that exists; receives the EXR files.
        states: part name to (4, 4) `object_from_rest`, row by row, for each state.
        shots: rendered in this order; no image depends on it.
        seed: of the path tracer.
        denoise: pass every image through OpenImageDenoise.
        prefilter: how the denoiser cleans the albedo and normals that guide it.
        denoise_quality: of the denoiser's network.
        adaptive: noise below which a pixel gets no more paths; 0 gives every pixel all of them.
        bounces: cap on the bounces of every kind that `transport` states; None caps nothing.
        exposures: for each state, part poses at even steps of time while the shutter is open, the
            first or the last of them the state itself; empty renders stills.
        passes: what a multilayer EXR of float32 holds beside the beauty; empty writes a plain EXR
            of half floats.

    Raises:
        RenderError: a number is not finite, a window lies outside its image, or an index leads
            nowhere.
    """

    glb: str
    folder: str
    cameras: tuple[StatedCamera, ...]
    states: tuple[Mapping[str, Any], ...]
    rig: LightRig
    transport: Transport
    shots: tuple[Shot, ...]
    seed: int
    denoise: bool = True
    prefilter: Prefilter = "fast"
    denoise_quality: DenoiseQuality = "high"
    adaptive: float = 0.0
    bounces: int | None = None
    exposures: tuple[tuple[Mapping[str, Any], ...], ...] = ()
    passes: tuple[Pass, ...] = ()
    kind: str = field(default="render")

    def __post_init__(self) -> None:
        for number, camera in enumerate(self.cameras):
            _check_camera(f"camera {number}", camera)
        for number, pose in enumerate(self.states):
            _check_poses(f"state {number}", pose)
        for number, moments in enumerate(self.exposures):
            for pose in moments:
                _check_poses(f"exposure {number}", pose)
        if self.exposures and len(self.exposures) != len(self.states):
            raise RenderError(
                f"{len(self.exposures)} exposures for {len(self.states)} states; expected one each"
            )
        for shot in self.shots:
            self._check_shot(shot)

    def _check_shot(self, shot: Shot) -> None:
        if not (0 <= shot.camera < len(self.cameras) and 0 <= shot.state < len(self.states)):
            raise RenderError(
                f"shot {shot.file} asks for camera {shot.camera} and state {shot.state}; the job "
                f"has {len(self.cameras)} cameras and {len(self.states)} states"
            )
        width, height = self.cameras[shot.camera].size
        left, top, right, bottom = shot.box
        if not (0 <= left < right <= width and 0 <= top < bottom <= height):
            raise RenderError(
                f"shot {shot.file} has window {tuple(shot.box)}, expected (left, top, right, "
                f"bottom) px with an area inside {width} x {height}"
            )
        if shot.samples < 1:
            raise RenderError(f"shot {shot.file} has {shot.samples} paths a pixel, expected >= 1")

    @classmethod
    def from_plain(cls, job: Mapping[str, Any]) -> Self:
        """The job that `plain` turned into JSON."""
        rig = job["rig"]
        typed = {
            "cameras": tuple(_camera(camera) for camera in job["cameras"]),
            "states": tuple(job["states"]),
            "exposures": tuple(tuple(moments) for moments in job["exposures"]),
            "passes": tuple(job["passes"]),
            "rig": LightRig(
                name=rig["name"],
                lights=tuple(AreaLight(**light) for light in rig["lights"]),
                sky=Sky(**rig["sky"]),
                environment=rig["environment"] and Environment(**rig["environment"]),
                ground=rig["ground"] and Ground(**rig["ground"]),
            ),
            "transport": _transport(job["transport"]),
            "shots": tuple(Shot(**shot) for shot in job["shots"]),
        }
        return cls(**{**job, **typed})


def _transport(stated: Mapping[str, Any]) -> Transport:
    kinds = {
        "panes": ThinGlass,
        "subsurface": Subsurface,
        "absorbing": Absorption,
        "relief": Relief,
    }
    typed = {name: tuple(kind(**row) for row in stated[name]) for name, kind in kinds.items()}
    return Transport(**{**stated, **typed})


def _camera(stated: Mapping[str, Any]) -> StatedCamera:
    a, b, c, d = (tuple(row) for row in stated["camera_from_world"])
    return StatedCamera(
        focal=stated["focal"],
        principal=tuple(stated["principal"]),
        size=tuple(stated["size"]),
        camera_from_world=(a, b, c, d),
    )


def _check_camera(where: str, camera: StatedCamera) -> None:
    numbers = (camera.focal, *camera.principal, *_entries(camera.camera_from_world))
    if not (all(map(math.isfinite, numbers)) and camera.focal > 0.0 and min(camera.size) > 0):
        raise RenderError(
            f"{where} has focal {camera.focal} px, principal {camera.principal} px, size "
            f"{camera.size} px, pose {camera.camera_from_world}; expected finite numbers, focal "
            "and size > 0; what was it framed on?"
        )


def _check_poses(where: str, poses: Mapping[str, Any]) -> None:
    for part, pose in poses.items():
        entries = _entries(pose)
        if len(entries) != 16 or not all(map(math.isfinite, entries)):
            raise RenderError(f"{where} puts {part} at {entries}; expected 16 finite numbers")


def _entries(matrix: Any) -> list[float]:
    return [float(value) for row in matrix for value in row]
