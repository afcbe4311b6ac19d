"""Which rows the parameter pane shows: nodes, groups of dotted names, parameters. Pure."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field

from bot_console.tui.console.model import ParameterInfo, ParameterTree
from bot_console.tui.console.query import Query

BUILT_IN = ("use_sim_time", "start_type_description_service")
BUILT_IN_PREFIX = "qos_overrides."


@dataclass(frozen=True)
class Row:
    """A line of the tree: a node, a group, or a parameter; `depth` is its indentation."""

    node: str
    name: str = ""
    depth: int = 0
    parameter: ParameterInfo | None = None
    problem: str = ""
    count: int = 0
    folded: bool = False


@dataclass(frozen=True)
class View:
    """How a person wants to see the parameters."""

    query: Query = field(default_factory=Query)
    only_changed: bool = False
    built_in: bool = False
    folded: Collection[str] = ()


def rows(trees: Mapping[str, ParameterTree], view: View) -> list[Row]:
    """All rows, in the order in which they stand."""
    found: list[Row] = []
    for name, tree in trees.items():
        shown = [each for each in tree.parameters if wanted(each, view)]
        filtering = bool(view.query.terms) or view.only_changed
        if filtering and not shown:
            continue
        folded = name in view.folded
        found.append(Row(name, problem=tree.problem, count=len(shown), folded=folded))
        if not folded:
            found += _below(name, shown)
    return found


def wanted(parameter: ParameterInfo, view: View) -> bool:
    """Whether the view shows a parameter."""
    if view.only_changed and not parameter.changed:
        return False
    if not view.built_in and (parameter.name in BUILT_IN or parameter.name.startswith(BUILT_IN_PREFIX)):
        return False
    return view.query.matches(f"{parameter.name} {parameter.description}", parameter.node)


def _below(node: str, parameters: list[ParameterInfo]) -> Iterator[Row]:
    """Parameters by name, with a row above each group of at least two that share a dotted prefix."""
    counts: dict[str, int] = {}
    for each in parameters:
        prefix = each.name.rpartition(".")[0]
        counts[prefix] = counts.get(prefix, 0) + 1
    group = ""
    for each in sorted(parameters, key=lambda one: (one.name.rpartition(".")[0], one.name)):
        prefix, _, last = each.name.rpartition(".")
        grouped = bool(prefix) and counts[prefix] > 1
        if grouped and prefix != group:
            yield Row(node, prefix, 1, count=counts[prefix])
        group = prefix if grouped else group
        yield Row(node, last if grouped else each.name, 2 if grouped else 1, each)
