"""Settings: how a sample is rendered, and the named sets that ART trains on."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

Backend = Literal["cycles", "fast"]
CameraScheme = Literal["orbit", "ring", "sphere", "hemisphere"]
StateScheme = Literal["drawn", "trajectory"]
LightScheme = Literal["studio", "area", "sky", "softboxes"]
Extra = Literal["albedo", "roughness", "flow", "linear"]

MOST_VIEWS = 1024
"""Even spheres of views are picked from as many directions."""
MOST_STATES = 1024
MAX_TRAJECTORY = 32


@dataclass(frozen=True, kw_only=True)
class CameraSettings:
    """Where the cameras stand; every deviation is off unless asked for.

    Attributes:
        scheme: `orbit` around the front; `ring` at even azimuths; `sphere` all around, Fibonacci;
            `hemisphere` over the front half.
        fov: (least, greatest) across the image, rad; drawn for every view.
        look_at: greatest deviation of the point looked at, in radii of the object.
        dolly: greatest share by which a camera comes nearer or goes farther than framing asks.
        principal: greatest offset of the principal point, as after cropping, in widths.
        rotation_noise: standard deviation of the stated orientation, rad.
        position_noise: standard deviation of the stated position, in radii of the object.
    """

    scheme: CameraScheme = "orbit"
    fov: tuple[float, float] = (0.45, 0.84)
    look_at: float = 0.0
    dolly: float = 0.0
    principal: float = 0.0
    rotation_noise: float = 0.0
    position_noise: float = 0.0


@dataclass(frozen=True, kw_only=True)
class SensorSettings:
    """What a real camera adds after rendering; each is off at zero and has its own stream.

    Attributes:
        exposure: greatest deviation, stops.
        white_balance: greatest gain of red against blue, as a share.
        noise: standard deviation at middle gray, in 8-bit codes.
        blur: greatest radius of defocus, px.
        jpeg: quality 1 to 100; 0 stores what was rendered.
    """

    exposure: float = 0.0
    white_balance: float = 0.0
    noise: float = 0.0
    blur: float = 0.0
    jpeg: int = 0


@dataclass(frozen=True, kw_only=True)
class Settings:
    """How many images, how large, how clean, of what, under which light.

    Attributes:
        views: cameras.
        states: joint states.
        size: width and height, px.
        accuracy: a preset's name, decibels such as `35dB`, or paths a pixel such as `16spp`.
        motion: `drawn` states, or a smooth `trajectory` through them.
        ground: catch shadows on a floor.
        motion_blur: share of a state's interval for which the shutter is open; 0 is a still.
        extras: images beyond those that every sample has.
    """

    views: int = 4
    states: int = 2
    size: int = 128
    accuracy: str = "standard"
    backend: Backend = "cycles"
    motion: StateScheme = "drawn"
    light: LightScheme = "studio"
    ground: bool = False
    motion_blur: float = 0.0
    extras: tuple[Extra, ...] = ()
    cameras: CameraSettings = field(default_factory=CameraSettings)
    sensor: SensorSettings = field(default_factory=SensorSettings)


PRESETS: Mapping[str, Settings] = {
    "multiview": Settings(views=4, states=2),
    "monocular": Settings(views=1, states=2),
    "trajectory": Settings(views=1, states=16, motion="trajectory"),
}
"""What ART trains on: V = 4, T = 2; V = 1, T = 2; articulated object sequences."""
