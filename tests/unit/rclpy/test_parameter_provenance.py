"""A node tells what it declares, in which line, and which override it took."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
import rclpy
from bot_console.runtime.process.facts import anybody_listens, on_fact
from rclpy.context import Context
from rclpy.parameter import Parameter

Reported = dict[str, tuple[Any, ...]]


@pytest.fixture
def reported() -> Iterator[Reported]:
    found: Reported = {}

    def hear(kind: str, facts: Mapping[str, Any]) -> None:
        assert kind == "declared" and facts["node"] == "/n"
        found.update({name: tuple(rest) for name, *rest in facts["parameters"]})

    forget = on_fact(hear)
    yield found
    forget()


def test_default_line_and_the_override_that_counts(reported: Reported, tmp_path: Path) -> None:
    file = tmp_path / "p.yaml"
    file.write_text("/**:\n  ros__parameters:\n    a: 2\n    b: 2\n    c: 2\n")
    context = Context()
    rclpy.init(args=["--ros-args", "--params-file", str(file), "-p", "b:=3"], context=context)
    node = rclpy.create_node("n", context=context, parameter_overrides=[Parameter("c", value=4)])
    node.declare_parameters("", [("a", 1), ("b", 1), ("c", 1), ("d", 1)])
    node.declare_parameter("e", [1.0, 2.0])
    node.destroy_node()
    context.shutdown()
    sources = {name: reported[name][2] for name in "abcde"}
    assert sources == {"a": str(file), "b": "-p", "c": "parameter_overrides of its program", "d": "", "e": ""}
    assert reported["a"][0] == 1 and reported["e"][0] == [1.0, 2.0]
    assert [reported[name][3] for name in "abcd"] == [2, 3, 4, 1], "the value at the start"
    places = {reported[name][1] for name in "abcd"}
    assert len(places) == 1
    path, _, line = places.pop().rpartition(":")
    assert path == __file__
    assert 'declare_parameters("", [("a"' in Path(path).read_text().splitlines()[int(line) - 1]


def test_a_later_file_and_a_later_word_count(reported: Reported, tmp_path: Path) -> None:
    first, second = tmp_path / "1.yaml", tmp_path / "2.yaml"
    for each in (first, second):
        each.write_text("n:\n  ros__parameters:\n    a: 2\n")
    context = Context()
    words = ["--ros-args", "-p", "a:=1", "--params-file", str(first), "--params-file", str(second)]
    rclpy.init(args=words, context=context)
    with rclpy.create_node("n", context=context) as node:
        node.declare_parameter("a", 0)
    context.shutdown()
    # A plain -p stands under /**, which came first; a node's own key comes behind it.
    assert reported["a"][2] == str(second)


def test_nothing_is_worked_out_where_nobody_listens() -> None:
    assert not anybody_listens()
