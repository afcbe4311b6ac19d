"""The tree of processes."""

from __future__ import annotations

from bot_console.tui.console.model import LaunchInfo, ProcessInfo, ProcessState
from bot_console.tui.panes.launch.rows import rows


def process(key: str, *group: str, state: ProcessState = ProcessState.RUNNING) -> ProcessInfo:
    return ProcessInfo(key, key, state, group=group)


def shape(info: LaunchInfo, folded: tuple[tuple[str, ...], ...] = ()) -> list[str]:
    return ["  " * row.depth + (row.process.key if row.process else row.group[-1]) for row in rows(info, folded)]


INFO = LaunchInfo(
    processes=(process("a", "f"), process("b", "f", "g"), process("c", "h"), process("d", "f"), process("e", "f", "g"))
)


def test_groups_stand_together_below_the_processes_beside_them() -> None:
    assert shape(INFO) == ["f", "  a", "  d", "  g", "    b", "    e", "h", "  c"]


def test_a_closed_group_hides_what_is_in_it() -> None:
    assert shape(INFO, (("f", "g"),)) == ["f", "  a", "  d", "  g", "h", "  c"]
    assert shape(INFO, (("f",),)) == ["f", "h", "  c"]


def test_a_group_counts_what_runs_below_it() -> None:
    info = LaunchInfo(processes=(process("a", "f"), process("b", "f", "g", state=ProcessState.CRASHED)))
    head = rows(info)[0]
    assert (head.running, head.count) == (1, 2)


def test_processes_without_a_group_stand_at_the_left() -> None:
    assert shape(LaunchInfo(processes=(process("a"), process("b", "f")))) == ["a", "f", "  b"]
