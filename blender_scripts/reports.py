"""Reports on stdout, one JSON object a line, with nothing of Blender's talk between them."""

import os
import sys
from typing import TextIO


def private_stdout() -> TextIO:
    """The real stdout for reports alone; everyone else's prints go to stderr from now on."""
    sys.stdout.flush()
    reports = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    return reports
