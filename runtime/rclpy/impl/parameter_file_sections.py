"""The sections of a parameter file and the nodes that each is for, in every form that rcl reads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, cast

from bot_console.runtime.rmw.parameter_node_keys import key_matches

KEYWORD = "ros__parameters"
MISSING = object()
_WILDCARDS = frozenset(("*", "**"))


class Section(NamedTuple):
    """The parameters below one path of keys; `values` is `MISSING` if there is no `ros__parameters`."""

    top: Any
    """The key at the top of the file, for messages."""
    nodes: str
    """The fully qualified name of the node, or a pattern such as `/*/talker`."""
    values: Any

    @property
    def has_wildcard(self) -> bool:
        """Whether the section is for more than one node."""
        return not _WILDCARDS.isdisjoint(self.nodes.split("/"))


def chosen_values(content: Any, use_wildcard: bool, target_nodes: Sequence[str] | None) -> dict[str, Any]:
    """Return the parameters for the target nodes, or for all nodes; wildcards come first, so that others override them.

    Raises `RuntimeError` for a file without such parameters, or a section without `ros__parameters`.
    """
    keys = list(content.keys())
    sections = [each for top in keys for each in _sections(top, _below("", top), content[top])]
    usable = [each for each in sections if use_wildcard or not each.has_wildcard]
    if target_nodes:
        usable = _for_targets(usable, target_nodes, keys)
    if not usable:
        raise RuntimeError("Param file does not contain selected parameters")
    found: dict[str, Any] = {}
    for section in sorted(usable, key=lambda each: not each.has_wildcard):
        if section.values is MISSING:
            raise RuntimeError(f"YAML file is not a valid ROS parameter file for node {section.top}")
        found.update(section.values)
    return found


def _for_targets(sections: Sequence[Section], targets: Sequence[str], keys: list[Any]) -> list[Section]:
    wanted: list[Section] = []
    for target in targets:
        matching = [each for each in sections if key_matches(each.nodes, _below("", target))]
        if not matching:
            raise RuntimeError(f"Param file does not contain parameters for {target},only for nodes: {keys} ")
        wanted += [each for each in matching if each not in wanted]
    return wanted


def _sections(top: object, path: str, value: object) -> Iterator[Section]:
    below = cast("dict[Any, Any]", value) if isinstance(value, dict) else {}
    if KEYWORD in below or not below:
        yield Section(top, path, below.get(KEYWORD, MISSING))
        return
    for key, inner in below.items():
        yield from _sections(top, _below(path, key), inner)


def _below(path: str, key: object) -> str:
    return f"{path.rstrip('/')}/{str(key).strip('/')}"
