"""RenderJob: what Blender is asked to render, as plain data.

Standard library alone: Blender's own Python on a render farm need not have anything else.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Self

from artgen.core.stated_camera import StatedCamera

Color = tuple[float, float, float]
Point = tuple[float, float, float]
Prefilter = Literal["none", "fast", "accurate"]
DenoiseQuality = Literal["high", "balanced", "fast"]


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
class Transport:
    """Which light transport is computed; what a scene does not call for is off.

    Attributes:
        diffuse: bounces; 0 renders direct light alone.
        glossy: bounces.
        transmission: bounces inside refracting bodies; 0 without any.
        transparent: panes that a ray may cross.
        clamp_indirect: largest indirect contribution of one path, linear.
        panes: surfaces that are rendered as thin glass.
    """

    diffuse: int
    glossy: int
    transmission: int
    transparent: int
    clamp_indirect: float
    panes: tuple[ThinGlass, ...]


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
    kind: str = field(default="render")

    @classmethod
    def from_plain(cls, job: Mapping[str, Any]) -> Self:
        """The job that `plain` turned into JSON."""
        rig, transport = job["rig"], job["transport"]
        typed = {
            "cameras": tuple(_camera(camera) for camera in job["cameras"]),
            "states": tuple(job["states"]),
            "rig": LightRig(
                name=rig["name"],
                lights=tuple(AreaLight(**light) for light in rig["lights"]),
                sky=Sky(**rig["sky"]),
                environment=rig["environment"] and Environment(**rig["environment"]),
                ground=rig["ground"] and Ground(**rig["ground"]),
            ),
            "transport": Transport(
                **{**transport, "panes": tuple(ThinGlass(**pane) for pane in transport["panes"])}
            ),
            "shots": tuple(Shot(**shot) for shot in job["shots"]),
        }
        return cls(**{**job, **typed})


def _camera(stated: Mapping[str, Any]) -> StatedCamera:
    a, b, c, d = (tuple(row) for row in stated["camera_from_world"])
    return StatedCamera(
        focal=stated["focal"],
        principal=tuple(stated["principal"]),
        size=tuple(stated["size"]),
        camera_from_world=(a, b, c, d),
    )
