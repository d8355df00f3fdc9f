"""Rules: every fault names file, key, value and bound; draws have addresses."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import RuleError
from artgen.core.stream import Stream
from artgen.rules import load_rule, rule_names, sample
from artgen.rules.distributions import Chance, Choice, Integer, LogUniform, Normal, Uniform
from artgen.rules.surfaces import load_palette

GOOD = """
[category]
name = "thing"
version = 1
summary = "a thing"
tries = 5

[band]
width = [0.1, 1.0]
depth = [0.1, 1.0]
height = [0.1, 1.0]
mass = [1.0, 9.0]
source = "somewhere"

[sample]
width = { uniform = [0.28, 0.40] }
count = { integer = [2, 4] }
style = { choice = ["a", "b"], weights = [1, 3] }
cells = { uniform = [0.0, 1.0], length = 3 }

[surfaces]
body = { choice = ["steel"] }

[[invariant]]
name = "few"
"""
PALETTE = '[steel]\nrecipe = "plain"\ncolor = "#808080"\n'


@dataclass(frozen=True)
class ThingParams:
    width: float
    count: int
    style: str
    cells: tuple


def folder_with(tmp_path: Path, rule: str, palette: str = PALETTE) -> Path:
    folder = tmp_path / "rules"
    folder.mkdir(exist_ok=True)
    (folder / "thing.toml").write_text(rule)
    (folder / "_surfaces.toml").write_text(palette)
    return folder


def drawn(folder: Path, seed: int = 0, few=lambda p: True):
    return sample(
        load_rule("thing", folder), Stream(seed, "thing", 0),
        params_type=ThingParams, invariants={"few": few}, folder=folder,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[0.28, 0.40]", "[0.40, 0.28]", r"\[sample.width\] uniform = \[0.4, 0.28\] is empty"),
        ("[0.28, 0.40]", "[0.3, 0.3]", r"is empty \(lower 0.3 >= upper 0.3\)"),
        ("uniform = [0.28", "unifrom = [0.28", r"sample.width.unifrom.*did you mean 'uniform'"),
        ("[2, 4]", "[2.5, 4]", "must be whole numbers"),
        ("[1, 3]", "[1]", "1 weights for 2 options"),
        ("[1, 3]", "[0, 0]", "positive sum"),
        ('["a", "b"], weights = [1, 3]', "[]", "the list is empty"),
        ("length = 3", "length = 0", r"length\] = 0 must be at least 1"),
        ("version = 1", 'version = "1"', r"category.version\] expected int, found '1'"),
        (
            "mass = [1.0, 9.0]",
            "mass = [9.0, 1.0]",
            r"band.mass\] = \[9.0, 1.0\] must hold 0 < lower",
        ),
        ("mass = [1.0, 9.0]", "", r"band.mass\] expected two numbers \[a, b\], found None"),
        (
            '"steel"',
            '"stele"',
            r"surfaces.body\] names no palette entry 'stele' \(did you mean 'steel'",
        ),
        ("[surfaces]", "[surface]", r"\[surface\] is not a known key \(did you mean 'surfaces'"),
        ("[category]", "[category", "not valid TOML"),
        ("{ integer = [2, 4] }", "3", "expected a table like"),
        ("{ integer = [2, 4] }", "{ integer = [2, 4], chance = 0.5 }", "exactly one of"),
        ("{ integer = [2, 4] }", "{ chance = 1.5 }", r"1.5 lies outside \[0, 1\]"),
    ],
)
def test_a_fault_names_file_key_value_and_bound(tmp_path, old, new, message) -> None:
    assert old in GOOD
    folder = folder_with(tmp_path, GOOD.replace(old, new))
    with pytest.raises(RuleError, match=message) as caught:
        load_rule("thing", folder)
    assert "thing.toml" in str(caught.value)


def test_unknown_categories_are_met_with_the_known_ones(tmp_path) -> None:
    with pytest.raises(
        RuleError, match=r"no category 'thong' \(did you mean 'thing'\?\); known: thing"
    ):
        load_rule("thong", folder_with(tmp_path, GOOD))


@pytest.mark.parametrize(
    ("palette", "message"),
    [
        ('[steel]\ncolor = "#808080"', "needs a recipe"),
        ('[steel]\nrecipe = "plain"\ncolour = "#808080"', r"unknown keys \['colour'\]"),
        ('[steel]\nrecipe = "plain"\ncolor = "grey"', "is not #rrggbb"),
        ('[steel]\nrecipe = "plain"\nroughness = 1.5', r"roughness = 1.5 lies outside \[0, 1\]"),
    ],
)
def test_palette_faults_are_named(tmp_path, palette, message) -> None:
    with pytest.raises(RuleError, match=message):
        load_palette(folder_with(tmp_path, GOOD, palette))


def test_keys_and_fields_must_agree(tmp_path) -> None:
    extra = folder_with(
        tmp_path, GOOD.replace("[surfaces]", "widht = { uniform = [0, 1] }\n[surfaces]")
    )
    with pytest.raises(
        RuleError, match=r"\[sample.widht\] is not a parameter of thing \(did you mean"
    ):
        drawn(extra)
    missing = folder_with(tmp_path, GOOD.replace("count = { integer = [2, 4] }", ""))
    with pytest.raises(RuleError, match=r"\[sample\] lacks count"):
        drawn(missing)
    stranger = folder_with(tmp_path, GOOD.replace('name = "few"', 'name = "fwe"'))
    with pytest.raises(RuleError, match="'fwe' is not defined by the builder"):
        drawn(stranger)


def test_an_impossible_rule_says_which_invariant_failed_how_often(tmp_path) -> None:
    with pytest.raises(
        RuleError, match="no valid sample in 5 tries at thing/0: few failed 5 times"
    ):
        drawn(folder_with(tmp_path, GOOD), few=lambda p: False)


def test_an_unrelated_new_draw_changes_nothing(tmp_path) -> None:
    before = drawn(folder_with(tmp_path, GOOD)).params
    text = GOOD.replace(
        "width = { uniform = [0.28",
        "cells = { uniform = [0.0, 1.0], length = 3 }\nwidth = { uniform = [0.28",
    )
    text = text.replace(
        "cells = { uniform = [0.0, 1.0], length = 3 }\n\n[surfaces]", "\n[surfaces]"
    )
    assert drawn(folder_with(tmp_path, text)).params == before


def test_a_failed_try_is_followed_by_another_that_passes(tmp_path) -> None:
    found = drawn(
        folder_with(tmp_path, GOOD.replace("tries = 5", "tries = 99")), few=lambda p: p.count == 2
    )
    assert found.params.count == 2
    assert found.surfaces["body"].name == "body"


def test_the_digest_follows_the_rule_and_the_palette(tmp_path) -> None:
    first = load_rule("thing", folder_with(tmp_path, GOOD)).digest
    assert load_rule("thing", folder_with(tmp_path, GOOD + "# a comment\n")).digest == first
    assert load_rule("thing", folder_with(tmp_path, GOOD.replace("0.28", "0.29"))).digest != first
    darker = PALETTE.replace("#808080", "#707070")
    assert load_rule("thing", folder_with(tmp_path, GOOD, darker)).digest != first


SAMPLES = 20_000


@pytest.mark.parametrize(
    ("distribution", "mean", "deviation", "lower", "upper"),
    [
        (Uniform(1.0, 3.0), 2.0, 2.0 / 12**0.5, 1.0, 3.0),
        (LogUniform(1.0, np.e), np.e - 1.0, 0.4917, 1.0, np.e),
        (Integer(1, 4), 2.5, 1.118, 1, 4),
        (Choice((0.0, 1.0), (1.0, 3.0)), 0.75, 0.433, 0.0, 1.0),
        (Chance(0.3), 0.3, 0.458, 0, 1),
        (Normal(5.0, 0.5), 5.0, 0.44, 4.0, 6.0),
    ],
)
def test_draws_have_the_stated_mean_and_bounds(distribution, mean, deviation, lower, upper) -> None:
    """The mean of n draws lies within 5 standard errors; it misses once in two million."""
    rng = Stream(3, "draws").generator()
    values = np.array([float(distribution.draw(rng)) for _ in range(SAMPLES)])
    assert abs(values.mean() - mean) < 5 * deviation / SAMPLES**0.5
    assert values.min() >= lower
    assert values.max() <= upper


def test_every_shipped_rule_loads_under_its_own_name() -> None:
    names = rule_names()
    assert {"laptop", "dishwasher", "cabinet"} <= set(names)
    for name in names:
        assert re.fullmatch(r"[a-z][a-z_]*", name)
        assert load_rule(name).name == name
