"""XML from strangers: no entities, no document types, a bounded size, depth and count."""

import xml.etree.ElementTree as ET
from pathlib import Path
from xml.parsers import expat

from artgen.core.errors import ExportError

MAX_BYTES = 32 * 2**20
MAX_ELEMENTS = 200_000
MAX_DEPTH = 256
"""Robots have thousands of elements, some ten deep; these caps keep a hostile file to a second."""


def read_xml(path: Path) -> ET.Element:
    """The root element of a file.

    Raises:
        ExportError: the file is too large, too deep, or declares a document type (which is how
            entities expand without end, or name files of the reader's machine).
        ET.ParseError: it is no XML.
        OSError: it cannot be opened.
    """
    with path.open("rb") as stream:
        text = stream.read(MAX_BYTES + 1)
    return parsed_xml(text, path.name)


def parsed_xml(text: bytes, name: str) -> ET.Element:
    """The root element of a document; raises as `read_xml` does."""
    if len(text) > MAX_BYTES:
        raise ExportError(f"{name}: more than {MAX_BYTES} bytes of XML; no model needs them")
    builder, parser = ET.TreeBuilder(), expat.ParserCreate()
    limits = _Limits(name, builder)
    parser.buffer_text = True
    parser.StartDoctypeDeclHandler = limits.doctype
    parser.StartElementHandler = limits.start
    parser.EndElementHandler = limits.end
    parser.CharacterDataHandler = builder.data
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise ET.ParseError(str(error)) from error
    return builder.close()


class _Limits:
    """Passes elements on to a tree builder and refuses what is too much."""

    def __init__(self, name: str, builder: ET.TreeBuilder) -> None:
        self.name, self.builder = name, builder
        self.depth = self.count = 0

    def doctype(self, *declared: object) -> None:
        raise ExportError(f"{self.name}: declares a document type; models need none, remove it")

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        self.depth += 1
        self.count += 1
        if self.depth > MAX_DEPTH or self.count > MAX_ELEMENTS:
            raise ExportError(
                f"{self.name}: more than {MAX_DEPTH} elements deep or {MAX_ELEMENTS} in all"
            )
        self.builder.start(tag, attributes)

    def end(self, tag: str) -> None:
        self.depth -= 1
        self.builder.end(tag)
