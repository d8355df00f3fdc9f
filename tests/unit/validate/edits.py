"""Ways to spoil a bundle's files; `sign` makes the manifest's hashes match again."""

import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from typing import Any

from artgen.export.layout import MANIFEST, MJCF, URDF, mesh_path
from artgen.export.manifest import file_entries
from tests.unit.validate.cabinet import ASSET

Edit = Callable[[Path], None]


def sign(folder: Path) -> None:
    """Write the present hashes into the manifest."""
    edit_manifest(folder, lambda m: m.update(files=file_entries(folder)))


def edit_manifest(folder: Path, change: Callable[[dict[str, Any]], object]) -> None:
    """Change the manifest in place."""
    path = folder / MANIFEST
    data = json.loads(path.read_text())
    change(data)
    path.write_text(json.dumps(data))


def edit_xml(folder: Path, file: str, change: Callable[[ET.Element], object]) -> None:
    """Change an XML file in place."""
    tree = ET.parse(folder / file)
    change(tree.getroot())
    tree.write(folder / file)


def in_urdf(path: str, key: str, value: str) -> Edit:
    """Set an attribute of the first element that an XPath finds in the URDF."""
    return in_xml(URDF, path, key, value)


def in_mjcf(path: str, key: str, value: str) -> Edit:
    """Set an attribute of the first element that an XPath finds in the MJCF."""
    return in_xml(MJCF, path, key, value)


def in_xml(file: str, path: str, key: str, value: str) -> Edit:
    """Set an attribute of the first element that an XPath finds."""

    def change(root: ET.Element) -> None:
        element = root.find(path)
        assert element is not None, path
        element.set(key, value)

    return lambda folder: edit_xml(folder, file, change)


def without(path: str) -> Edit:
    """Take every element that an XPath finds out of the URDF."""

    def change(root: ET.Element) -> None:
        parents = {child: parent for parent in root.iter() for child in parent}
        found = root.findall(path)
        assert found, path
        for element in found:
            parents[element].remove(element)

    return lambda folder: edit_xml(folder, URDF, change)


URDF_KEYS = {
    "lower": "limit", "upper": "limit", "effort": "limit", "velocity": "limit",
    "friction": "dynamics", "damping": "dynamics",
}  # fmt: skip


def joint_number(joint: str, key: str, value: float) -> Edit:
    """Set a number of a joint in manifest and URDF alike."""

    def edit(folder: Path) -> None:
        edit_manifest(folder, lambda m: _joint(m, joint).update({key: value}))
        in_urdf(f"joint[@name='{joint}']/{URDF_KEYS[key]}", key, repr(value))(folder)

    return edit


def joint_axis(joint: str, axis: tuple[float, float, float]) -> Edit:
    """Set the axis of a joint in manifest and URDF alike."""

    def edit(folder: Path) -> None:
        edit_manifest(folder, lambda m: _joint(m, joint).update(axis=axis))
        text = " ".join(map(repr, axis))
        in_urdf(f"joint[@name='{joint}']/axis", "xyz", text)(folder)

    return edit


def _joint(manifest: dict[str, Any], name: str) -> dict[str, Any]:
    return next(joint for joint in manifest["joints"] if joint["name"] == name)


def part_field(part: str, key: str, value: object) -> Edit:
    """Set a field of a part in the manifest."""

    def change(manifest: dict[str, Any]) -> None:
        next(p for p in manifest["parts"] if p["name"] == part)[key] = value

    return lambda folder: edit_manifest(folder, change)


def obj_lines(part: str, change: Callable[[list[str]], list[str]]) -> Edit:
    """Change the lines of a part's OBJ."""

    def edit(folder: Path) -> None:
        path = folder / mesh_path(ASSET, part)
        path.write_text("\n".join(change(path.read_text().split("\n"))))

    return edit


def first_line(keyword: str, new: Callable[[str], str | None]) -> Callable[[list[str]], list[str]]:
    """Replace the first line of a keyword; None takes it out."""

    def change(lines: list[str]) -> list[str]:
        at = next(i for i, line in enumerate(lines) if line.startswith(f"{keyword} "))
        replaced = new(lines[at])
        return lines[:at] + ([] if replaced is None else [replaced]) + lines[at + 1 :]

    return change


def flipped(line: str) -> str:
    """A face line wound the other way."""
    keyword, a, b, c = line.split()
    return f"{keyword} {a} {c} {b}"


def all_flipped(lines: list[str]) -> list[str]:
    """Every face of a mesh wound the other way."""
    return [flipped(line) if line.startswith("f ") else line for line in lines]


def collapsed(line: str) -> str:
    """A face whose three corners lie on one vertex after the first two are moved there."""
    return re.sub(r"^f (\d+)(\S*) (\d+)(\S*)", r"f \1\2 \1\4", line)


def delete(path: str) -> Edit:
    """Delete a file."""
    return lambda folder: (folder / path).unlink()


def append(path: str, data: bytes) -> Edit:
    """Append bytes to a file, which is made if missing."""

    def edit(folder: Path) -> None:
        old = (folder / path).read_bytes() if (folder / path).exists() else b""
        (folder / path).write_bytes(old + data)

    return edit


def cut(path: str) -> Edit:
    """Keep the first half of a file."""

    def edit(folder: Path) -> None:
        data = (folder / path).read_bytes()
        (folder / path).write_bytes(data[: len(data) // 2])

    return edit


def replaced(path: str, old: str, new: str) -> Edit:
    """Replace text everywhere in a file."""

    def edit(folder: Path) -> None:
        text = (folder / path).read_bytes().decode("latin-1")
        assert old in text, old
        (folder / path).write_bytes(text.replace(old, new).encode("latin-1"))

    return edit
