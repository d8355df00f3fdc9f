"""Packs in children that kill themselves at their n-th touch of the disk, for
every STRIDE-th n.

`python -m tests.unit.dataset.packed_by_force STAGED OUT` leaves `OUT/<n>/` as each child left it.
Children are forks, so that the imports are paid once; none of them has started a thread before.
"""

import os
import signal
import sys
import tarfile
from pathlib import Path

from artgen.dataset.packing import pack

PER_SHARD = 2
STRIDE = 7
"""A shard touches the disk about 25 times, so that successive kills hit different steps of one."""


def die_at(count: int) -> None:
    """Let the `count`-th flush, rename, removal or member of a tar be this process' last act."""
    left = count

    def deadly(act):
        def touched(*args, **kwargs):
            nonlocal left
            left -= 1
            if left == 0:
                os.kill(os.getpid(), signal.SIGKILL)
            return act(*args, **kwargs)

        return touched

    os.fsync = deadly(os.fsync)
    os.unlink = deadly(os.unlink)
    os.replace = deadly(os.replace)
    tarfile.TarFile.addfile = deadly(tarfile.TarFile.addfile)


def main(argv: list[str]) -> int:
    """Kill ever later until one run survives to its end."""
    staged, out = Path(argv[0]), Path(argv[1])
    count = 1
    while True:
        child = os.fork()
        if child == 0:
            die_at(count)
            pack(sorted(staged.glob("*.tar")), out / str(count), per_shard=PER_SHARD)
            os._exit(0)
        if os.WIFEXITED(os.waitpid(child, 0)[1]):
            return 0
        count += STRIDE


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
