"""An OpenGL context without a display, on Mesa's software rasterizer."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import moderngl

from artgen.core.errors import UsageError
from artgen.system_libraries import RASTERIZER_PACKAGES

CONTEXT: dict[str, Any] = {"require": 330, "standalone": True, "backend": "egl"}
VENDOR = Path("/usr/share/glvnd/egl_vendor.d/50_mesa.json")


def check_rasterizer() -> None:
    """Raise UsageError with the packages to install where no context can be opened.

    It is tried in a process of its own, as a broken driver may take its process with it.
    """
    probe = subprocess.run(
        [sys.executable, "-c", "from renders.fast.context import open_context as o; o(threads=1)"],
        capture_output=True,
        text=True,
        check=False,
    )
    if probe.returncode != 0:
        lines = probe.stderr.strip().splitlines() or [f"exit code {probe.returncode}"]
        raise _missing(lines[-1].split("--mend); ")[-1])


def open_context(*, threads: int) -> moderngl.Context:
    """A context of this process; equal input gives equal pixels for any number of threads.

    A graphics card would round otherwise than the next one, so software is asked for even where
    there is one.

    Raises:
        UsageError: EGL or its software driver is missing.
    """
    os.environ["LIBGL_ALWAYS_SOFTWARE"] = "true"
    os.environ["LP_NUM_THREADS"] = str(threads)
    if VENDOR.exists():
        os.environ["__EGL_VENDOR_LIBRARY_FILENAMES"] = str(VENDOR)
    try:
        context = moderngl.create_context(**CONTEXT)
    except Exception as error:  # moderngl and its loader raise bare Exception
        raise _missing(str(error)) from error
    return context


def _missing(cause: str) -> UsageError:
    packages = " ".join(RASTERIZER_PACKAGES)
    return UsageError(
        "the fast backend needs OpenGL through EGL, which this machine lacks; "
        f"sudo apt-get install -y {packages}   (or, as root, artgen doctor --mend); {cause}"
    )
