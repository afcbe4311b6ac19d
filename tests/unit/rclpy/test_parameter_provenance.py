"""A node reports which parameters it declares, on which line, and which override applied."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
import rclpy
from bot_console.runtime.process.reported_facts import anybody_listens, on_fact
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


def test_report_has_default_line_and_effective_override(reported: Reported, tmp_path: Path) -> None:
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


def test_later_file_or_argument_takes_precedence(reported: Reported, tmp_path: Path) -> None:
    first, second = tmp_path / "1.yaml", tmp_path / "2.yaml"
    for each in (first, second):
        each.write_text("n:\n  ros__parameters:\n    a: 2\n")
    context = Context()
    words = ["--ros-args", "-p", "a:=1", "--params-file", str(first), "--params-file", str(second)]
    rclpy.init(args=words, context=context)
    with rclpy.create_node("n", context=context) as node:
        node.declare_parameter("a", 0)
    context.shutdown()
    # A plain -p belongs to /**, which came first; a node's own key comes after it.
    assert reported["a"][2] == str(second)


def test_report_is_not_composed_without_listeners() -> None:
    assert not anybody_listens()
