"""Settings: how a sample is rendered, and the named sets that ART trains on."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from operator import attrgetter
from typing import Any, Literal, get_args

from artgen.core.errors import UsageError

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
        scheme: `orbit`, mostly around the front; `ring`, all around at even azimuths; `sphere`, all
            around and above; `hemisphere`, the front half of it.
        fov: Least and greatest angle of view across the image, rad; drawn for every view. 0.45 is a
            75 mm lens on a square of 35 mm film's height, 0.84 a 40 mm lens.
        look_at: By how much a camera may look past the middle of the object, right, left, up and
            down, in radii of the object. The object stays inside the image.
        dolly: By what share of its distance a camera may come nearer or go farther than framing
            asks. The object stays inside the image.
        principal: By how much the principal point may lie off the middle of the image, in widths,
            as after cropping. The object stays inside the image.
        rotation_noise: Standard deviation of the orientation that samples state beside the true
            one, about each axis, rad.
        position_noise: Standard deviation of the position that samples state beside the true one,
            along each axis, in radii of the object.
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
        exposure: Greatest deviation, stops.
        white_balance: Greatest gain of red against blue, as a share.
        noise: Standard deviation at middle gray, in 8-bit codes.
        blur: Greatest radius of defocus, px.
        jpeg: Quality 1 to 100 of a compression that images go through; 0 leaves it out.
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
        views: Cameras (V), the same in every state.
        states: Joint states (T); the first of several is rest.
        size: Width and height of an image, px.
        accuracy: draft, standard, high or reference; decibels such as `35dB`; or paths a pixel such
            as `16spp`.
        backend: `cycles` traces paths; `fast` draws by OpenGL, for previews and pre-training.
        motion: `drawn` states, each on its own, or frames of one smooth `trajectory` that obeys
            limits and preconditions at all times.
        light: Kind of light that each asset draws its own of.
        ground: Catch the object's shadow on a floor.
        motion_blur: Share of the time between two frames of a trajectory for which the shutter is
            open; 0 is a still.
        extras: Images beyond those that every sample has.
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

BOUNDS: Mapping[str, tuple[float, float, str]] = {
    "views": (1, MOST_VIEWS, "cameras"),
    "states": (1, MOST_STATES, "joint states"),
    "size": (16, 8192, "px"),
    "motion_blur": (0, 1, "of a state's interval"),
    "cameras.look_at": (0, 10, "radii of the object"),
    "cameras.dolly": (0, 0.95, "of the distance"),
    "cameras.principal": (0, 3, "widths of the image"),
    "cameras.rotation_noise": (0, 1, "rad"),
    "cameras.position_noise": (0, 1, "radii of the object"),
    "sensor.exposure": (0, 10, "stops"),
    "sensor.white_balance": (0, 0.9, "of a channel"),
    "sensor.noise": (0, 128, "codes of 255"),
    "sensor.blur": (0, 64, "px"),
    "sensor.jpeg": (0, 100, "quality"),
}
"""Option to (least, greatest, unit); outside, nobody means it."""
FOV_BOUNDS = (0.02, 2.8)
"""rad: lenses of 1800 mm and 3 mm on a square of 35 mm film's height."""
NAMES: Mapping[str, tuple[str, ...]] = {
    "backend": get_args(Backend),
    "motion": get_args(StateScheme),
    "light": get_args(LightScheme),
    "cameras.scheme": get_args(CameraScheme),
}


def checked(settings: Settings) -> Settings:
    """The settings, if they can be rendered.

    Raises:
        UsageError: an option is out of bounds, or two contradict each other; told by the option's
            name, what was found and what was expected.
    """
    for option, (least, greatest, unit) in BOUNDS.items():
        value = attrgetter(option)(settings)
        if not least <= value <= greatest:
            raise _unfit(option, value, f"{least:g} to {greatest:g} {unit}")
    for option, known in NAMES.items():
        if (value := attrgetter(option)(settings)) not in known:
            raise _unfit(option, value, f"one of {', '.join(known)}")
    _check_fov(settings.cameras.fov)
    _check_extras(settings.extras)
    if settings.motion == "trajectory" and not 2 <= settings.states <= MAX_TRAJECTORY:
        raise _unfit("states", settings.states, f"2 to {MAX_TRAJECTORY} frames of a trajectory")
    if settings.motion_blur and settings.motion != "trajectory":
        raise _unfit(
            "motion_blur", settings.motion_blur, "0, or --motion trajectory: drawn states have no "
            "motion between them"
        )  # fmt: skip
    for option in ("ground", "motion_blur"):
        if settings.backend == "fast" and (value := getattr(settings, option)):
            raise _unfit(option, value, "--backend cycles: the fast backend leaves it out")
    return settings


def _check_fov(fov: tuple[float, float]) -> None:
    least, greatest = fov
    if not FOV_BOUNDS[0] <= least <= greatest <= FOV_BOUNDS[1]:
        bounds = f"from {FOV_BOUNDS[0]:g} to {FOV_BOUNDS[1]:g} rad across the image"
        degrees = ", ".join(f"{math.degrees(value):.4g}" for value in fov)
        raise _unfit(
            "cameras.fov", f"{least:g} {greatest:g}", f"a least and a greatest {bounds}; "
            f"these are {degrees} degrees"
        )  # fmt: skip


def _check_extras(extras: tuple[str, ...]) -> None:
    known = get_args(Extra)
    if len(set(extras)) != len(extras) or not set(extras) <= set(known):
        raise _unfit("extras", " ".join(extras), f"each at most once of {', '.join(known)}")


def _unfit(option: str, found: Any, expected: str) -> UsageError:
    return UsageError(f"--{option.replace('_', '-')} {found}: expected {expected}")
