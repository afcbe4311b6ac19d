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
        """Return the root element and this parser; raises `yaml.YAMLError`, or `RuntimeError` unless there is one."""
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
        """Return the file extensions that the parser reads."""
        return {"launch.yaml", "launch.yml", "yaml", "yml", "launch"}


class LineMap(dict[Any, Any]):
    """A map in a YAML file, with the line on which it begins."""

    line = 0


def _read(text: str) -> Any:
    """Return the tree of a YAML text, in which maps are `LineMap`s; raises `yaml.YAMLError`."""

    class Loader(yaml.SafeLoader):
        pass

    def construct(loader: Any, node: Any) -> Any:
        found = LineMap()
        found.line = node.start_mark.line + 1
        yield found
        found.update(loader.construct_mapping(node))

    Loader.add_constructor("tag:yaml.org,2002:map", construct)
    return yaml.load(text, Loader)
