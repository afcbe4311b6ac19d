"""The parser of launch files in XML."""

from __future__ import annotations

from typing import TextIO

from launch.frontend import Parser as BaseParser
from launch_xml.entity import Entity
from launch_xml.read_xml import read_xml


class Parser(BaseParser):
    """Reads launch files in XML."""

    @classmethod
    def load(cls, file: str | TextIO) -> tuple[Entity, Parser]:
        """The root element, with this parser; raises `ElementTree.ParseError`."""
        cls.load_launch_extensions()
        if isinstance(file, str):
            with open(file, encoding="utf-8") as stream:
                text = stream.read()
        else:
            text = file.read()
        root, lines = read_xml(text)
        return Entity(root, lines=lines), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Endings of its files."""
        return {"launch.xml", "xml", "launch"}
