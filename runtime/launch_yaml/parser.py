"""The parser of launch files in YAML."""

from __future__ import annotations

from typing import TextIO

from launch.frontend import Parser as BaseParser
from launch_yaml.entity import Entity


class Parser(BaseParser):
    """Reads launch files in YAML."""

    @classmethod
    def load(cls, file: str | TextIO) -> tuple[Entity, Parser]:
        """The root element, with this parser; raises `yaml.YAMLError`, and `RuntimeError` unless there is one root."""
        import yaml

        cls.load_launch_extensions()
        if isinstance(file, str):
            with open(file, encoding="utf-8") as stream:
                tree = yaml.safe_load(stream)
        else:
            tree = yaml.safe_load(file)
        if len(tree) != 1:
            raise RuntimeError("Expected only one root")
        type_name = next(iter(tree))
        return Entity(tree[type_name], type_name), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Endings of its files."""
        return {"launch.yaml", "launch.yml", "yaml", "yml", "launch"}
