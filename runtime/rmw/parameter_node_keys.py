"""The keys by which a parameter file names nodes, such as `/robot/talker`, `/*/talker` and `/**`."""

from __future__ import annotations

import re

from bot_console.runtime.rmw.names import validate_namespace, validate_node_name
from bot_console.runtime.rmw.parameter_overrides import ParameterYamlError

ALL_NODES = "/**"
"""The key of values for every node, such as those of a plain `-p name:=value`."""
_WILDCARDS = ("*", "**")


def key_matches(key: str, fully_qualified_name: str) -> bool:
    """Whether a node key, with `*` for one name and `**` for any number of them, matches a node."""
    if key == ALL_NODES:
        return True
    key = key if key.startswith("/") else f"/{key}"
    if "*" not in key:
        return key == fully_qualified_name
    # As in rcl, one replacement handles both wildcards: `/*` becomes a group that matches one name, and the remaining
    # star of `/**` becomes the quantifier of that group, which then matches any number of names, including none.
    pattern = key.replace("/*", r"(/\w+)")
    return re.fullmatch(pattern, fully_qualified_name) is not None


def check_node_key(key: str) -> None:
    """Raise `ParameterYamlError` for a key that, apart from wildcards, cannot be a node's name."""
    namespace, slash, node = key.rpartition("/")
    if slash:
        namespace = f"{namespace}/"
        namespace = namespace if namespace.startswith("/") else f"/{namespace}"
        for token in namespace.split("/")[1:-1]:
            if not token:
                raise ParameterYamlError(f"{namespace} contains repeated forward slash")
            if token not in _WILDCARDS:
                _refuse(validate_namespace(f"/{token}"))
    if node not in _WILDCARDS:
        _refuse(validate_node_name(node))


def _refuse(problem: tuple[str, int] | None) -> None:
    if problem is not None:
        raise ParameterYamlError(problem[0])
