"""The tree of processes."""

from __future__ import annotations

from bot_console.tui.console.model import LaunchInfo, ProcessInfo, ProcessState
from bot_console.tui.panes.launch.rows import rows, short_names


def process(key: str, *group: str, state: ProcessState = ProcessState.RUNNING) -> ProcessInfo:
    return ProcessInfo(key, key, state, group=group)


def row_texts(info: LaunchInfo, folded: tuple[tuple[str, ...], ...] = ()) -> list[str]:
    return ["  " * row.depth + (row.process.key if row.process else row.group[-1]) for row in rows(info, folded)]


INFO = LaunchInfo(
    processes=(process("a", "f"), process("b", "f", "g"), process("c", "h"), process("d", "f"), process("e", "f", "g"))
)


def test_groups_follow_the_processes_beside_them() -> None:
    assert row_texts(INFO) == ["f", "  a", "  d", "  g", "    b", "    e", "h", "  c"]


def test_folded_group_hides_its_processes() -> None:
    assert row_texts(INFO, (("f", "g"),)) == ["f", "  a", "  d", "  g", "h", "  c"]
    assert row_texts(INFO, (("f",),)) == ["f", "h", "  c"]


def test_group_counts_its_running_processes() -> None:
    info = LaunchInfo(processes=(process("a", "f"), process("b", "f", "g", state=ProcessState.CRASHED)))
    head = rows(info)[0]
    assert (head.running, head.count) == (1, 2)


def test_processes_without_a_group_are_not_indented() -> None:
    assert row_texts(LaunchInfo(processes=(process("a"), process("b", "f")))) == ["a", "f", "  b"]


def test_nodes_of_one_namespace_are_named_without_it() -> None:
    assert short_names(("/robot1/lidar", "/robot1/base")) == ("/robot1/", "lidar", "base")
    assert short_names(("/robot1/lidar", "/base")) == ("/robot1/lidar", "/base")
    assert short_names(("/lidar", "/base")) == ("/lidar", "/base")
    assert short_names(("/robot1/lidar",)) == ("/robot1/lidar",)
