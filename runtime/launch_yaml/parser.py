"""The parser of launch files in YAML."""

from __future__ import annotations

from typing import TextIO

from launch.frontend import Parser as BaseParser
from launch_yaml.entity import Entity
from launch_yaml.read_yaml import read_yaml


class Parser(BaseParser):
    """Reads launch files in YAML."""

    @classmethod
    def load(cls, file: str | TextIO) -> tuple[Entity, Parser]:
        """The root element, with this parser; raises `yaml.YAMLError`, and `RuntimeError` unless there is one root."""
        cls.load_launch_extensions()
        if isinstance(file, str):
            with open(file, encoding="utf-8") as stream:
                tree = read_yaml(stream.read())
        else:
            tree = read_yaml(file.read())
        if len(tree) != 1:
            raise RuntimeError("Expected only one root")
        type_name = next(iter(tree))
        return Entity(tree[type_name], type_name), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Endings of its files."""
        return {"launch.yaml", "launch.yml", "yaml", "yml", "launch"}
