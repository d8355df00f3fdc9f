"""A deterministic fuzzer of XML models and of the meshes beside them."""

import shutil
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import numpy as np

from artgen.core.stream import Stream

JUNK = ("", "nan", "inf", "-1", "0", "1e308", "-1e-308", "x", "0 0", "1 2 3 4 5 6 7", "9" * 400,
        "../up", "/dev/zero", "base", "\u202e", "%s%n")  # fmt: skip
Change = Callable[[ET.Element, np.random.Generator], None]


def replace_value(root: ET.Element, rng: np.random.Generator) -> None:
    """An attribute holds junk."""
    element = pick([e for e in root.iter() if e.attrib], rng)
    element.set(pick(sorted(element.attrib), rng), pick(JUNK, rng))


def drop_value(root: ET.Element, rng: np.random.Generator) -> None:
    """An attribute is gone."""
    element = pick([e for e in root.iter() if e.attrib], rng)
    del element.attrib[pick(sorted(element.attrib), rng)]


def drop_element(root: ET.Element, rng: np.random.Generator) -> None:
    """An element is gone, with all below it."""
    parent = pick([e for e in root.iter() if len(e)], rng)
    parent.remove(pick(list(parent), rng))


def repeat_element(root: ET.Element, rng: np.random.Generator) -> None:
    """An element stands there twice."""
    parent = pick([e for e in root.iter() if len(e)], rng)
    parent.append(pick(list(parent), rng))


def rename_element(root: ET.Element, rng: np.random.Generator) -> None:
    """An element has another's tag."""
    elements = list(root.iter())
    pick(elements, rng).tag = pick(elements, rng).tag


def exchange_values(root: ET.Element, rng: np.random.Generator) -> None:
    """Two elements hold each other's attributes."""
    one, other = (pick([e for e in root.iter() if e.attrib], rng) for _ in range(2))
    one.attrib, other.attrib = other.attrib, one.attrib


CHANGES: tuple[Change, ...] = (
    replace_value, replace_value, replace_value, drop_value, drop_element, repeat_element,
    rename_element, exchange_values,
)  # fmt: skip


def pick(options, rng):  # type: ignore[no-untyped-def]
    """One of a sequence."""
    return options[int(rng.integers(len(options)))]


def fuzzed(sound: Path, folder: Path, file: str, number: int) -> Path:
    """A copy of a sound folder in which `file`, or every fourth time a mesh, is spoilt."""
    rng = Stream(0, "fuzz", file, number).generator()
    shutil.copytree(sound, folder)
    if number % 4 == 3:
        spoil_bytes(pick(sorted(folder.rglob("*.obj")), rng), rng)
        return folder / file
    tree = ET.parse(folder / file)
    for _ in range(int(rng.integers(1, 4))):
        pick(CHANGES, rng)(tree.getroot(), rng)
    text = ET.tostring(tree.getroot(), encoding="utf-8")
    (folder / file).write_bytes(text)
    if number % 10 == 0:
        spoil_bytes(folder / file, rng)
    return folder / file


def spoil_bytes(path: Path, rng: np.random.Generator) -> None:
    """A file cut short, or with bytes changed."""
    data = bytearray(path.read_bytes())
    if rng.random() < 0.5:
        del data[int(rng.integers(len(data))) :]
    else:
        for place in rng.integers(len(data), size=int(rng.integers(1, 40))).tolist():
            data[place] = int(rng.integers(256))
    path.write_bytes(bytes(data))
