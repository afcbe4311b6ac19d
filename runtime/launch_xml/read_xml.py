"""XML elements with the lines on which they begin."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree
from xml.parsers import expat

Lines = dict[ElementTree.Element, int]


def read_xml(text: str) -> tuple[ElementTree.Element, Lines]:
    """The root element and the line of each element; raises `ElementTree.ParseError`."""
    builder = ElementTree.TreeBuilder()
    parser: Any = expat.ParserCreate()
    lines: Lines = {}

    def start(tag: str, attributes: dict[str, str]) -> None:
        lines[builder.start(tag, attributes)] = parser.CurrentLineNumber

    parser.StartElementHandler = start
    parser.EndElementHandler = builder.end
    parser.CharacterDataHandler = builder.data
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        reported = ElementTree.ParseError(str(error))
        reported.code, reported.position = error.code, (error.lineno, error.offset)
        raise reported from error
    return builder.close(), lines
