"""Node keys, nesting and precedence compared with straightforward restatements of the rules."""

import re
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import yaml
from bot_console.runtime.rmw.parameter_node_keys import key_matches
from bot_console.runtime.rmw.parameter_precedence import ParameterTable
from hypothesis import given
from hypothesis import strategies as st

tokens = st.sampled_from(["a", "b", "ab"])
nodes = st.lists(tokens, min_size=1, max_size=4).map(lambda parts: "/" + "/".join(parts))
keys = st.lists(tokens | st.sampled_from(["*", "**"]), min_size=1, max_size=4).map("/".join)


def matches_by_token(pattern: list[str], parts: list[str]) -> bool:
    """Match token by token: `*` is one name, `**` any number of names."""
    if not pattern:
        return not parts
    if pattern[0] == "**":
        return any(matches_by_token(pattern[1:], parts[count:]) for count in range(len(parts) + 1))
    return bool(parts) and pattern[0] in ("*", parts[0]) and matches_by_token(pattern[1:], parts[1:])


@given(keys, nodes, st.booleans())
def test_keys_match_token_by_token(key: str, node: str, absolute: bool) -> None:
    assert key_matches(f"/{key}" if absolute else key, node) == matches_by_token(key.split("/"), node.split("/")[1:])


names = st.sampled_from(["p", "q", "r"])
scalars = st.booleans() | st.integers(-5, 5) | st.sampled_from([0.5, -2.0]) | st.sampled_from(["x", "y"])
values = scalars | st.sampled_from([[1, 2], ["x"], [0.5], [True]])
sections = st.lists(st.tuples(keys, names, values), max_size=6)
files = st.lists(sections, max_size=3)
RANKS = [
    (bool, False),
    (int, False),
    (float, False),
    (str, False),
    (bool, True),
    (int, True),
    (float, True),
    (str, True),
]


def rank(value: Any) -> int:
    """The precedence of a type among the values that one key holds for a parameter."""
    is_list = isinstance(value, list)
    return RANKS.index((type(value[0] if is_list else value), is_list))


def expected(given_files: Any, node: str) -> dict[str, Any]:
    """Keys in order of first appearance; within a key, the type that ranks first, and its last value."""
    order: dict[str, dict[str, list[Any]]] = {}
    for file in given_files:
        for key, name, value in file:
            order.setdefault(key, {}).setdefault(name, []).append(value)
    found: dict[str, Any] = {}
    for key, parameters in order.items():
        if matches_by_token(key.split("/"), node.split("/")[1:]):
            for name, history in parameters.items():
                best = min(map(rank, history))
                found[name] = [value for value in history if rank(value) == best][-1]
    return found


@given(files, nodes)
def test_precedence_follows_the_order_of_keys_and_types(given_files: Any, node: str) -> None:
    table = ParameterTable()
    with TemporaryDirectory() as folder:
        for number, file in enumerate(given_files):
            path = Path(folder) / f"{number}.yaml"
            path.write_text(
                "".join(f"{key!r}: {{ros__parameters: {{{name}: {value!r}}}}}\n" for key, name, value in file)
            )
            table.add_file(str(path))
    found = table.for_node(node)
    wanted = expected(given_files, node)
    assert {name: (type(each), each) for name, each in found.items()} == {
        name: (type(each), each) for name, each in wanted.items()
    }


@given(st.lists(st.tuples(st.sampled_from(["/**", "n", "m"]), names, scalars), max_size=6))
def test_command_line_and_files_follow_the_same_rules(rules: Any) -> None:
    table = ParameterTable()
    for key, name, value in rules:
        table.add_value(key, name, repr(value))
    wanted = expected([[(key.lstrip("/"), name, value) for key, name, value in rules]], "/n")
    assert table.for_node("/n") == wanted


trees = st.recursive(
    st.integers(-9, 9), lambda below: st.dictionaries(names, below, min_size=1, max_size=3), max_leaves=8
).filter(lambda tree: isinstance(tree, dict))


def leaves(tree: Any, path: str = "") -> dict[str, int]:
    if not isinstance(tree, dict):
        return {path: tree}
    found: dict[str, int] = {}
    for name, below in tree.items():
        found.update(leaves(below, f"{path}.{name}" if path else name))
    return found


@given(trees, st.booleans())
def test_nested_maps_become_dotted_names(tree: Any, flow: bool) -> None:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "f.yaml"
        path.write_text(yaml.safe_dump({"n": {"ros__parameters": tree}}, default_flow_style=flow, sort_keys=False))
        table = ParameterTable()
        table.add_file(str(path))
    assert table.for_node("/n") == leaves(tree)
    assert not re.search(r"\.\.|\.$", "".join(table.for_node("/n")))
