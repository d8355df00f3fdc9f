"""The shared libraries that Blender's module links to, and Debian's names for them."""

import importlib.util
import re
import shutil
import subprocess
from collections.abc import Sequence

from artgen.core.errors import UsageError

DEBIAN_PACKAGES = {
    "libX11": "libx11-6",
    "libXrender": "libxrender1",
    "libXfixes": "libxfixes3",
    "libXi": "libxi6",
    "libXxf86vm": "libxxf86vm1",
    "libxkbcommon": "libxkbcommon0",
    "libxcb": "libxcb1",
    "libXext": "libxext6",
    "libXau": "libxau6",
    "libXdmcp": "libxdmcp6",
    "libSM": "libsm6",
    "libICE": "libice6",
    "libGL": "libgl1",
    "libEGL": "libegl1",
    "libGLX": "libglx0",
    "libGLdispatch": "libglvnd0",
    "libgomp": "libgomp1",
    "libdbus-1": "libdbus-1-3",
}
"""Debian 12's package for each library that Blender's module links to."""
RASTERIZER_PACKAGES = ("libegl1", "libgl1-mesa-dri")
"""Debian's packages for OpenGL in software without a display."""


def missing_libraries() -> list[str]:
    """Shared libraries that Blender's module links to and the loader does not find."""
    spec = importlib.util.find_spec("bpy")
    if spec is None or spec.origin is None or shutil.which("ldd") is None:
        return []
    listing = subprocess.run(
        ["ldd", spec.origin], capture_output=True, text=True, check=False
    ).stdout
    return re.findall(r"^\s*(\S+) => not found", listing, flags=re.MULTILINE)


def debian_packages(libraries: Sequence[str]) -> list[str]:
    """Packages that bring the libraries; a library we do not know stands for itself."""
    return sorted({DEBIAN_PACKAGES.get(name.split(".so")[0], name) for name in libraries})


def check_libraries() -> None:
    """Raise UsageError with the packages to install when Blender could not be started."""
    if missing := missing_libraries():
        packages = " ".join(debian_packages(missing))
        raise UsageError(
            f"Blender needs {', '.join(missing)}, which this machine lacks; "
            f"sudo apt-get install -y {packages}   (or, as root, artgen doctor --mend)"
        )
