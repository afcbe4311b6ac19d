"""The tree of processes: launch files, groups, processes."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.model import LaunchInfo, ProcessInfo, ProcessState
from bot_console.tui.panes.launch.follow import CPU_SAMPLES, Follower, ProcessActivity
from bot_console.tui.text.bars import strip
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.item_list import ItemList
from rich.cells import cell_len
from rich.segment import Segment

STATES = {
    ProcessState.STARTING: ("◌", "dim"),
    ProcessState.RUNNING: ("●", "good"),
    ProcessState.STOPPING: ("◐", "warn"),
    ProcessState.EXITED: ("○", "dim"),
    ProcessState.CRASHED: ("✗", "error"),
    ProcessState.MISSING: ("∅", "warn"),
    ProcessState.ABANDONED: ("⚠", "warn"),
}

MIN_CELLS_FOR_WORDS = 110
"""Minimum cells of a row that writes `error` and `warning` out."""
MIN_CELLS_FOR_NODES = 12
"""Minimum cells left in a row that names the nodes of a process."""
MIN_CELLS_FOR_TRACE = 84
"""Minimum cells of a row that shows the CPU usage over time."""
MIN_CELLS_FOR_PID = 84
"""Minimum cells of a row with the process id, and with the exit code of an earlier run; the details show both."""
STATE_CELLS, PID_CELLS, RESTARTS_CELLS = 12, 8, 5
"""Cells of the state, and of the process id and the number of restarts if any process has one."""


@dataclass(frozen=True)
class Row:
    """A group by its path, or a process."""

    group: tuple[str, ...]
    process: ProcessInfo | None = None
    count: int = 0
    running: int = 0
    folded: bool = False

    @property
    def depth(self) -> int:
        """The indentation level."""
        return len(self.group) - (0 if self.process else 1)


def rows(info: LaunchInfo, folded: Collection[tuple[str, ...]] = ()) -> list[Row]:
    """The rows of the tree, with groups in the order of their first processes."""
    found: list[Row] = []
    seen: set[tuple[str, ...]] = set()
    by_group: dict[tuple[str, ...], list[ProcessInfo]] = {}
    for process in info.processes:
        for depth in range(1, len(process.group) + 1):
            by_group.setdefault(process.group[:depth], []).append(process)
    for process in _sorted_by_group(info.processes):
        for depth in range(1, len(process.group) + 1):
            group = process.group[:depth]
            if group not in seen and not _inside(group[:-1], folded):
                inside = by_group[group]
                running = sum(each.state is ProcessState.RUNNING for each in inside)
                found.append(Row(group, None, len(inside), running, group in folded))
            seen.add(group)
        if not _inside(process.group, folded):
            found.append(Row(process.group, process))
    return found


def matches(process: ProcessInfo, query: Query) -> bool:
    """Whether a process passes a filter by its name, state or groups, or by any of its nodes."""
    text = " ".join((process.label, process.state.value, *process.group, *process.nodes))
    return any(query.matches(text, node) for node in process.nodes or ("",))


def _sorted_by_group(processes: Sequence[ProcessInfo]) -> list[ProcessInfo]:
    """Sort processes so that each group follows the processes beside it; otherwise keep their order."""
    first: dict[tuple[str, ...], int] = {}
    for at, process in enumerate(processes):
        for depth in range(len(process.group) + 1):
            first.setdefault(process.group[:depth], at)
    keys = {each.key: [first[each.group[:depth]] for depth in range(1, len(each.group) + 1)] for each in processes}
    return sorted(processes, key=lambda each: keys[each.key])


def _inside(group: tuple[str, ...], folded: Collection[tuple[str, ...]]) -> bool:
    return any(group[:depth] in folded for depth in range(1, len(group) + 1))


def _activity_texts(followed: ProcessActivity, width: int) -> tuple[str, str, str]:
    """The CPU usage over time as bars, and the numbers of errors and of warnings."""
    return strip(followed.cpu, 1.0), *_counts(followed, width)


def _counts(followed: ProcessActivity, width: int) -> tuple[str, str]:
    """The numbers of errors and of warnings, with the words written out if there is room."""

    def text(number: int, word: str) -> str:
        return (
            ""
            if not number
            else counted(number, word)
            if width >= MIN_CELLS_FOR_WORDS
            else f"{number} {word[0].upper()}"
        )

    return text(followed.errors, "error"), text(followed.warnings, "warning")


def _node_words(process: ProcessInfo) -> str:
    return sanitize("  " + " ".join(short_names(process.nodes))) if process.nodes else ""


def _restarts(process: ProcessInfo) -> str:
    return f"↻{process.restarts}" if process.restarts or process.restart_policy else ""


def _cells_of_counts(*counts: str) -> int:
    """The cells of these numbers of errors and warnings, each with a gap before it."""
    return sum(2 + len(each) for each in counts if each)


def short_names(nodes: Sequence[str]) -> Sequence[str]:
    """Node names; if all are in the same namespace, the namespace once and then the names without it."""
    spaces = {each.rpartition("/")[0] for each in nodes}
    if len(nodes) < 2 or len(spaces) > 1 or not (space := spaces.pop()):
        return nodes
    return f"{space}/", *(each.rpartition("/")[2] for each in nodes)


class ProcessRows(ItemList[Row]):
    """The rows of the tree."""

    lifecycle: Mapping[str, str] = {}
    """The states of lifecycle nodes."""

    def __init__(self, follower: Follower) -> None:
        super().__init__()
        self._follower = follower
        self._drawn: dict[str, tuple[str, str, str]] = {}
        """The parts of the rows that come from the follower, as drawn, by the key of the process."""
        self._counts = 0
        """Cells of the numbers of errors and warnings when they were last drawn."""

    def follow(self) -> None:
        """Redraw the rows with new measurements, or all rows if the width of a column changes."""
        width = self.across
        counts = self._count_cells(width)
        if counts != self._counts:
            self._counts = counts
            self.refresh()
        for index, each in enumerate(self.rows):
            key = each.process.key if each.process else ""
            if key and self._drawn.get(key) != (drawn := _activity_texts(self._follower.of(key), width)):
                self._drawn[key] = drawn
                self.row_changed(index)

    def key(self, item: Row) -> object:
        """The process or group of a row."""
        return item.process.key if item.process else item.group

    def matches(self, index: int, query: Query) -> bool:
        """Whether a process matches a filter; groups never do."""
        process = self.rows[index].process
        return process is not None and matches(process, query)

    def row(self, index: int, width: int) -> list[Segment]:
        """A group, or a process with state, name, pid, restarts and last exit code."""
        row = self.rows[index]
        indent = "  " * row.depth
        if row.process is None:
            arrow = "▸" if row.folded else "▾"
            summary = f"  {row.running} of {row.count} running"
            return [
                Segment(f"{indent}{arrow} {sanitize(row.group[-1])}", self.row_style("head")),
                Segment(summary, self.row_style("warn" if row.running < row.count else "dim")),
            ]
        return self._process(row.process, indent, width)

    def _process(self, process: ProcessInfo, indent: str, width: int) -> list[Segment]:
        glyph, style = STATES[process.state]
        head, (pids, restarts) = f"{indent}{glyph}", self._optional_cells(width)
        names = self._names(width - STATE_CELLS - pids)
        name = cut(f"{head} {sanitize(process.label)}", names, pad=True)
        columns = [f"  {process.state.value:<10}", f"{process.pid or '':>{pids}}" if pids else ""]
        columns.append(f"{_restarts(process):>{restarts}}" if restarts else "")
        trace, errors, warnings = _activity_texts(self._follower.of(process.key), width)
        states = max((len(self._states(each.process)) for each in self.rows if each.process), default=0)
        count_cells = self._count_cells(width)
        fixed = names + STATE_CELLS + pids + restarts + count_cells
        room = width - fixed - states
        usage = "".join((self._states(process).ljust(states), *self._usage(process, trace, width, room)))
        is_past = process.state is ProcessState.RUNNING and width < MIN_CELLS_FOR_PID
        exit_code = "" if process.exit_code is None or is_past else f"  exit {process.exit_code}"
        problem = f"  {sanitize(process.problem)}" if process.problem and (not exit_code or width >= 60) else ""
        end = exit_code.ljust(len(usage)) if not usage.strip() else exit_code + usage
        used = fixed + cell_len(end)
        left = width - used - cell_len(problem)
        nodes = cut(_node_words(process), left) if left >= MIN_CELLS_FOR_NODES else ""
        if problem and used + cell_len(nodes + problem) > width:
            # In a row that is too narrow, the problem replaces empty columns and everything after them.
            end, nodes, problem, count_cells = (end if usage.strip() else exit_code) + problem, "", "", 0
        columns.append(end)
        plain = None if process.state is ProcessState.RUNNING else self.row_style(style)
        loud = [Segment(name[: len(head)], self.row_style(style)), Segment(name[len(head) :], plain)]
        blank = " " * (count_cells - _cells_of_counts(errors, warnings))
        counts = (
            Segment(f"  {errors}" if errors else "", self.row_style("error")),
            Segment(f"  {warnings}" if warnings else "", self.row_style("warn")),
            Segment(blank),
        )
        return [
            *loud,
            Segment("".join(columns), plain),
            *counts,
            Segment(nodes, self.row_style("dim")),
            Segment(problem, plain),
        ]

    def _count_cells(self, width: int) -> int:
        """Cells to reserve for the numbers of errors and warnings, so that node names are aligned."""
        every = (_counts(self._follower.of(each.process.key), width) for each in self.rows if each.process)
        return max((_cells_of_counts(*each) for each in every), default=0)

    def _states(self, process: ProcessInfo) -> str:
        """The states of the lifecycle nodes of a running process."""
        if process.state is not ProcessState.RUNNING:
            return ""
        return "".join(f"  {sanitize(self.lifecycle[each])}" for each in process.nodes if each in self.lifecycle)

    def _usage(self, process: ProcessInfo, trace: str, width: int, room: int) -> list[str]:
        """CPU and memory as far as they fit into `room` cells; blank if only other processes have them, so that the
        columns are aligned.
        """
        every = [each.process for each in self.rows if each.process is not None]
        columns: list[str] = []
        if width >= 60 and any(each.cpu is not None for each in every):
            columns.append("" if process.cpu is None else f"  {f'{process.cpu:.0%}':>4} CPU")
            if width >= MIN_CELLS_FOR_TRACE:
                columns.append("" if process.cpu is None else f" {trace:>{CPU_SAMPLES}}")
        if width >= 76 and any(each.memory is not None for each in every):
            columns.append("" if process.memory is None else f"  {f'{process.memory} MB':>6}")
        widths = (10, 1 + CPU_SAMPLES, 8)[: len(columns)] if width >= MIN_CELLS_FOR_TRACE else (10, 8)
        fitting = [each <= room for each in accumulate(widths)]
        return [each.ljust(cells) for each, cells, fits in zip(columns, widths, fitting, strict=False) if fits]

    def _optional_cells(self, width: int) -> tuple[int, int]:
        """Cells of the process ids and of the numbers of restarts; 0 if no process has one."""
        every = [each.process for each in self.rows if each.process is not None]
        return (
            PID_CELLS if width >= MIN_CELLS_FOR_PID and any(each.pid for each in every) else 0,
            RESTARTS_CELLS if any(_restarts(each) for each in every) else 0,
        )

    def _names(self, room: int) -> int:
        """Cells of the name column: as many as the longest name needs, up to `room`."""
        labels = ((each.depth, each.process.label) for each in self.rows if each.process is not None)
        longest = max((2 * depth + 2 + cell_len(sanitize(label)) for depth, label in labels), default=0)
        return max(14, min(longest, room))
