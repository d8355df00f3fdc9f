"""Render items of a farm's manifest; the entry for Blender, SLURM and plain Python.

    blender -b --factory-startup --python-exit-code 1 -P blender_scripts/render_shard.py -- \\
        --manifest M --start 0 --end 9 [--out D] [--threads N]
    blender -b --factory-startup --python-exit-code 1 -P blender_scripts/render_shard.py \\
        -f 1,5..6 -- --manifest M
    python blender_scripts/render_shard.py --manifest M --frames 0-9,15

Frame k is line k of the manifest, counted from 0. Needs bpy and the standard library alone.

Exit codes: 0 all items are rendered, 1 some failed, 2 the call makes no sense.
"""

import os
import sys
from pathlib import Path

# A farm runs this file by its path, in a Python that nobody installed artgen into; so this one file
# says where the packages lie.
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from blender_scripts.farm_task import main

if __name__ == "__main__":
    code = main(sys.argv)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # Blender ends with 0 whatever a script raises, and may crash while it closes.
