"""Going back to a moment: the parameter values of that time, as far as the history knows them. Pure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.console.model import Change, ParameterTree, Value, same


@dataclass(frozen=True)
class Restoration:
    """One value that going back would set."""

    node: str
    name: str
    now: Value
    then: Value


def values_at(changes: Sequence[Change], row: Change) -> dict[tuple[str, str], Value]:
    """The values right after the change `row` of all parameters that its run has changed, before it or later.

    `changes` are oldest first. Parameters that only other runs have changed are left out: nodes that were restarted
    since then began with their start values.
    """
    then: dict[tuple[str, str], Value] = {}
    for each in (each for each in changes if each.accepted and each.run == row.run):
        key = (each.node, each.name)
        if each.seq <= row.seq:
            then[key] = each.new
        else:
            then.setdefault(key, each.old)
    return then


def restorations(
    then: Mapping[tuple[str, str], Value], trees: Mapping[str, ParameterTree]
) -> tuple[list[Restoration], list[str]]:
    """The values to set in order to get the values in `then`, and texts about those that cannot be set because the
    node or the parameter no longer exists.
    """
    found: list[Restoration] = []
    missing: list[str] = []
    for (node, name), value in sorted(then.items()):
        tree = trees.get(node)
        parameter = tree.get(name) if tree else None
        if parameter is None:
            missing.append(f"{node} {name}: " + ("the parameter no longer exists" if tree else "node not running"))
        elif not same(parameter.value, value) and value is not None and not parameter.read_only:
            found.append(Restoration(node, name, parameter.value, value))
    return found, missing
