"""YAML maps with the lines on which they begin."""

from __future__ import annotations

from typing import Any

import yaml


class LineMap(dict[Any, Any]):
    """A map of a YAML file."""

    line = 0


def read_yaml(text: str) -> Any:
    """The tree of a YAML text, its maps with their lines; raises `yaml.YAMLError`."""

    class Loader(yaml.SafeLoader):
        pass

    def construct(loader: Any, node: Any) -> Any:
        found = LineMap()
        found.line = node.start_mark.line + 1
        yield found
        found.update(loader.construct_mapping(node))

    Loader.add_constructor("tag:yaml.org,2002:map", construct)
    return yaml.load(text, Loader)
