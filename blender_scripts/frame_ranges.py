"""Which items a task of a render farm is to render, in any of the ways that farms say it."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import UsageError

NUMBERS = ("--start", "--end", "--chunk", "--threads")
OPTIONS = (*NUMBERS, "--frames", "--manifest", "--out")
BLENDER = {"-s": "--start", "--frame-start": "--start", "-e": "--end", "--frame-end": "--end",
           "-f": "--frames", "--render-frame": "--frames"}  # fmt: skip
"""Blender's own arguments that state frames, and ours that mean the same."""
SPAN = re.compile(r"(\d+)(?:(?:\.\.|-)(\d+)(?:x(\d+))?)?")
"""`3`, `1..6` as Blender writes it, `1-6` and `1-9x2` as OpenCue does."""


@dataclass(frozen=True, kw_only=True)
class Asked:
    """What the command line of a task asks for.

    Attributes:
        out: folder that receives a folder for each item; None is `items` beside the manifest.
        threads: of rendering; None is one for each core that this process may use.
        stated: options that choose items, as they were written.
    """

    manifest: Path
    out: Path | None
    threads: int | None
    stated: Mapping[str, str]


def asked(argv: Sequence[str]) -> Asked:
    """The options of a task: after `--` where Blender runs us, else all; Blender's own frame
    arguments before `--` count as well.

    Raises:
        UsageError: an option is unknown, given twice, without a value, or no number.
    """
    cut = argv.index("--") if "--" in argv else None
    options = {} if cut is None else _blender_frames(argv[:cut])
    words = iter(argv[1:] if cut is None else argv[cut + 1 :])
    for word in words:
        option, assigned, value = word.partition("=")
        if option not in OPTIONS:
            raise UsageError(f"unknown argument {word}; known are {', '.join(OPTIONS)}")
        value = value if assigned else next(words, "")
        if option in options:
            raise UsageError(f"{option} is given twice: {options[option]} and {value}")
        if not value or (option in NUMBERS and not value.isdecimal()):
            kind = "a whole number" if option in NUMBERS else "a value"
            raise UsageError(f"{option} {value}: expected {kind}")
        options[option] = value
    if "--manifest" not in options:
        raise UsageError("--manifest is missing; name the file that `artgen farm plan` wrote")
    threads = int(options["--threads"]) if "--threads" in options else None
    if threads == 0:
        raise UsageError("--threads 0: expected at least 1")
    return Asked(
        manifest=Path(options["--manifest"]),
        out=Path(options["--out"]) if "--out" in options else None,
        threads=threads,
        stated={name: options[name] for name in options if name in (*NUMBERS[:3], "--frames")},
    )


def _blender_frames(argv: Sequence[str]) -> dict[str, str]:
    found = {}
    for word, value in zip(argv, [*argv[1:], ""], strict=True):
        if word in BLENDER:
            found[BLENDER[word]] = value
    return found


def chosen(stated: Mapping[str, str], environment: Mapping[str, str], count: int) -> list[int]:
    """Numbers of the items of this task, of a manifest of `count`.

    `--frames` names them; `--start` and `--end` are the first and the last; `--start` and `--chunk`
    the first and how many at most; neither leaves this task's even share of a SLURM array, or all.

    Raises:
        UsageError: the options contradict each other, or name no item of the manifest.
    """
    if "--frames" in stated:
        if len(stated) > 1:
            raise UsageError(f"--frames excludes {', '.join(set(stated) - {'--frames'})}")
        return _bounded(spans(stated["--frames"]), count)
    if "--start" in stated:
        return _from_start({name: int(value) for name, value in stated.items()}, count)
    if stated:
        raise UsageError(f"{', '.join(stated)} needs --start, the number of the first item")
    return array_share(environment, count)


def _from_start(bounds: Mapping[str, int], count: int) -> list[int]:
    start = bounds["--start"]
    if ("--end" in bounds) == ("--chunk" in bounds):
        raise UsageError("--start needs one of --end, the last item, and --chunk, how many")
    if "--chunk" in bounds:
        if start >= count or bounds["--chunk"] == 0:
            raise _outside(f"--start {start} --chunk {bounds['--chunk']}", count)
        return list(range(start, min(start + bounds["--chunk"], count)))
    if bounds["--end"] < start:
        raise UsageError(f"--start {start} --end {bounds['--end']}: the last lies before the first")
    return _bounded(list(range(start, bounds["--end"] + 1)), count)


def spans(text: str) -> list[int]:
    """The numbers of a list such as `1-10,15` or `1,5..6`, in order, each once.

    Raises:
        UsageError: it is no such list.
    """
    numbers: list[int] = []
    for span in text.split(","):
        found = SPAN.fullmatch(span.strip())
        if found is None:
            raise UsageError(f"--frames {text}: {span!r} is no frame; write 1-10,15 or 1,5..6")
        first, last, step = int(found[1]), int(found[2] or found[1]), int(found[3] or 1)
        if last < first or step == 0:
            raise UsageError(f"--frames {text}: {span!r} is empty; write the smaller frame first")
        numbers += range(first, last + 1, step)
    return list(dict.fromkeys(numbers))


def array_share(environment: Mapping[str, str], count: int) -> list[int]:
    """This task's even share of all items by the variables of a SLURM array; all without one.

    Raises:
        UsageError: a variable is no number, or the array's bounds do not hold this task.
    """
    if "SLURM_ARRAY_TASK_ID" not in environment:
        return list(range(count))
    task = _variable(environment, "SLURM_ARRAY_TASK_ID", "0")
    first = _variable(environment, "SLURM_ARRAY_TASK_MIN", "0")
    tasks = _variable(environment, "SLURM_ARRAY_TASK_COUNT", "1")
    step = _variable(environment, "SLURM_ARRAY_TASK_STEP", "1")
    share = (task - first) // max(step, 1)
    if not 0 <= share < tasks:
        raise UsageError(
            f"SLURM_ARRAY_TASK_ID {task} is outside an array of {tasks} tasks from {first} on; "
            "submit one gapless array, or state --start and --end"
        )
    return list(range(share * count // tasks, (share + 1) * count // tasks))


def _variable(environment: Mapping[str, str], name: str, default: str) -> int:
    value = environment.get(name, default)
    if not value.isdecimal():
        raise UsageError(f"{name} is {value!r}, expected a whole number")
    return int(value)


def _bounded(numbers: list[int], count: int) -> list[int]:
    if max(numbers) >= count:
        raise _outside(f"item {max(numbers)}", count)
    return numbers


def _outside(what: str, count: int) -> UsageError:
    return UsageError(f"{what} is outside the manifest, whose items are 0 to {count - 1}")
