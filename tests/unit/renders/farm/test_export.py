"""Job files: as each manager runs them, every item of the manifest is rendered exactly once.

Tasks run a stand-in that writes down which items they ask for.
"""

import json
import os
import shlex
import stat
import subprocess
import sys
from pathlib import Path

import pytest
import quickjs

from artgen.core.errors import UsageError
from blender_scripts.frame_ranges import asked, chosen
from renders.farm.export import JobFile, write_job

ROOT = Path(__file__).parents[4]
RECORDER = f"""
import os, sys
sys.path.insert(0, {str(ROOT)!r})
from blender_scripts.frame_ranges import asked, chosen
from artgen.farm_manifest import count_items
task = asked(sys.argv)
numbers = chosen(task.stated, os.environ, count_items(task.manifest))
with (task.manifest.parent / "record").open("a") as record:
    record.write(" ".join(map(str, numbers)) + "\\n")
"""
ITEMS, CHUNK = 11, 4
CHUNKS = [[0, 1, 2, 3], [4, 5, 6, 7], [8, 9, 10]]


@pytest.fixture
def job(tmp_path: Path) -> JobFile:
    """Of 11 items in chunks of 4, in a folder whose name has a space."""
    folder = tmp_path / "a farm"
    folder.mkdir()
    (folder / "manifest.jsonl").write_text("{}\n" * ITEMS)
    (folder / "recorder.py").write_text(RECORDER)
    blender = folder / "blender"
    call = shlex.join([sys.executable, str(ROOT / "tests" / "stand_in_blender.py")])
    blender.write_text(f'#!/bin/sh\nexec {call} "$@"\n')
    blender.chmod(blender.stat().st_mode | stat.S_IXUSR)
    return JobFile(
        manifest=folder / "manifest.jsonl",
        blender=str(blender),
        script=folder / "recorder.py",
        chunk=CHUNK,
    )


def recorded(job: JobFile) -> list[list[int]]:
    lines = (job.manifest.parent / "record").read_text().splitlines()
    return sorted([int(word) for word in line.split()] for line in lines)


def items_of(words: list[str]) -> list[int]:
    return chosen(asked(words).stated, {}, ITEMS)


def test_slurm_renders_every_item_once(job: JobFile, tmp_path: Path) -> None:
    """bash runs the script as SLURM would, once for each task that it asks for."""
    (script,) = write_job("slurm", job, tmp_path / "job.sh")
    text = script.read_text()
    assert "#SBATCH --requeue\n" in text
    assert "#SBATCH --array=0-2\n" in text
    subprocess.run(["bash", "-n", str(script)], check=True)
    for task in range(3):
        subprocess.run(
            ["bash", str(script)],
            env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task), "SLURM_CPUS_PER_TASK": "2"},
            check=True,
        )
    assert recorded(job) == CHUNKS


def test_slurm_passes_on_the_exit_code(job: JobFile, tmp_path: Path) -> None:
    job.script.write_text("raise ValueError")
    (script,) = write_job("slurm", job, tmp_path / "job.sh")
    told = subprocess.run(
        ["bash", str(script)],
        env={**os.environ, "SLURM_ARRAY_TASK_ID": "0"},
        check=False,
        capture_output=True,
    )
    assert told.returncode == 1


def test_openjd_renders_every_item_once(job: JobFile, tmp_path: Path) -> None:
    """By `openjd run`, the reference implementation, on this machine."""
    (template,) = write_job("openjd", job, tmp_path / "job.yaml")
    openjd = str(Path(sys.executable).with_name("openjd"))
    subprocess.run([openjd, "check", str(template)], check=True)
    subprocess.run([openjd, "run", str(template), "--step", "render"], check=True)
    assert recorded(job) == CHUNKS


@pytest.mark.parametrize("program", ["python", "pycuerun"])
def test_opencue_renders_every_item_once(job: JobFile, tmp_path: Path, program: str) -> None:
    """By pyoutline's local backend. Its wrapper of frames wants tcsh and a studio's `setshot`, so
    ours takes its place: it runs `pycuerun SESSION -e FRAME-LAYER`, without the version and
    repository of a studio."""
    (outline,) = write_job("opencue", job, tmp_path / "job.py")
    wrapper = tmp_path / "local_wrap_frame"
    wrapper.write_text('#!/bin/sh\neval "$4 $5"\n')
    wrapper.chmod(0o755)
    programs = Path(sys.executable).parent
    (tmp_path / "outline.cfg").write_text(
        f"[outline]\nhome = {tmp_path}\nsession_dir = {tmp_path}/sessions\nuser_dir = {tmp_path}\n"
        f"wrapper_dir = {tmp_path}\nbin_dir = {programs}\nbackend = local\nfacility = local\n"
        "domain = example.com\nspec_version = 1.15\nmaxretries = 2\ndefault_show = testing\n"
        "default_shot = default\n"
    )
    told = subprocess.run(
        [str(programs / program), str(outline)],
        env={**os.environ, "OUTLINE_CONFIG_FILE": str(tmp_path / "outline.cfg")},
        check=True,
        capture_output=True,
        text=True,
    )
    assert recorded(job) == CHUNKS, told.stdout + told.stderr


def test_flamenco_renders_every_item_once(job: JobFile, tmp_path: Path) -> None:
    """The job type runs in a JavaScript engine, with the Manager's `author` written down."""
    (script,) = write_job("flamenco", job, tmp_path / "job.js")
    tasks = compiled(script)
    assert [task["type"] for task in tasks] == ["blender"] * 3
    commands = [command for task in tasks for command in task["commands"]]
    assert {command["name"] for command in commands} == {"exec"}
    assert {command["args"]["exe"] for command in commands} == {job.blender}
    assert [items_of(command["args"]["args"]) for command in commands] == CHUNKS


def compiled(script: Path) -> list[dict[str, object]]:
    """The tasks of a job whose settings are the type's defaults."""
    context = quickjs.Context()
    context.eval(
        """
        const author = {
          Task: (name, type) => ({name, type, commands: [],
                                  addCommand(command) { this.commands.push(command); }}),
          Command: (name, args) => ({name, args}),
        };
        """
    )
    context.eval(script.read_text())
    return json.loads(
        context.eval(
            """
            const settings = {};
            for (const one of JOB_TYPE.settings) settings[one.key] = one.default;
            const tasks = [];
            compileJob({settings, addTask: (task) => tasks.push(task)});
            JSON.stringify(tasks);
            """
        )
    )


def test_deadline_renders_every_item_once(job: JobFile, tmp_path: Path) -> None:
    """Tags replaced as Deadline's manual says, for each chunk of the frame list."""
    info, plugin = write_job("deadline", job, tmp_path / "job.txt")
    assert plugin == tmp_path / "job_plugin.txt"
    stated, options = keys(info), keys(plugin)
    assert (stated["Plugin"], stated["Frames"], stated["ChunkSize"]) == ("CommandLine", "0-10", "4")
    assert options["Executable"] == job.blender
    tasks = []
    for start in range(0, ITEMS, CHUNK):
        end = min(start + CHUNK, ITEMS) - 1
        words = options["Arguments"].replace("<STARTFRAME>", str(start))
        tasks.append(items_of(shlex.split(words.replace("<ENDFRAME>", str(end)))))
    assert tasks == CHUNKS


def keys(path: Path) -> dict[str, str]:
    return dict(line.split("=", 1) for line in path.read_text().splitlines())


def test_a_python_with_the_wheel_gets_no_arguments_of_blender(job: JobFile) -> None:
    plain = JobFile(manifest=job.manifest, blender="python3", script=job.script, chunk=1)
    assert plain.command == ["python3", str(job.script), "--manifest", str(job.manifest)]
    assert job.command[1:6] == ["-b", "--factory-startup", "--python-exit-code", "1", "-P"]


def test_job_files_say_what_they_cannot_hold(job: JobFile, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="--chunk 0: expected at least 1"):
        JobFile(manifest=job.manifest, blender="blender", script=job.script, chunk=0)
    with pytest.raises(UsageError, match="without quotes and breaks"):
        JobFile(manifest=job.manifest, blender="blender\n-y", script=job.script, chunk=1)
    absent = JobFile(manifest=tmp_path / "no", blender="blender", script=job.script, chunk=1)
    with pytest.raises(UsageError, match="no: cannot be read"):
        write_job("slurm", absent, tmp_path / "job.sh")


def test_equal_jobs_give_equal_files(job: JobFile, tmp_path: Path) -> None:
    for kind in ("opencue", "slurm", "flamenco", "deadline", "openjd"):
        first = [path.read_bytes() for path in write_job(kind, job, tmp_path / "a")]
        assert [path.read_bytes() for path in write_job(kind, job, tmp_path / "a")] == first
