"""A perfect cabinet, and photographs of it, made once for the tests of this folder."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from model.reconstruct.assemble import Assembled, Wishes, assemble
from model.reconstruct.capture import Capture, read_capture
from model.reconstruct.guess import ObjectGuess
from model.reconstruct.outlines import Silhouettes, silhouettes
from model.reconstruct.rig import read_rig
from model.reconstruct.sight import network_images
from tests.unit.model.reconstruct.perfect import RADIUS, cabinet, sphere
from tests.unit.model.reconstruct.studio import STATES, photographed


@pytest.fixture(scope="session")
def perfect() -> Assembled:
    """Door and drawer fit."""
    return assemble(cabinet(), Wishes(asset_id="perfect"))


@pytest.fixture(scope="session")
def photographs(perfect: Assembled, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two states by four views of it, and cameras.json; nobody may write there."""
    return photographed(perfect, tmp_path_factory.mktemp("photographs"))


@pytest.fixture(scope="session")
def capture(photographs: Path) -> Capture:
    """What is read of them."""
    return read_capture(photographs, read_rig(photographs / "cameras.json", photographs))


@pytest.fixture(scope="session")
def seen(perfect: Assembled, capture: Capture) -> Silhouettes:
    """Their silhouettes at the size at which predictions are judged."""
    images = network_images(capture, sphere(perfect), size=48, background="white")
    return silhouettes(images, RADIUS)


@pytest.fixture(scope="session")
def guess() -> ObjectGuess:
    """The cabinet as it would be predicted, in the states of the photographs."""
    found = cabinet()
    joints = [
        dataclasses.replace(
            joint, observed=np.array([state[f"part_{joint.slot}_joint"] for state in STATES])
        )
        for joint in found.joints
    ]
    return dataclasses.replace(found, joints=tuple(joints))
