"""The parser of launch files in XML."""

from __future__ import annotations

from typing import TextIO
from xml.etree import ElementTree

from launch.frontend import Parser as BaseParser
from launch_xml.entity import Entity


class Parser(BaseParser):
    """Reads launch files in XML."""

    @classmethod
    def load(cls, file: str | TextIO) -> tuple[Entity, Parser]:
        """The root element, with this parser; raises `ElementTree.ParseError`."""
        cls.load_launch_extensions()
        return Entity(ElementTree.parse(file).getroot()), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Endings of its files."""
        return {"launch.xml", "xml", "launch"}
