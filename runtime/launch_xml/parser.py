"""The parser of launch files in XML."""

from __future__ import annotations

from typing import Any, TextIO
from xml.etree import ElementTree
from xml.parsers import expat

from launch.frontend import Parser as BaseParser
from launch_xml.entity import Entity

Lines = dict[ElementTree.Element, int]


class Parser(BaseParser):
    """Reads launch files in XML."""

    @classmethod
    def load(cls, file: str | TextIO) -> tuple[Entity, Parser]:
        """Return the root element and this parser; raises `ElementTree.ParseError`."""
        cls.load_launch_extensions()
        if isinstance(file, str):
            with open(file, encoding="utf-8") as stream:
                text = stream.read()
        else:
            text = file.read()
        root, lines = _read(text)
        return Entity(root, lines=lines), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the file extensions that the parser reads."""
        return {"launch.xml", "xml", "launch"}


def _read(text: str) -> tuple[ElementTree.Element, Lines]:
    """Return the root element and the line on which each element begins; raises `ElementTree.ParseError`."""
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
