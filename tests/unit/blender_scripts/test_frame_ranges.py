"""Which items a task renders: every way that farms say it, and what makes no sense."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.core.errors import UsageError
from blender_scripts.frame_ranges import array_share, asked, chosen, spans

BLENDER = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "-P", "render_shard.py"]


def items(words: list[str], *, count: int = 20, **environment: str) -> list[int]:
    """What a command line asks for, the manifest's name left out of it."""
    return chosen(asked([*words, "--manifest", "M"]).stated, environment, count)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["--start", "2", "--end", "4"], [2, 3, 4]),
        (["--start=2", "--end=2"], [2]),
        (["--start", "18", "--chunk", "5"], [18, 19]),
        (["--frames", "1-3,15"], [1, 2, 3, 15]),
        (["--frames", "1,5..6"], [1, 5, 6]),
        (["--frames", "0-9x4"], [0, 4, 8]),
        (["--frames", "3,1-3"], [3, 1, 2]),
        ([], list(range(20))),
    ],
)
def test_options_choose_items(words: list[str], expected: list[int]) -> None:
    assert items(["render_shard.py", *words]) == expected
    assert items([*BLENDER, "--", *words]) == expected


@pytest.mark.parametrize(
    ("words", "expected"),
    [(["-f", "1,5..6"], [1, 5, 6]), (["-s", "2", "-e", "4", "-a"], [2, 3, 4]), (["-f", "0"], [0])],
)
def test_frames_of_blender_itself_choose_items(words: list[str], expected: list[int]) -> None:
    assert items([*BLENDER, *words, "--"]) == expected


def test_the_rest_of_a_command_line() -> None:
    task = asked(["x", "--manifest", "m.jsonl", "--out", "o", "--threads", "3", "--frames", "1"])
    assert (task.manifest, task.out, task.threads) == (Path("m.jsonl"), Path("o"), 3)
    assert asked(["x", "--manifest", "m"]).threads is None


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--frame", "1"], "unknown argument --frame; known are --start"),
        (["7"], "unknown argument 7"),
        (["--start", "1", "--start", "2", "--end", "3"], "--start is given twice: 1 and 2"),
        (["--start", "-1", "--end", "2"], "--start -1: expected a whole number"),
        (["--start"], "--start --manifest: expected a whole number"),
        (["--threads", "0"], "--threads 0: expected at least 1"),
        (["--start", "3"], "--start needs one of --end, the last item, and --chunk"),
        (["--start", "1", "--end", "2", "--chunk", "2"], "--start needs one of"),
        (["--end", "3"], "--end needs --start"),
        (["--start", "4", "--end", "3"], "the last lies before the first"),
        (["--start", "4", "--end", "20"], "item 20 is outside the manifest, whose items are 0 to"),
        (["--start", "20", "--chunk", "2"], "--start 20 --chunk 2 is outside the manifest"),
        (["--start", "2", "--chunk", "0"], "--start 2 --chunk 0 is outside"),
        (["--frames", "1", "--end", "3"], "--frames excludes --end"),
        (["--frames", "3-1"], "'3-1' is empty; write the smaller frame first"),
        (["--frames", "1-3x0"], "'1-3x0' is empty"),
        (["--frames", "1-"], "'1-' is no frame; write 1-10,15"),
        (["--frames", "1,,2"], "'' is no frame"),
    ],
)
def test_what_makes_no_sense_is_told(words: list[str], message: str) -> None:
    with pytest.raises(UsageError) as told:
        items(["render_shard.py", *words])
    assert message in str(told.value)


def test_a_missing_manifest_option_is_told() -> None:
    with pytest.raises(UsageError, match="--manifest is missing"):
        asked([*BLENDER, "--", "--frames", "1"])


@given(
    count=st.integers(1, 500),
    tasks=st.integers(1, 60),
    first=st.integers(0, 5),
    step=st.integers(1, 4),
)
def test_a_slurm_array_renders_every_item_once(
    count: int, tasks: int, first: int, step: int
) -> None:
    """And no task more than one item more than another."""
    shares = [
        array_share(
            {
                "SLURM_ARRAY_TASK_ID": str(first + step * task),
                "SLURM_ARRAY_TASK_MIN": str(first),
                "SLURM_ARRAY_TASK_COUNT": str(tasks),
                "SLURM_ARRAY_TASK_STEP": str(step),
            },
            count,
        )
        for task in range(tasks)
    ]
    assert [number for share in shares for number in share] == list(range(count))
    assert max(map(len, shares)) - min(map(len, shares)) <= 1


def test_a_stated_range_wins_over_the_array() -> None:
    array = {"SLURM_ARRAY_TASK_ID": "1", "SLURM_ARRAY_TASK_COUNT": "2"}
    assert items(["x", "--frames", "3"], **array) == [3]
    assert items(["x"], count=5, **array) == [2, 3, 4]


@pytest.mark.parametrize(
    "array",
    [
        {"SLURM_ARRAY_TASK_ID": "9", "SLURM_ARRAY_TASK_MIN": "3", "SLURM_ARRAY_TASK_COUNT": "2"},
        {"SLURM_ARRAY_TASK_ID": "one"},
    ],
)
def test_an_array_that_does_not_hold_its_task_is_told(array: dict[str, str]) -> None:
    with pytest.raises(UsageError, match=r"state --start and --end|expected a whole number"):
        array_share(array, 10)


@given(st.lists(st.tuples(st.integers(0, 99), st.integers(0, 30)), min_size=1, max_size=5))
def test_spans_are_the_union_in_order(pairs: list[tuple[int, int]]) -> None:
    text = ",".join(f"{first}-{first + more}" for first, more in pairs)
    each = [number for first, more in pairs for number in range(first, first + more + 1)]
    assert spans(text) == list(dict.fromkeys(each))
    assert spans(text.replace("-", "..")) == spans(text)
