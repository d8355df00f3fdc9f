"""What is missing is named by its Debian package."""

from pathlib import Path

import pytest

from artgen import doctor, system_libraries
from artgen.core.errors import UsageError


def test_missing_libraries_become_packages() -> None:
    missing = ["libX11.so.6", "libXi.so.6", "libnovel.so.3"]
    assert system_libraries.debian_packages(missing) == ["libnovel.so.3", "libx11-6", "libxi6"]


def test_the_report_says_what_to_install(monkeypatch) -> None:
    monkeypatch.setattr(doctor, "missing_libraries", lambda: ["libXi.so.6"])
    findings = {finding.subject: finding for finding in doctor.examine(Path())}
    assert "apt-get install -y libxi6" in findings["system libraries"].remedy


def test_work_that_needs_blender_does_not_begin_without_its_libraries(monkeypatch) -> None:
    monkeypatch.setattr(system_libraries, "missing_libraries", lambda: ["libSM.so.6"])
    with pytest.raises(UsageError, match="apt-get install -y libsm6"):
        system_libraries.check_libraries()


def test_a_ready_machine_has_no_remedies_and_exit_code_0(capsys) -> None:
    assert doctor.doctor([]) == 0
    assert "ready" in capsys.readouterr().out


def test_a_full_disk_is_said(monkeypatch) -> None:
    monkeypatch.setattr(doctor.shutil, "disk_usage", lambda place: type("", (), {"free": 1e6})())
    findings = {finding.subject: finding for finding in doctor.examine(Path("not/yet/there"))}
    assert "free some space" in findings["disk"].remedy


def test_a_machine_without_software_opengl_is_ready_for_all_but_the_fast_backend(
    monkeypatch, capsys
) -> None:
    def lacks() -> None:
        raise UsageError("the fast backend needs OpenGL; install it; libEGL.so.1 is missing")

    monkeypatch.setattr(doctor, "check_rasterizer", lacks)
    assert doctor.doctor([]) == 0
    shown = capsys.readouterr().out
    assert "libEGL.so.1 is missing" in shown
    assert "apt-get install -y libegl1 libgl1-mesa-dri" in shown.replace("\n", " ")


def test_mending_installs_the_rasterizer_too(monkeypatch) -> None:
    asked = []

    def lacks() -> None:
        raise UsageError("none")

    monkeypatch.setattr(doctor, "check_rasterizer", lacks)
    monkeypatch.setattr(doctor, "missing_libraries", lambda: ["libXi.so.6"])
    monkeypatch.setattr(doctor, "install_packages", asked.extend)
    doctor.doctor(["--mend"])
    assert asked == ["libxi6", "libegl1", "libgl1-mesa-dri"]
