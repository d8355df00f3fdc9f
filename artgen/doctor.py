"""`artgen doctor`: is this machine ready, and how to mend what is not."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import psutil
import tyro
from rich.console import Console

from artgen.core.errors import UsageError
from artgen.system_libraries import RASTERIZER_PACKAGES, debian_packages, missing_libraries
from renders.fast.context import check_rasterizer

PINNED = ("bpy", "numpy", "manifold3d", "trimesh", "xatlas", "mujoco-core", "usd-core")
DISK_GB = 2.0
"""A run of 12 assets takes about 30 MB; the caches of an install about 1.5 GB."""
MEMORY_GB = 2.0
"""A Blender worker holds about 0.4 GB, the process that drives it about 0.3 GB."""


@dataclass(frozen=True)
class Finding:
    """One line of the report; `remedy` is empty when all is well.

    Attributes:
        needed: False where `make generate` works without it.
    """

    subject: str
    state: str
    remedy: str = ""
    needed: bool = True


@dataclass(frozen=True, kw_only=True)
class Doctor:
    """Check the machine (Python, Blender module, system libraries, disk, cores) and say how to mend
    it."""

    mend: bool = False
    """Install missing system libraries with apt-get; needs root."""
    folder: Path = Path()
    """Where output will go; its disk is checked."""


def doctor(argv: Sequence[str]) -> int:
    """Check the machine and say how to mend what is wrong."""
    command = tyro.cli(Doctor, args=argv, prog="artgen doctor")
    if command.mend:
        rasterizer = () if _rasterizer_error() is None else RASTERIZER_PACKAGES
        install_packages([*debian_packages(missing_libraries()), *rasterizer])
    findings = examine(command.folder)
    console = Console()
    for finding in findings:
        mark = "[red]x[/]" if finding.remedy else "[green]ok[/]"
        console.print(f"{mark} {finding.subject}: {finding.state}", highlight=False)
        if finding.remedy:
            console.print(f"   -> {finding.remedy}", highlight=False)
    broken = sum(bool(finding.remedy) and finding.needed for finding in findings)
    console.print("ready" if not broken else f"{broken} to mend", highlight=False)
    return 2 if broken else 0


def examine(folder: Path) -> list[Finding]:
    """Every check, in the order in which a fresh machine fails them."""
    checks: list[Callable[[], Finding]] = [
        _python,
        _packages,
        _libraries,
        _blender,
        _rasterizer,
        lambda: _disk(folder),
        _memory,
    ]
    return [check() for check in checks]


def _python() -> Finding:
    found = ".".join(str(n) for n in sys.version_info[:3])
    wrong = sys.version_info[:2] != (3, 11)
    return Finding("Python", found, "Blender's module needs Python 3.11 exactly" if wrong else "")


def _packages() -> Finding:
    found, missing = [], []
    for name in PINNED:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            missing.append(name)
    remedy = f"run `make install`; missing: {', '.join(missing)}" if missing else ""
    return Finding("packages", ", ".join(found), remedy)


def install_packages(packages: Sequence[str]) -> None:
    """Install what is missing when root; otherwise leave that to the report."""
    if not packages or os.geteuid() != 0 or shutil.which("apt-get") is None:
        return
    Console(stderr=True).print(f"installing {' '.join(packages)}", highlight=False)
    subprocess.run(["apt-get", "update", "-qq"], check=False)
    subprocess.run(
        ["apt-get", "install", "-qq", "-y", "--no-install-recommends", *packages],
        env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"},
        check=False,
    )


def _libraries() -> Finding:
    missing = missing_libraries()
    if not missing:
        return Finding("system libraries", "all that Blender links to are here")
    packages = " ".join(debian_packages(missing))
    return Finding(
        "system libraries",
        f"missing {', '.join(missing)}",
        f"sudo apt-get install -y {packages}   (or, as root, artgen doctor --mend)",
    )


def _blender() -> Finding:
    """Import bpy in a process of its own: it must not share one with pymeshlab or coacd."""
    probe = subprocess.run(
        [sys.executable, "-c", "import bpy; print(bpy.app.version_string)"],
        capture_output=True,
        text=True,
        check=False,
    )
    if probe.returncode == 0:
        return Finding("Blender module", f"{probe.stdout.split()[0]} imports")
    lines = probe.stderr.strip().splitlines() or [f"exit code {probe.returncode}"]
    return Finding("Blender module", lines[-1], "mend the libraries above, then `make install`")


def _rasterizer() -> Finding:
    if (error := _rasterizer_error()) is None:
        return Finding("fast backend", "software OpenGL opens")
    packages = " ".join(RASTERIZER_PACKAGES)
    remedy = f"sudo apt-get install -y {packages}   (or, as root, artgen doctor --mend)"
    return Finding("fast backend", error, remedy, needed=False)


def _rasterizer_error() -> str | None:
    try:
        check_rasterizer()
    except UsageError as error:
        return str(error).split("; ")[-1]
    return None


def _disk(folder: Path) -> Finding:
    place = folder.resolve()
    while not place.exists():
        place = place.parent
    free = shutil.disk_usage(place).free / 1e9
    remedy = f"free some space; {DISK_GB:g} GB is comfortable" if free < DISK_GB else ""
    return Finding("disk", f"{free:.1f} GB free", remedy)


def _memory() -> Finding:
    cores, total = os.cpu_count() or 1, psutil.virtual_memory().total / 1e9
    remedy = f"{MEMORY_GB:g} GB is the least for one worker" if total < MEMORY_GB else ""
    return Finding("machine", f"{cores} cores, {total:.0f} GB memory", remedy)
