"""Settings are refused in words that name the option, what was found and what was expected."""

import dataclasses
import math
import re
from operator import attrgetter

import pytest

from artgen.core.errors import UsageError
from renders.settings import (
    BOUNDS,
    MAX_TRAJECTORY,
    PRESETS,
    CameraSettings,
    Settings,
    checked,
)


def changed(option: str, value: object) -> Settings:
    group, _, name = option.rpartition(".")
    if not group:
        return dataclasses.replace(Settings(), **{name: value})
    inner = dataclasses.replace(getattr(Settings(), group), **{name: value})
    return dataclasses.replace(Settings(), **{group: inner})


@pytest.mark.parametrize("settings", [Settings(), *PRESETS.values()])
def test_defaults_and_presets_are_fit(settings: Settings) -> None:
    assert checked(settings) is settings


@pytest.mark.parametrize("option", BOUNDS)
@pytest.mark.parametrize("value", ["below", "above", math.nan, math.inf])
def test_every_bound_is_told(option: str, value: object) -> None:
    least, greatest, unit = BOUNDS[option]
    wrong = {"below": least - 1, "above": greatest + 1}.get(str(value), value)
    said = f"--{option.replace('_', '-')} {wrong}: expected {least:g} to {greatest:g} {unit}"
    with pytest.raises(UsageError, match=re.escape(said)):
        checked(changed(option, wrong))


@pytest.mark.parametrize(
    "option", sorted(name for name in BOUNDS if not name.startswith(("motion_blur", "sensor")))
)
def test_the_bounds_themselves_are_fit(option: str) -> None:
    for value in BOUNDS[option][:2]:
        assert attrgetter(option)(checked(changed(option, value))) == value


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (changed("backend", "eevee"), "--backend eevee: expected one of cycles, fast"),
        (changed("cameras.scheme", "cube"), "--cameras.scheme cube: expected one of orbit, ring"),
        (changed("cameras.fov", (0.8, 0.4)), "--cameras.fov 0.8 0.4: expected a least and"),
        (changed("cameras.fov", (45.0, 60.0)), "these are 2578, 3438 degrees"),
        (changed("cameras.fov", (math.nan, 0.4)), "--cameras.fov nan 0.4"),
        (changed("extras", ("flow", "flow")), "--extras flow flow: expected each at most once"),
        (changed("motion_blur", 0.5), "--motion-blur 0.5: expected 0, or --motion trajectory"),
        (
            Settings(motion="trajectory", states=MAX_TRAJECTORY + 1),
            "--states 33: expected 2 to 32 frames of a trajectory",
        ),
        (Settings(motion="trajectory", states=1), "--states 1: expected 2 to 32"),
    ],
)
def test_contradictions_are_told(settings: Settings, said: str) -> None:
    with pytest.raises(UsageError, match=re.escape(said)):
        checked(settings)


def test_cameras_deviate_only_if_asked() -> None:
    off = CameraSettings()
    assert {off.look_at, off.dolly, off.principal, off.rotation_noise, off.position_noise} == {0.0}
