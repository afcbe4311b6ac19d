"""The rows of the parameter pane: namespaces, nodes, groups, parameters. Pure."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.model import ParameterInfo, ParameterTree
from bot_console.tui.console.parameters.safety import DISTANCE, importance
from bot_console.tui.text.natural import NaturalKey, natural_key

BUILT_IN = ("use_sim_time", "start_type_description_service")
BUILT_IN_PREFIX = "qos_overrides."
_SEPARATOR = re.compile(r"[./]")


# Not frozen: each key typed into a filter makes thousands, and frozen instances take longer to create.
@dataclass(slots=True)
class Row:
    """A line of the tree: a namespace, a node, a group or a parameter, at an indentation level of `depth`."""

    node: str
    """The node, or the namespace."""
    name: str = ""
    depth: int = 0
    parameter: ParameterInfo | None = None
    problem: str = ""
    count: int = 0
    folded: bool = False
    fold: str = ""
    """The id by which the row is folded; empty for a parameter."""
    title: str = ""
    """The label of a namespace or node below its namespace."""
    ended: bool = False
    """Whether the row is a node that has ended; `problem` says how."""


@dataclass(frozen=True)
class View:
    """Which parameters the user has chosen to see."""

    query: Query = field(default_factory=Query)
    only_changed: bool = False
    built_in: bool = False
    folded: Collection[str] = frozenset()
    """The rows that are folded while no filter is active."""

    folded_matches: Collection[str] = frozenset()
    """The rows that have been folded since the filter was set; it shows its matches however the tree was folded."""

    essential: bool = False
    """Whether to show only the parameters that decide how the robot drives, as a flat list, if there is no filter."""

    @property
    def filtering(self) -> bool:
        """Whether the parameters are narrowed to those that match a filter or have changed."""
        return bool(self.query.terms) or self.only_changed

    @property
    def closed(self) -> Collection[str]:
        """The rows that are folded now."""
        return self.folded_matches if self.filtering else self.folded


def unfold_to(folded: Collection[str], node: str, name: str) -> frozenset[str]:
    """The rows that stay folded after a parameter was made visible: all but its namespaces, node and groups."""

    def holds(fold: str) -> bool:
        if fold.startswith(f"{node}:"):
            return name.startswith(fold.removeprefix(f"{node}:"))
        return fold == node or (fold.endswith("/") and node.startswith(fold))

    return frozenset(each for each in folded if not holds(each))


MAX_OPEN_NODES = 14
"""Maximum nodes of a tree that starts unfolded; a larger one starts folded."""


def initial_folds(nodes: Iterable[str]) -> frozenset[str]:
    """The rows that are folded before the user has folded or unfolded anything; a namespace of all nodes is not."""
    names = tuple(nodes)
    if len(names) <= MAX_OPEN_NODES:
        return frozenset()
    spaces = [{f"{each}/" for each in found} for found in _spaces(names).values()]
    return frozenset(names).union(*spaces) - spaces[0].intersection(*spaces[1:])


class TreeRows:
    """Makes rows; a node's rows are reused while its parameters and the view are the same objects."""

    def __init__(self) -> None:
        self._view: View | None = None
        self._made: dict[str, tuple[ParameterTree, int, list[Row]]] = {}
        self._below: dict[str, tuple[list[ParameterInfo], int, Collection[str], list[Row]]] = {}
        self._sorted: dict[str, _Sorted] = {}

    def rows(self, trees: Mapping[str, ParameterTree], view: View) -> list[Row]:
        """All rows, from top to bottom."""
        if view != self._view:
            self._made.clear()
            self._view = view
        if view.essential and not view.filtering:
            return essential_rows(trees)
        found: list[Row] = []
        spaces = _spaces(tuple(trees))
        shown: dict[str, list[Row]] = {}
        for name, tree in trees.items():
            made = self._node(name, tree, len(spaces[name]), spaces[name][-1] if spaces[name] else "", view)
            if not view.filtering or made[0].count:
                shown[name] = made
        counts: dict[str, int] = {}
        for name, made in shown.items():
            for space in spaces[name]:
                counts[space] = counts.get(space, 0) + made[0].count
        open_spaces: tuple[str, ...] = ()
        for name, made in shown.items():
            hidden = False
            for depth, space in enumerate(spaces[name]):
                if not hidden and open_spaces[depth : depth + 1] != (space,):
                    above = spaces[name][depth - 1] if depth else ""
                    found.append(_space_row(space, depth, above, counts[space], f"{space}/" in view.closed))
                hidden = hidden or f"{space}/" in view.closed
            open_spaces = spaces[name]
            if not hidden:
                found += made
        return found

    def count(self, trees: Iterable[str], view: View) -> int:
        """The number of parameters of these nodes in a view without its filter; their rows must have been made."""
        return sum(self._sorted[each].count(view) for each in trees)

    def _node(self, name: str, tree: ParameterTree, depth: int, space: str, view: View) -> list[Row]:
        known = self._made.get(name)
        if known and known[0] is tree and known[1] == depth:
            return known[2]
        ordered = self._sorted.get(name)
        if ordered is None or ordered.tree is not tree:
            ordered = self._sorted[name] = _Sorted(tree)
        parameters = ordered.passing(view)
        folded = name in view.closed
        title = name.removeprefix(f"{space}/") if space else ""
        problem, ended = tree.problem or tree.ended, bool(tree.ended)
        made = [Row(name, "", depth, None, problem, len(parameters), folded, name, title, ended)]
        if not folded:
            made += self._rows_below(name, parameters, depth + 1, view.closed)
        self._made[name] = (tree, depth, made)
        return made

    def _rows_below(self, name: str, parameters: list[ParameterInfo], depth: int, folded: Collection[str]) -> list[Row]:
        """The rows of these parameters; the same list again if a new filter passes the same parameters."""
        known = self._below.get(name)
        if known and known[0] == parameters and known[1] == depth and known[2] == folded:
            return known[3]
        found = list(_below(name, parameters, 0, depth, folded))
        self._below[name] = (parameters, depth, folded, found)
        return found


def essential_rows(trees: Mapping[str, ParameterTree]) -> list[Row]:
    """The parameters that decide how the robot drives; if there are none, numbers with a range; otherwise all of them.

    Parameters in a group, such as the limits of a simulated base, follow the others.
    """
    found = [each for tree in trees.values() for each in tree.parameters if not _is_built_in(each.name)]
    ranked = [(rank, each) for each in found if (rank := importance(each)) is not None and rank <= DISTANCE]
    best = [each for _, each in sorted(ranked, key=lambda pair: ("." in pair[1].name, pair[0]))]
    chosen = best or [each for each in found if each.range] or found
    names = Counter(each.name for each in chosen)
    return [Row(each.node, _name_among(each, names), 0, each) for each in chosen]


def _name_among(parameter: ParameterInfo, names: Mapping[str, int]) -> str:
    """The name of a parameter; with its node if several nodes have a parameter of that name."""
    return parameter.name if names[parameter.name] == 1 else f"{parameter.name} {parameter.node.removeprefix('/')}"


def most_important_row(found: Sequence[Row]) -> int:
    """The row where the cursor starts: the parameter that matters most, else the first one, else the first row."""
    parameters = [(at, row.parameter) for at, row in enumerate(found) if row.parameter is not None]
    ranked = [(rank, at) for at, each in parameters if (rank := importance(each)) is not None]
    return min(ranked)[1] if ranked else parameters[0][0] if parameters else 0


def rows(trees: Mapping[str, ParameterTree], view: View) -> list[Row]:
    """All rows, from top to bottom."""
    return TreeRows().rows(trees, view)


def _space_row(space: str, depth: int, above: str, count: int, folded: bool) -> Row:
    title = space.removeprefix(f"{above}/") if above else space
    return Row(space, "", depth, None, "", count, folded, f"{space}/", f"{title}/")


@lru_cache(maxsize=4)
def _spaces(nodes: tuple[str, ...]) -> dict[str, tuple[str, ...]]:
    """The namespaces of each node, outermost first; only those with several nodes get a row."""
    counts: dict[str, int] = {}
    for node in nodes:
        for space in _above(node):
            counts[space] = counts.get(space, 0) + 1
    found: dict[str, tuple[str, ...]] = {}
    for node in nodes:
        spaces = [space for space in _above(node) if counts[space] > 1]
        # Of nested namespaces with the same nodes, only the innermost is shown.
        found[node] = tuple(
            each for at, each in enumerate(spaces) if at + 1 == len(spaces) or counts[spaces[at + 1]] < counts[each]
        )
    return found


def _above(node: str) -> list[str]:
    parts = node.split("/")[1:-1]
    return ["/" + "/".join(parts[: end + 1]) for end in range(len(parts))]


class _Sorted:
    """The parameters of a node in row order, with the texts that a filter searches."""

    def __init__(self, tree: ParameterTree) -> None:
        self.tree = tree
        self._parameters = sorted(tree.parameters, key=lambda each: _order(each.name))
        self._texts = [_text(each) for each in self._parameters]
        self._lower = [each.lower() for each in self._texts]
        self._own = [at for at, each in enumerate(self._parameters) if not _is_built_in(each.name)]

    def count(self, view: View) -> int:
        """The number of parameters to filter, with or without the built-in ones."""
        return len(self._parameters if view.built_in else self._own)

    def passing(self, view: View) -> list[ParameterInfo]:
        """The parameters that a view shows."""
        found: Iterable[int] = range(len(self._parameters)) if view.built_in else self._own
        if view.query.terms:
            found = self._matching(view.query, found)
        parameters = [self._parameters[at] for at in found]
        return [each for each in parameters if each.changed] if view.only_changed else parameters

    def _matching(self, query: Query, found: Iterable[int]) -> Iterable[int]:
        """The parameters that match each word, as in `Query.matches`, but checking the node's name only once."""
        node = self.tree.node
        if any(term.stands_in(node) is term.exclude for term in query.nodes):
            return ()
        for term in query.texts:
            if term.name is not None and term.name.stands_in(node):
                if term.exclude:
                    return ()
                continue
            plain = term.pattern.plain
            if plain is not None:
                found = [at for at in found if (plain in self._lower[at]) is not term.exclude]
            else:
                found = [at for at in found if term.pattern.search(self._texts[at]) is not term.exclude]
        return found


def _is_built_in(name: str) -> bool:
    return name in BUILT_IN or name.startswith(BUILT_IN_PREFIX)


def row_named(found: Sequence[Row], name: str, cursor: int) -> int | None:
    """The row of a parameter with exactly this name, or else with it as the last level; None if there is none.

    Of several, the one at the cursor is preferred, then the first. A filter also shows rows that merely mention the
    words; a user who types a whole name means that parameter.
    """
    called = [at for at, each in enumerate(found) if each.name.endswith(name) and each.parameter] if name else []
    full = {at: each.parameter.name for at in called if (each := found[at]).parameter}
    named = [at for at in called if full[at] == name]
    named = named or [at for at in called if full[at].endswith((f".{name}", f"/{name}"))]
    return cursor if cursor in named else next(iter(named), None)


def matches(parameter: ParameterInfo, query: Query) -> bool:
    """Whether a parameter matches a filter by its name, description or node."""
    return query.matches(_text(parameter), parameter.node)


def _text(parameter: ParameterInfo) -> str:
    return f"{parameter.name} {parameter.description}"


@lru_cache(maxsize=20_000)
def _parts(name: str) -> tuple[str, ...]:
    """The levels of a name: `lidar.front/noise` has three."""
    return tuple(_SEPARATOR.split(name))


@lru_cache(maxsize=20_000)
def _order(name: str) -> tuple[tuple[bool, NaturalKey], ...]:
    """Sort key: names by their levels, with a level's own entries before those below it."""
    *groups, last = _parts(name)
    return (*((True, natural_key(each)) for each in groups), (False, natural_key(last)))


def _below(
    node: str, parameters: Sequence[ParameterInfo], level: int, depth: int, folded: Collection[str]
) -> Iterator[Row]:
    """The rows of parameters that share their first `level` levels; two or more that share the next one get a group."""
    at = 0
    while at < len(parameters):
        first = parameters[at]
        parts = _parts(first.name)
        end = at + 1
        if len(parts) > level + 1:
            while end < len(parameters) and _shares(parameters[end], parts, level):
                end += 1
        group = parameters[at:end]
        if len(group) > 1:
            yield from _group(node, group, level, depth, folded)
        else:
            yield Row(node, first.name[_start(first.name, level) :], depth, first)
        at = end


def _group(node: str, group: Sequence[ParameterInfo], level: int, depth: int, folded: Collection[str]) -> Iterator[Row]:
    """The row of a group whose parameters share one or more levels, and the rows below it."""
    parts = _parts(group[0].name)
    deepest = level + 1
    while len(parts) > deepest + 1 and all(_shares(each, parts, deepest) for each in group):
        deepest += 1
    prefix = group[0].name[: _start(group[0].name, deepest)]
    fold = f"{node}:{prefix}"
    closed = fold in folded
    yield Row(node, prefix[_start(prefix, level) :], depth, None, "", len(group), closed, fold)
    if not closed:
        yield from _below(node, group, deepest, depth + 1, folded)


def _shares(parameter: ParameterInfo, parts: tuple[str, ...], level: int) -> bool:
    other = _parts(parameter.name)
    return len(other) > level + 1 and other[level] == parts[level]


@lru_cache(maxsize=20_000)
def _start(name: str, level: int) -> int:
    """The position at which a level of a name begins."""
    return sum(len(each) + 1 for each in _parts(name)[:level])
