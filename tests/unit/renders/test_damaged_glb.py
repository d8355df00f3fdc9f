"""A GLB that cannot be rendered right is told by name; the worker goes on."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from artgen.core.errors import WorkerError
from artgen.core.jsonio import plain
from artgen.render_job import RenderJob
from artgen.worker import BlenderWorker
from blender_scripts.glb import read_glb, write_glb
from renders.effects.scenes import PLAIN, scene_job, write_scene

pytestmark = pytest.mark.blender


@pytest.fixture
def job(blender: BlenderWorker, tmp_path: Path) -> RenderJob:
    glb = write_scene(PLAIN, tmp_path, blender)
    return scene_job(PLAIN, glb, tmp_path, size=16, samples=1)


def fault(blender: BlenderWorker, job: RenderJob) -> str:
    with pytest.raises(WorkerError) as raised:
        blender.run(plain(job), timeout_s=60)
    return str(raised.value).partition("; the log")[0]


def test_a_file_that_is_no_glb_is_named(job: RenderJob, blender: BlenderWorker) -> None:
    Path(job.glb).write_bytes(b"no GLB at all")
    said = fault(blender, job)
    assert f"{job.glb} cannot be imported" in said
    assert "write it anew" in said


def test_a_missing_texture_is_named(job: RenderJob, blender: BlenderWorker) -> None:
    document: dict[str, Any]
    document, binary = read_glb(Path(job.glb))
    document["images"] = [{"name": "gone", "uri": "gone.png"}]
    document["textures"] = [{"source": 0}]
    pbr = document["materials"][0].setdefault("pbrMetallicRoughness", {})
    pbr["baseColorTexture"] = {"index": 0}
    write_glb(Path(job.glb), document, binary)
    said = fault(blender, job)
    assert job.glb in said
    assert "gone" in said


def test_parts_that_the_file_lacks_are_named(job: RenderJob, blender: BlenderWorker) -> None:
    more = {**job.states[0], "handle": np.eye(4)}
    said = fault(blender, replace(job, states=(more,)))
    assert "'handle'" in said
    assert job.glb in said


def test_a_shot_of_no_part_is_named(job: RenderJob, blender: BlenderWorker) -> None:
    shot = replace(job.shots[0], part="lid")
    said = fault(blender, replace(job, shots=(shot,)))
    assert "shot view.exr shows 'lid'" in said
    assert "stage, subject" in said
