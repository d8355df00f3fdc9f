"""Strangers' files: all formats tell the same object, and what is wrong in one is named."""

import dataclasses
import math
import shutil
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.articulation.types import Limit
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.export.layout import MJCF, URDF, USD
from artgen.validate import validate_asset, validate_bundle
from artgen.validate.bounds import shipped_bounds
from artgen.validate.levels import Selection
from artgen.validate.read import read_subject
from artgen.validate.report import Report
from artgen.validate.second_opinion import pinocchio
from artgen.validate.subject import Source, Subject
from artgen.validate.urdf_subject import UrdfSubject
from tests.exported import write_without_blender
from tests.unit.validate.cabinet import HINGE, cupboard, write_quick_bundle
from tests.unit.validate.edits import Edit, in_mjcf, in_urdf, replaced, without

FORMATS = {".urdf": "urdf", ".xml": "mjcf", ".usdc": "usd"}
ROUNDED = {URDF: 1e-12, MJCF: 2e-7, USD: 2e-7}
"""Relative; MuJoCo keeps mesh vertices, and USD everything, in float32 of 6e-8."""


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_without_blender(cupboard(), tmp_path_factory.mktemp("written") / "cupboard")


def source(file: Path) -> Source:
    return Source(format=FORMATS[file.suffix], file=file, root=file.parent)


def subject(file: Path) -> Subject:
    return read_subject(source(file), shipped_bounds())


def verdict(file: Path, profile: str = "full") -> Report:
    return validate_asset(source(file), Selection(profile=profile), shipped_bounds())


@pytest.mark.parametrize("file", [URDF, MJCF, USD])
def test_every_format_of_a_sound_object_is_valid(file: str, written: Path) -> None:
    report = verdict(written / file)
    assert [str(finding) for finding in report.findings] == []
    assert {"motion.overlap", "dynamics.settle", "compile.limit"} <= set(report.judged)


@pytest.mark.parametrize("file", [URDF, MJCF, USD])
def test_every_format_tells_the_same_object(file: str, written: Path) -> None:
    """Joints, masses, volumes and boxes, in the object frame."""
    read, made, rtol = subject(written / file), cupboard(), ROUNDED[file]
    names = {"world": "base"}
    masses = {names.get(part.name, part.name): part.mass for part in read.parts}
    joints = {joint.name: joint for joint in read.joints}
    for part in made.parts:
        mass, mesh = masses[part.name], read.meshes["world" if
            part.name == "base" and file == MJCF else part.name]  # fmt: skip
        assert mass is not None
        assert mass.mass == pytest.approx(part.mass.mass, rel=rtol)
        np.testing.assert_allclose(mass.center, part.mass.center, rtol=0, atol=rtol)
        np.testing.assert_allclose(mass.inertia, part.mass.inertia, rtol=0, atol=3 * rtol)
        np.testing.assert_allclose(mesh.bounds, part.mesh.bounds, rtol=0, atol=rtol)
    for joint in made.joints:
        found = joints[joint.name]
        assert (found.type, found.child) == (joint.type, joint.child)
        assert joint.limit is not None
        assert found.limit is not None
        assert found.limit.upper == pytest.approx(joint.limit.upper, rel=rtol)
        np.testing.assert_allclose(found.axis, joint.axis, rtol=0, atol=rtol)
        arm = np.subtract(found.origin, joint.origin)
        if joint.type == "revolute":  # Any point of the axis will do.
            assert np.linalg.norm(np.cross(arm, joint.axis)) <= rtol


def in_joint(name: str, path: str, key: str, value: str) -> Edit:
    return in_urdf(f"joint[@name='{name}']/{path}", key, value)


def in_link(name: str, path: str, key: str, value: str) -> Edit:
    return in_urdf(f"link[@name='{name}']/{path}", key, value)


def times(name: str, factor: float) -> Edit:
    """Every element of a link's tensor times a factor."""

    def edit(folder: Path) -> None:
        tree = ET.parse(folder / URDF)
        element = tree.find(f"link[@name='{name}']/inertial/inertia")
        assert element is not None
        element.attrib = {k: repr(float(v) * factor) for k, v in element.attrib.items()}
        tree.write(folder / URDF)

    return edit


FOREIGN: dict[str, tuple[str, str, Edit]] = {
    "file of another kind": ("files.readable", URDF, replaced(URDF, "robot", "thing")),
    "rotation of two numbers": (
        "structure.model", URDF, in_joint("slide", "origin", "rpy", "0 0"),
    ),
    "floating joint": (
        "structure.type", "slide (asset.urdf)", in_urdf("joint[@name='slide']", "type", "floating"),
    ),
    "rest out of reach": (
        "structure.rest", "slide (asset.urdf)", in_joint("slide", "limit", "lower", "0.1"),
    ),
    "lower above upper": (
        "structure.limit", "slide (asset.urdf)", in_joint("slide", "limit", "lower", "0.5"),
    ),
    "no limit at all": (
        "structure.limit", "slide (asset.urdf)", without("joint[@name='slide']/limit"),
    ),
    "degrees": ("structure.turn", "hinge (asset.urdf)", in_joint("hinge", "limit", "upper", "110")),
    "axis of 0.707": (
        "structure.axis", "hinge (asset.urdf)", in_joint("hinge", "axis", "xyz", "0 0.707 -0.707"),
    ),
    "no collision": ("structure.link", "drawer", without("link[@name='drawer']/collision")),
    "no mass": ("structure.link", "door", without("link[@name='door']/inertial")),
    "two roots": ("structure.tree", "base, door", without("joint[@name='hinge']")),
    "mesh without a file": (
        "files.readable", URDF, in_link("door", "visual/geometry/mesh", "filename", "none.obj"),
    ),
    "scale of zero": (
        "mesh.readable", "door, visual 0",
        in_link("door", "visual/geometry/mesh", "scale", "1 0 1"),
    ),
    "millimeters": (
        "mesh.size", "door", in_link("door", "visual/geometry/mesh", "scale", "1000 1000 1000"),
    ),
    "box without extent": (
        "mesh.readable", "door, collision 0",
        in_link("door", "collision/geometry/box", "size", "1 0 1"),
    ),
    "tensor ten times too large": ("inertia.extent", "door", times("door", 10.0)),
    "tensor ten times too small": ("inertia.uniform", "door", times("door", 0.1)),
    "a thousand times its mass": (
        "inertia.density", "door", in_link("door", "inertial/mass", "value", "4000"),
    ),
    "part of a gram in a ton": (
        "inertia.ratio", "drawer", in_link("drawer", "inertial/mass", "value", "4e-6"),
    ),
    "center elsewhere": (
        "inertia.center", "door", in_link("door", "inertial/origin", "xyz", "0 1 0"),
    ),
    "rests ajar": ("semantics.rest", "slide", in_joint("slide", "limit", "lower", "-0.1")),
    "axis three degrees off": (
        "semantics.tilt", "hinge",
        in_joint("hinge", "axis", "xyz", "0.05233595624294383 0 -0.9986295347545738"),
    ),
    "reversed axis": (
        "motion.overlap", "base, drawer", in_joint("slide", "axis", "xyz", "0 1 0"),
    ),
    "friction above effort": (
        "dynamics.open", "drawer", in_joint("slide", "dynamics", "friction", "70"),
    ),
    "friction above effort, closing": (
        "dynamics.close", "drawer", in_joint("slide", "dynamics", "friction", "70"),
    ),
}  # fmt: skip
"""Name to (check, subject of the finding, edit of the URDF)."""


@pytest.mark.parametrize("name", FOREIGN)
def test_a_defect_of_a_urdf_is_named(name: str, written: Path, tmp_path: Path) -> None:
    check, part, edit = FOREIGN[name]
    shutil.copytree(written, tmp_path / "copy")
    edit(tmp_path / "copy")
    report = verdict(tmp_path / "copy" / URDF)
    assert (check, part) in {(f.check, f.part) for f in report.findings}, report.findings


def untouchable(folder: Path) -> None:
    """Every geom is of type 0, which is in no other's affinity."""
    tree = ET.parse(folder / MJCF)
    for geom in tree.iterfind(".//geom[@class='collision']"):
        geom.set("contype", "0")
    tree.write(folder / MJCF)


def flag_off(folder: Path) -> None:
    """The file switches gravity off."""
    tree = ET.parse(folder / MJCF)
    option = tree.find("option")
    assert option is not None
    ET.SubElement(option, "flag", gravity="disable")
    tree.write(folder / MJCF)


MODELED: dict[str, tuple[str, str, Edit]] = {
    "drag that nothing told": ("dynamics.energy", "object", in_mjcf("option", "viscosity", "5")),
    "stop as soft as rubber": (
        "dynamics.stop", "drawer", in_mjcf(".//joint[@name='slide']", "solreflimit", "1 1"),
    ),
    "limit switched off": (
        "structure.limit",
        "slide (asset.xml)",
        in_mjcf(".//joint[@name='slide']", "limited", "false"),
    ),
    "geoms that meet none": ("structure.link", "drawer", untouchable),
    "gravity switched off": (
        "compile.effect", "asset.xml", flag_off,
    ),
    "ball joint": (
        "structure.type", "slide (asset.xml)", in_mjcf(".//joint[@name='slide']", "type", "ball"),
    ),
}  # fmt: skip
"""Name to (check, subject of the finding, edit of the MJCF)."""


@pytest.mark.parametrize("name", MODELED)
def test_a_defect_of_a_mjcf_is_named(name: str, written: Path, tmp_path: Path) -> None:
    check, part, edit = MODELED[name]
    shutil.copytree(written, tmp_path / "copy")
    edit(tmp_path / "copy")
    report = verdict(tmp_path / "copy" / MJCF)
    assert (check, part) in {(f.check, f.part) for f in report.findings}, report.findings


def test_a_part_that_must_stay_where_it_is_put_has_the_friction_for_it(tmp_path: Path) -> None:
    """A dishwasher's door that turns about a pin below: held, and let go near the horizontal."""
    for friction, held in ((30.0, True), (0.3, False)):
        flap = dataclasses.replace(
            HINGE, axis=(1.0, 0.0, 0.0), origin=(0.0, -0.182, 0.002), friction=friction,
            effort=100.0, limit=Limit(lower=0.0, upper=1.5),
        )  # fmt: skip
        made = dataclasses.replace(cupboard(hinge=flap), category="dishwasher")
        report = validate_bundle(write_quick_bundle(made, tmp_path / str(friction)))
        found = [f for f in report.findings if f.check == "dynamics.hold"]
        assert "dynamics.hold" in report.judged
        assert bool(found) != held
        assert all(f.state is not None and f.state["hinge"] > 1.2 for f in found)


def test_what_a_format_cannot_say_is_skipped_not_passed(written: Path) -> None:
    report = verdict(written / URDF)
    reasons = {skipped.name: skipped.reason for skipped in report.skipped}
    for name in ("files.hash", "structure.agreement", "inertia.integral", "semantics.order"):
        assert "urdf" in reasons[name]
        assert name not in report.judged


def test_a_drawer_behind_a_door_is_judged_with_the_door_open(tmp_path: Path) -> None:
    """The door reaches up over the drawer's front: the URDF cannot say so, the sweep finds it."""
    tall = (((-0.298, -0.24, 0.002), (0.298, -0.222, 0.698)),)
    hinge = dataclasses.replace(HINGE, origin=(-0.298, -0.222, 0.0))
    made = cupboard(door=(*tall, ((0.2, -0.245, 0.2), (0.21, -0.24, 0.35))), hinge=hinge)
    folder = write_without_blender(made, tmp_path / "tall")
    report = verdict(folder / URDF)
    told = [note.text.split(":")[0] for note in report.notes if "judged with" in note.text]
    assert told == [f"slide is judged with hinge = {math.radians(110):.4g}"]
    assert not {f.check for f in report.findings} & {"motion.collision", "motion.overlap"}


@dataclasses.dataclass(frozen=True, kw_only=True, eq=False)
class Twofold(UrdfSubject):
    """A URDF that tells pinocchio of another mass than MuJoCo."""

    @property
    def urdf_text(self) -> str:
        return super().urdf_text.replace('<mass value="', '<mass value="1')


def test_what_pinocchio_reads_otherwise_is_named(written: Path) -> None:
    """All three agree on every file we know of, so the difference is made here."""
    two = Twofold(source=source(written / URDF), bounds=shipped_bounds())
    assert {finding.part for finding in pinocchio(two)} == {"mass matrix"}
    assert list(pinocchio(UrdfSubject(source=two.source, bounds=two.bounds))) == []


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10**6))
def test_random_chains_are_read_alike_by_all(
    seed: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Turned origins, axes and tensors, fixed joints between: our reader, MuJoCo and pinocchio
    agree on poses, masses, mass matrix and gravity to 1e-12."""
    path = tmp_path_factory.mktemp("chain") / "chain.urdf"
    path.write_text(random_chain(Stream(seed, "chain").generator()))
    report = verdict(path)
    checks = {"motion.kinematics", "motion.pinocchio", "compile.mass"}
    assert checks <= set(report.judged), report
    assert not checks & {finding.check for finding in report.findings}, report.findings


def random_chain(rng: np.random.Generator) -> str:
    """A tree of six links with random frames; every third joint is fixed."""
    robot = ET.Element("robot", name="chain")
    for k in range(6):
        link = ET.SubElement(robot, "link", name=f"link{k}")
        inertial = ET.SubElement(link, "inertial")
        ET.SubElement(
            inertial, "origin", xyz=text(rng.normal(size=3)), rpy=text(rng.normal(size=3))
        )
        ET.SubElement(inertial, "mass", value=text(rng.uniform(0.1, 10.0, size=1)))
        a, b, c = rng.uniform(0.1, 1.0, size=3)
        tensor = {"ixx": b + c, "iyy": a + c, "izz": a + b, "ixy": 0.0, "ixz": 0.0, "iyz": 0.0}
        ET.SubElement(inertial, "inertia", {key: repr(float(v)) for key, v in tensor.items()})
        if k == 0:
            continue
        kind = ("fixed", "revolute", "prismatic")[k % 3]
        joint = ET.SubElement(robot, "joint", name=f"joint{k}", type=kind)
        ET.SubElement(
            joint, "origin", xyz=text(rng.normal(size=3)), rpy=text(3 * rng.normal(size=3))
        )
        ET.SubElement(joint, "parent", link=f"link{int(rng.integers(k))}")
        ET.SubElement(joint, "child", link=f"link{k}")
        axis = rng.normal(size=3)
        ET.SubElement(joint, "axis", xyz=text(axis / np.linalg.norm(axis)))
        ET.SubElement(joint, "limit", lower="-1", upper="1", effort="10", velocity="1")
    return ET.tostring(robot, encoding="unicode")


def text(values: Floats) -> str:
    return " ".join(repr(float(value)) for value in values)
