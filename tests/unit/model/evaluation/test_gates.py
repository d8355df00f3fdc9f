"""Gates: what holds and what does not, in URDFs made for each."""

from pathlib import Path

import pytest

from artgen.validate.subject import Source
from model.evaluation.gates import Gates, gates, held_against


def drawer(tmp_path: Path, *, joint: str = "", contact: str = "", mass: str = "1") -> Gates:
    """A box that slides out of another one; parts of it can be spoiled."""
    limits = joint or '<limit lower="0" upper="0.3" effort="30" velocity="1"/>'
    boxes = contact or '<collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision>'
    inertial = (
        f'<inertial><mass value="{mass}"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" '
        'iyz="0" izz="0.01"/></inertial>'
    )
    text = f"""<robot name="r"><link name="base">{inertial}<collision>
      <origin xyz="0 0 -0.3"/><geometry><box size="0.5 0.5 0.1"/></geometry></collision></link>
    <link name="drawer">{inertial}{boxes}</link>
    <joint name="slide" type="prismatic"><parent link="base"/><child link="drawer"/>
      <axis xyz="0 -1 0"/>{limits}<dynamics damping="1" friction="0.5"/></joint></robot>"""
    file = tmp_path / "r.urdf"
    file.write_text(text, encoding="utf-8")
    return gates(Source(format="urdf", file=file, root=tmp_path))


def test_a_good_drawer_passes(tmp_path: Path) -> None:
    found = drawer(tmp_path)
    assert found == Gates(
        loads=True,
        stable=True,
        settles=True,
        opens=True,
        clear=True,
        deepest=0.0,
        joints=1,
        reasons={},
    )
    assert found.passed


def test_a_file_that_is_none_does_not_load(tmp_path: Path) -> None:
    file = tmp_path / "r.urdf"
    file.write_text("<robot", encoding="utf-8")
    found = gates(Source(format="urdf", file=file, root=tmp_path))
    assert not found.loads
    assert not found.passed
    assert found.opens is None
    assert "loads" in found.reasons


def test_too_little_effort_does_not_open(tmp_path: Path) -> None:
    """Friction of 0.5 N holds against 0.1 N."""
    weak = '<limit lower="0" upper="0.3" effort="0.1" velocity="1"/>'
    found = drawer(tmp_path, joint=weak)
    assert found.opens is False
    assert found.loads
    assert "dynamics.open" in found.reasons["opens"]
    assert not found.passed


def test_pieces_that_meet_are_not_clear(tmp_path: Path) -> None:
    deep = '<collision><geometry><box size="0.2 0.2 0.6"/></geometry></collision>'
    found = drawer(tmp_path, contact=deep)
    assert found.clear is False
    assert "motion.collision" in found.reasons["clear"]
    # The drawer reaches 0.3 below its middle, the base's top lies 0.25 below it.
    assert found.deepest == pytest.approx(0.05, abs=1e-12)


def test_without_limits_it_does_not_load(tmp_path: Path) -> None:
    assert not drawer(tmp_path, joint="<!-- no limit -->").loads


@pytest.mark.parametrize("mass", ["0", "nan"])
def test_a_body_without_mass_fails_and_does_not_raise(tmp_path: Path, mass: str) -> None:
    assert not drawer(tmp_path, mass=mass).passed


@pytest.mark.parametrize("text", ["null", "{}", "[3]", "{", ""])
def test_a_bundle_of_something_else_fails_and_does_not_raise(tmp_path: Path, text: str) -> None:
    file = tmp_path / "manifest.json"
    file.write_text(text, encoding="utf-8")
    assert not gates(Source(format="bundle", file=file, root=tmp_path)).loads


def test_what_has_no_joint_left_does_not_open(tmp_path: Path) -> None:
    """A block stands for a drawer: it loads, lies still and meets nothing, and is of no use."""
    block = """<robot name="r"><link name="base"><inertial><mass value="1"/><inertia ixx="0.01"
      ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial><collision><geometry>
      <box size="0.5 0.5 0.1"/></geometry></collision></link></robot>"""
    file = tmp_path / "r.urdf"
    file.write_text(block, encoding="utf-8")
    found = gates(Source(format="urdf", file=file, root=tmp_path))
    assert found.passed
    assert held_against(found, 0) == found
    assert not held_against(found, 1).passed
    assert "1 joints" in held_against(found, 1).reasons["opens"]
    whole = drawer(tmp_path)
    assert held_against(whole, 2) == whole
