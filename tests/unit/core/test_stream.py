"""A draw depends on its address alone."""

import subprocess
import sys

from hypothesis import given
from hypothesis import strategies as st

from artgen.core.stream import Stream

PATHS = st.lists(st.one_of(st.text(max_size=8), st.integers(0, 99)), max_size=4)


def first_draws(stream: Stream) -> list[int]:
    return stream.generator().integers(0, 2**62, 4).tolist()


@given(st.integers(0, 2**31), PATHS)
def test_equal_addresses_draw_equal_numbers(seed: int, path: list) -> None:
    assert first_draws(Stream(seed, *path)) == first_draws(Stream(seed).child(*path))


@given(st.integers(0, 2**31), PATHS, PATHS)
def test_different_addresses_draw_different_numbers(seed: int, one: list, two: list) -> None:
    """Four draws of 62 bits agree by chance once in 2^248."""
    same = [str(step) for step in one] == [str(step) for step in two]
    assert (first_draws(Stream(seed, *one)) == first_draws(Stream(seed, *two))) == same


def test_joining_steps_is_another_address() -> None:
    assert first_draws(Stream(0, "a", "b")) != first_draws(Stream(0, "ab"))


def test_numbers_are_the_same_in_a_fresh_process_and_for_all_time() -> None:
    """The literal pins numpy's bit stream: a change here is a data change for every asset."""
    code = (
        "from artgen.core.stream import Stream;"
        "print(Stream(7, 'laptop', 3).generator().integers(0, 1000, 3).tolist())"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == str(
        Stream(7, "laptop", 3).generator().integers(0, 1000, 3).tolist()
    )
    assert told.stdout.strip() == "[962, 954, 44]"
