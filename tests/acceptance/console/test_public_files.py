"""Parameter files structured like those of five public packages: shown, applied to nodes that declare them, saved."""

from __future__ import annotations

import contextlib
import itertools
import threading
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
import rclpy
from bot_console.tui.console.model import Value
from bot_console.tui.console.parameters.file.text import sections, value_at
from bot_console.tui.console.ros_console import RosConsole
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rigs import TIMEOUT_S, until

FILES = sorted((Path(__file__).parents[2] / "unit/tui/console/parameters/public").glob("*.yaml"))
DOMAINS = itertools.count(8300)
SPACE_TAKER = "/some_node"
"""The node that takes the place of a wildcard."""

Values = Mapping[str, Mapping[str, Value]]


def values_of(path: Path) -> dict[str, dict[str, Value]]:
    """The values in a file, by node."""
    found: dict[str, dict[str, Value]] = {}
    for section in sections(path.read_text()):
        node = SPACE_TAKER if "*" in section.key else section.key
        found.setdefault(node, {}).update({name: value_at(name, at) for name, at in section.places.items()})
        found[node].pop("use_sim_time", None)  # Every node already has it.
    return found


def different_value(value: Value) -> Value:
    """A different value of the same type."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, tuple):
        return (*value[:-1], different_value(value[-1]))  # type: ignore[return-value]
    return f"{value}_2" if isinstance(value, str) else value + 1  # type: ignore[operator]


def plain(value: object) -> object:
    return value if isinstance(value, str) or not hasattr(value, "__len__") else tuple(value)  # type: ignore[arg-type]


class Package:
    """Nodes that declare the parameters of a file with different values, and a console."""

    def __init__(self, values: Values, domain: int) -> None:
        self._context = Context()
        rclpy.init(args=[], context=self._context, domain_id=domain)
        self._executor = SingleThreadedExecutor(context=self._context)
        self.nodes: dict[str, Node] = {}
        for full, declared in values.items():
            space, _, name = full.rpartition("/")
            node = self.nodes[full] = rclpy.create_node(name, namespace=space or None, context=self._context)
            for each, value in declared.items():
                node.declare_parameter(each, different_value(value))
            self._executor.add_node(node)
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()

    def _spin(self) -> None:
        with contextlib.suppress(ExternalShutdownException):
            self._executor.spin()

    def values(self) -> dict[tuple[str, str], object]:
        """The values of all parameters that the nodes themselves declare."""
        given = ("use_sim_time", "start_type_description_service")
        return {
            (full, name): plain(each.value)
            for full, node in self.nodes.items()
            for name, each in node.get_parameters_by_prefix("").items()
            if name not in given
        }

    def close(self) -> None:
        """End them."""
        self._executor.shutdown(timeout_sec=1.0)
        for each in self.nodes.values():
            each.destroy_node()
        self._context.try_shutdown()
        self._thread.join(TIMEOUT_S)


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> int:
    number = next(DOMAINS)
    monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
    return number


@pytest.fixture
def console(domain: int, tmp_path: Path) -> Iterator[RosConsole]:
    made = RosConsole(profile_folders=[tmp_path / "none"], own_profiles=tmp_path / "own")
    made.start()
    assert made.wait_ready(TIMEOUT_S)
    yield made
    made.close()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_file_is_shown_applied_and_saved_with_one_line_changed(
    path: Path, tmp_path: Path, console: RosConsole, domain: int
) -> None:
    values = values_of(path)
    wanted = {(node, name): value for node, found in values.items() for name, value in found.items()}
    package = Package(values, domain)
    try:
        trees = until(lambda: _all_read(console, values), "the parameters of all nodes")
        assert len(trees) >= len(values)
        assert console.profiles.open(str(path)).ok
        seen = {(each.node, each.name): each.then for each in console.profiles.differences(path.stem)}
        assert seen == wanted and len(seen) > 3
        assert all(each.accepted for each in console.profiles.apply(path.stem).result(TIMEOUT_S))
        assert package.values() == wanted
        _saved_with_one_line_changed(path, tmp_path / path.name, console, values)
    finally:
        package.close()


def _all_read(console: RosConsole, values: Values) -> Mapping[str, object]:
    trees = console.snapshot().parameters
    there = all(node in trees and all(trees[node].get(each) for each in found) for node, found in values.items())
    return trees if there else {}


def _saved_with_one_line_changed(path: Path, copy: Path, console: RosConsole, values: Values) -> None:
    node = next(iter(values))
    if node == SPACE_TAKER:
        return  # It is saved in a separate section, since the wildcard applies to other nodes too.
    name, value = next((name, value) for name, value in values[node].items() if isinstance(value, (int, float)))
    copy.write_text(path.read_text())
    assert all(each.accepted for each in console.parameters.set(node, {name: different_value(value)}).result(TIMEOUT_S))
    until(lambda: console.snapshot().parameters[node].get(name).value == different_value(value), "the new value")
    assert console.parameters.save(str(copy), (node,)).ok
    before, after = path.read_text().splitlines(), copy.read_text().splitlines()
    assert len(before) == len(after)
    assert sum(one != two for one, two in zip(before, after, strict=True)) == 1
