"""TOML to CategoryRule; every error names file, key, value and bound."""

import tomllib
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

from artgen.core.errors import RuleError, did_you_mean
from artgen.core.jsonio import content_hash
from artgen.rules.distributions import (
    Chance,
    Choice,
    Distribution,
    Integer,
    LogUniform,
    Normal,
    Uniform,
)
from artgen.rules.schema import Band, CategoryRule, Draw
from artgen.rules.surfaces import load_palette

BANDS = ("width", "depth", "height", "mass")
TABLES = ("category", "band", "sample", "surfaces", "invariant")
PAIRS: dict[str, type] = {
    "uniform": Uniform,
    "log_uniform": LogUniform,
    "normal": Normal,
    "integer": Integer,
}
KINDS = (*PAIRS, "choice", "chance")


def rules_folder() -> Path:
    """The folder of the shipped rules."""
    return Path(str(files("category_rules")))


def rule_names(folder: Path | None = None) -> list[str]:
    """Names of all categories that have a rule, sorted."""
    return sorted(
        path.stem for path in (folder or rules_folder()).glob("*.toml") if path.stem[0] != "_"
    )


def load_rule(name: str, folder: Path | None = None) -> CategoryRule:
    """Read and check `<folder>/<name>.toml` against itself and the palette.

    Raises:
        RuleError: the category is unknown, or the file breaks the schema.
    """
    folder = folder or rules_folder()
    path = folder / f"{name}.toml"
    if not path.is_file():
        known = rule_names(folder)
        raise RuleError(
            f"there is no category {name!r}{did_you_mean(name, known)}; known: {', '.join(known)}"
        )
    data = read_toml(path)
    reader = _Reader(f"{folder.name}/{path.name}")
    return reader.rule(data, load_palette(folder))


def read_toml(path: Path) -> dict[str, Any]:
    """The file's tables, or a RuleError with file and line."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise RuleError(f"{path.parent.name}/{path.name}: not valid TOML: {error}") from error


def drawn_from(file: str, key: str, entry: Mapping[str, Any]) -> Draw:
    """One entry of [sample], wherever it was written; `file` and `key` are for messages.

    Raises:
        RuleError: it breaks the schema.
    """
    return _Reader(file).draw(f"sample.{key}", entry)


class _Reader:
    """Turns one file's tables into values; carries the file's name for messages."""

    def __init__(self, file: str) -> None:
        self.file = file

    def fail(self, key: str, message: str) -> RuleError:
        return RuleError(f"{self.file}: [{key}] {message}")

    def rule(self, data: Mapping[str, Any], palette: Mapping[str, Any]) -> CategoryRule:
        self.known_keys("", data, TABLES)
        head = self.table(data, "category")
        self.known_keys(
            "category", head, ("name", "version", "summary", "tries", "held", "mounted")
        )
        surfaces = {
            role: self.surface(role, entry, palette)
            for role, entry in self.table(data, "surfaces").items()
        }
        used = {str(o): palette[str(o)] for c in surfaces.values() for o in c.options}
        return CategoryRule(
            name=self.of_type("category.name", head.get("name"), str),
            version=self.of_type("category.version", head.get("version"), int),
            summary=self.of_type("category.summary", head.get("summary"), str),
            bands=self.bands(self.table(data, "band")),
            draws={
                key: self.draw(f"sample.{key}", entry)
                for key, entry in self.table(data, "sample").items()
            },
            surfaces=surfaces,
            invariants=tuple(self.invariant(i) for i in data.get("invariant", [])),
            tries=self.of_type("category.tries", head.get("tries", 200), int),
            held=tuple(self.of_type("category.held", head.get("held", []), list)),
            mounted=self.of_type("category.mounted", head.get("mounted", False), bool),
            file=self.file,
            digest=content_hash([data, used]),
        )

    def known_keys(self, key: str, table: Mapping[str, Any], known: Sequence[str]) -> None:
        for word in table:
            if word not in known:
                where = f"{key}.{word}" if key else word
                raise self.fail(
                    where,
                    f"is not a known key{did_you_mean(word, known)}; expected {', '.join(known)}",
                )

    def table(self, data: Mapping[str, Any], key: str) -> Mapping[str, Any]:
        return self.of_type(key, data.get(key), dict)

    def of_type(self, key: str, value: Any, kind: type) -> Any:
        if isinstance(value, kind) and not (kind is int and isinstance(value, bool)):
            return value
        found = "nothing" if value is None else repr(value)
        raise self.fail(key, f"expected {kind.__name__}, found {found}")

    def bands(self, table: Mapping[str, Any]) -> dict[str, Band]:
        self.known_keys("band", table, (*BANDS, "source"))
        bands = {}
        for key in BANDS:
            lower, upper = self.pair(f"band.{key}", table.get(key))
            if not 0.0 < lower < upper:
                raise self.fail(f"band.{key}", f"= [{lower}, {upper}] must hold 0 < lower < upper")
            bands[key] = Band(lower, upper)
        return bands

    def pair(self, key: str, value: Any) -> tuple[Any, Any]:
        numbers = isinstance(value, list) and len(value) == 2 and all(_is_number(v) for v in value)
        if not numbers:
            raise self.fail(key, f"expected two numbers [a, b], found {value!r}")
        return value[0], value[1]

    def draw(self, key: str, entry: Any) -> Draw:
        if not isinstance(entry, dict):
            raise self.fail(key, f"expected a table like {{ uniform = [a, b] }}, found {entry!r}")
        self.known_keys(key, entry, (*KINDS, "weights", "length"))
        kinds = [kind for kind in KINDS if kind in entry]
        if len(kinds) != 1:
            raise self.fail(
                key, f"expected exactly one of {', '.join(KINDS)}; found {kinds or 'none'}"
            )
        distribution = self.distribution(key, kinds[0], entry)
        if (fault := distribution.check()) is not None:
            raise self.fail(key, f"{kinds[0]} = {entry[kinds[0]]!r} {fault}")
        length = entry.get("length")
        if length is not None and self.of_type(f"{key}.length", length, int) < 1:
            raise self.fail(f"{key}.length", f"= {length} must be at least 1")
        return Draw(distribution, length)

    def distribution(self, key: str, kind: str, entry: Mapping[str, Any]) -> Distribution:
        if kind != "choice" and "weights" in entry:
            raise self.fail(key, f"weights belong to choice, not to {kind}")
        if kind == "choice":
            return self.choice(key, entry)
        if kind == "chance":
            if not _is_number(entry["chance"]):
                raise self.fail(
                    key, f"chance expects a number in [0, 1], found {entry['chance']!r}"
                )
            return Chance(float(entry["chance"]))
        made: Distribution = PAIRS[kind](*self.pair(key, entry[kind]))
        return made

    def choice(self, key: str, entry: Mapping[str, Any]) -> Choice:
        options = self.of_type(f"{key}.choice", entry.get("choice"), list)
        weights = self.of_type(f"{key}.weights", entry.get("weights", [1] * len(options)), list)
        if not all(isinstance(o, str | int | float | bool) for o in options):
            raise self.fail(key, f"choice options must be plain values, found {options!r}")
        if not all(_is_number(w) for w in weights):
            raise self.fail(key, f"weights must be numbers, found {weights!r}")
        return Choice(tuple(options), tuple(float(w) for w in weights))

    def surface(self, role: str, entry: Any, palette: Mapping[str, Any]) -> Choice:
        key = f"surfaces.{role}"
        self.known_keys(key, self.of_type(key, entry, dict), ("choice", "weights"))
        choice = self.choice(key, entry)
        if (fault := choice.check()) is not None:
            raise self.fail(key, f"choice = {list(choice.options)!r} {fault}")
        for option in choice.options:
            if option not in palette:
                hint = did_you_mean(str(option), list(palette))
                raise self.fail(key, f"names no palette entry {option!r}{hint}; see _surfaces.toml")
        return choice

    def invariant(self, entry: Any) -> str:
        self.known_keys("invariant", self.of_type("invariant", entry, dict), ("name",))
        name: str = self.of_type("invariant.name", entry.get("name"), str)
        return name


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
