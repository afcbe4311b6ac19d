"""The parser of launch files in YAML."""

from __future__ import annotations

from typing import Any, TextIO

import yaml
from launch.frontend import Parser as BaseParser
from launch_yaml.entity import Entity


class Parser(BaseParser):
    """Reads launch files in YAML."""

    @classmethod
    def load(cls, file: str | TextIO) -> tuple[Entity, Parser]:
        """The root element, with this parser; raises `yaml.YAMLError`, and `RuntimeError` unless there is one root."""
        cls.load_launch_extensions()
        if isinstance(file, str):
            with open(file, encoding="utf-8") as stream:
                tree = _read(stream.read())
        else:
            tree = _read(file.read())
        if len(tree) != 1:
            raise RuntimeError("Expected only one root")
        type_name = next(iter(tree))
        return Entity(tree[type_name], type_name), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Endings of its files."""
        return {"launch.yaml", "launch.yml", "yaml", "yml", "launch"}


class LineMap(dict[Any, Any]):
    """A map of a YAML file, and the line on which it begins."""

    line = 0


def _read(text: str) -> Any:
    """The tree of a YAML text, its maps as `LineMap`; raises `yaml.YAMLError`."""

    class Loader(yaml.SafeLoader):
        pass

    def construct(loader: Any, node: Any) -> Any:
        found = LineMap()
        found.line = node.start_mark.line + 1
        yield found
        found.update(loader.construct_mapping(node))

    Loader.add_constructor("tag:yaml.org,2002:map", construct)
    return yaml.load(text, Loader)
