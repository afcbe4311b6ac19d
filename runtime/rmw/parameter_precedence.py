"""Parameter overrides from files and from `-p`, in command line order."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.rmw.parameter_node_keys import key_matches
from bot_console.runtime.rmw.parameter_overrides import COMMAND_LINE as COMMAND_LINE
from bot_console.runtime.rmw.parameter_overrides import ParameterOverrides
from bot_console.runtime.rmw.parameter_overrides import ParameterYamlError as ParameterYamlError


class ParameterTable(ParameterOverrides):
    """All overrides of one command line."""

    def add_file(self, path: str) -> None:
        """Add the values of a parameter file; raises `ParameterYamlError`."""
        from bot_console.runtime.rmw.parameter_file import read_parameter_file

        self.source = path
        read_parameter_file(path, self)

    def add_value(self, key: str, name: str, text: str) -> None:
        """Add the value of one parameter in the syntax of `-p`; raises `ParameterYamlError`."""
        from bot_console.runtime.rmw.parameter_value import read_parameter_value

        if not text:
            raise ParameterYamlError("error not set")
        self.source = COMMAND_LINE
        node = self.node(key)
        read_parameter_value(text, node.values[node.find(name)])

    def for_node(self, fully_qualified_name: str) -> dict[str, Any]:
        """Return a node's values; later keys overwrite earlier ones. None means a value without a type."""
        found: dict[str, Any] = {}
        for key, node in self.nodes.items():
            if key_matches(key, fully_qualified_name):
                found.update(node)
        return found

    def sources_for_node(self, fully_qualified_name: str) -> dict[str, str]:
        """Return the source of each value of `for_node`: the path of a file, or `COMMAND_LINE`."""
        found: dict[str, str] = {}
        for key, node in self.nodes.items():
            if key_matches(key, fully_qualified_name):
                found.update(zip(node.names, node.sources, strict=True))
        return found
