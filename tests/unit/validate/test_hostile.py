"""Whatever a file holds, it gets a verdict: no crash, no endless wait, nothing read outside."""

import os
import shutil
import struct
from itertools import pairwise
from pathlib import Path

import pytest

from artgen.export.layout import MJCF, URDF
from artgen.validate import validate_asset
from artgen.validate.batch import Task, judge_all
from artgen.validate.bounds import shipped_bounds
from artgen.validate.levels import Selection
from artgen.validate.report import Report
from artgen.validate.subject import Source
from tests.unit.validate.cabinet import cupboard, write_quick_bundle
from tests.unit.validate.fuzz import fuzzed

FORMATS = {".urdf": "urdf", ".xml": "mjcf", ".usda": "usd"}


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = write_quick_bundle(cupboard(), tmp_path_factory.mktemp("sound") / "bundle")
    (folder / "manifest.json").unlink()
    return folder


def source(file: Path, root: Path | None = None) -> Source:
    return Source(format=FORMATS[file.suffix], file=file, root=root or file.parent)


def verdict(file: Path, root: Path | None = None) -> Report:
    return validate_asset(source(file, root), Selection(), shipped_bounds())


def test_sound_files_are_valid(sound: Path) -> None:
    for file in (URDF, MJCF):
        assert [str(f) for f in verdict(sound / file).findings] == []


@pytest.mark.parametrize(
    ("file", "number"), [*((URDF, k) for k in range(10)), *((MJCF, k) for k in range(3))]
)
def test_fuzzed_files_get_a_verdict(file: str, number: int, sound: Path, tmp_path: Path) -> None:
    """Two hundred URDFs and sixty MJCFs; some are harmless, as junk in a name nothing refers to."""
    reports = [
        verdict(fuzzed(sound, tmp_path / str(k), file, k))
        for k in range(20 * number, 20 * number + 20)
    ]
    assert sum(not report.ok for report in reports) >= 10


LAUGHS = (
    '<!DOCTYPE robot [<!ENTITY a "aaaaaaaaaa">'
    + "".join(f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in pairwise("abcdefghi"))
    + ']><robot name="r"><link name="&i;"/></robot>'
)  # fmt: skip
ELSEWHERE = '<!DOCTYPE robot [<!ENTITY a SYSTEM "file:///etc/passwd">]><robot name="&a;"/>'


@pytest.mark.parametrize("text", [LAUGHS, ELSEWHERE])
@pytest.mark.parametrize("name", ["x.urdf", "x.xml"])
def test_entities_are_refused_unread(text: str, name: str, tmp_path: Path) -> None:
    """A billion laughs take no memory, and no file of the machine enters a report."""
    (tmp_path / name).write_text(text)
    (finding,) = verdict(tmp_path / name).findings
    assert finding.check == "files.readable"
    assert "document type" in str(finding.value)


@pytest.fixture
def outside(tmp_path: Path) -> Path:
    """A pipe beside the asset's folder: whoever opens it waits for ever."""
    os.mkfifo(tmp_path / "secret.obj")
    (tmp_path / "asset").mkdir()
    (tmp_path / "asset" / "link.obj").symlink_to(tmp_path / "secret.obj")
    return tmp_path / "asset"


URDF_TEXT = (
    '<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" '
    'ixy="0" ixz="0" iyz="0"/></inertial><{kind}><geometry><mesh filename="{path}"/></geometry>'
    "</{kind}></link></robot>"
)
MJCF_TEXTS = (
    '<mujoco><include file="{path}"/></mujoco>',
    '<mujoco><asset><mesh name="m" file="{path}"/></asset><worldbody/></mujoco>',
    '<mujoco><asset><texture type="2d" name="m" file="{path}"/></asset><worldbody/></mujoco>',
    '<mujoco><asset><hfield name="m" file="{path}"/></asset><worldbody/></mujoco>',
    '<mujoco><asset><model name="m" file="{path}"/></asset><worldbody/></mujoco>',
    '<mujoco><worldbody><flexcomp name="f" type="mesh" file="{path}"/></worldbody></mujoco>',
)
PATHS = ("../secret.obj", "{up}/secret.obj", "link.obj", "file://{up}/secret.obj",
         "package://../secret.obj", "package://asset/../secret.obj", "meshes/../../secret.obj",
         "..\\secret.obj", "missing.obj", "")  # fmt: skip


@pytest.mark.parametrize("path", PATHS)
def test_nothing_is_read_outside_the_folder(path: str, outside: Path) -> None:
    named = path.format(up=outside.parent)
    texts = [(f"{kind}.urdf", URDF_TEXT.format(kind=kind, path=named)) for kind in
             ("visual", "collision")]  # fmt: skip
    texts += [(f"{k}.xml", text.format(path=named)) for k, text in enumerate(MJCF_TEXTS)]
    for name, text in texts:
        (outside / name).write_text(text)
        report = verdict(outside / name)
        assert {f.check for f in report.findings} == {"files.readable"}, (name, report.findings)


def test_a_mesh_folder_that_leads_outside_is_refused(outside: Path) -> None:
    text = MJCF_TEXTS[1].format(path="secret.obj").replace(
        "<asset>", '<compiler meshdir=".."/><asset>'
    )  # fmt: skip
    (outside / "m.xml").write_text(text)
    assert {f.check for f in verdict(outside / "m.xml").findings} == {"files.readable"}


@pytest.mark.parametrize(
    "header", ['subLayers = [@{p}@]', 'prepend references = @{p}@', 'prepend payload = @{p}@']
)  # fmt: skip
def test_layers_outside_the_folder_are_not_composed(header: str, outside: Path) -> None:
    for path in ("../secret.usda", f"{outside.parent}/secret.usda"):
        if not (outside.parent / "secret.usda").exists():
            os.mkfifo(outside.parent / "secret.usda")
        meta = header.format(p=path)
        text = f"#usda 1.0\n({meta})\n" if "sub" in meta else f'#usda 1.0\ndef "a" ({meta}) {{}}\n'
        (outside / "x.usda").write_text(text)
        assert {f.check for f in verdict(outside / "x.usda").findings} == {"files.readable"}


def test_files_beside_the_file_are_read_under_a_wider_root(sound: Path, tmp_path: Path) -> None:
    """ROS packages keep URDF and meshes in folders side by side."""
    package = tmp_path / "pack"
    shutil.copytree(sound, package)
    (package / "urdf").mkdir()
    text = (package / URDF).read_text().replace('filename="', 'filename="package://pack/')
    (package / "urdf" / "x.urdf").write_text(text)
    assert verdict(package / "urdf" / "x.urdf", root=package).ok
    assert not verdict(package / "urdf" / "x.urdf").ok


def test_counts_that_promise_more_than_there_is_are_refused(tmp_path: Path) -> None:
    """Four thousand million triangles in 84 bytes of STL; a million vertices that are not there."""
    (tmp_path / "m.stl").write_bytes(bytes(80) + struct.pack("<I", 2**32 - 1))
    (tmp_path / "m.obj").write_text("v 0 0 0\nf 1 1000000 2000000\n")
    for mesh in ("m.stl", "m.obj"):
        (tmp_path / "x.urdf").write_text(URDF_TEXT.format(kind="visual", path=mesh))
        report = verdict(tmp_path / "x.urdf")
        assert "mesh.readable" in {f.check for f in report.findings}


def test_depth_and_number_of_elements_are_capped(tmp_path: Path) -> None:
    for text in ("<robot>" * 100_000, "<robot>" + "<link/>" * 300_000 + "</robot>"):
        (tmp_path / "x.urdf").write_text(text)
        (finding,) = verdict(tmp_path / "x.urdf").findings
        assert finding.check == "files.readable"


def test_an_asset_that_takes_too_long_costs_its_own_verdict_alone(
    sound: Path, tmp_path: Path
) -> None:
    """Two thousand copies of every collision piece take many seconds to judge; the limit is one."""
    crowd = tmp_path / "crowd"
    shutil.copytree(sound, crowd)
    lines = []
    for line in (crowd / URDF).read_text().split("<collision"):
        head, end, tail = line.partition("</collision>")
        lines.append("<collision".join([""] + [head + end] * 2000) + tail if end else line)
    (crowd / URDF).write_text("".join(lines))
    task = Task(
        source=source(crowd / URDF),
        selection=Selection(),
        bounds=shipped_bounds(),
        kept=None,
        drawn=False,
    )
    (judgement,) = judge_all([task], workers=1, limit_s=1.0)
    assert [finding.check for finding in judgement.report.findings] == ["files.survives"]
