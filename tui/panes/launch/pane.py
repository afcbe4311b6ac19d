"""The launch pane: processes as a tree, started and stopped one by one; launch files opened with arguments."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.filter_syntax import Query, parse
from bot_console.tui.console.model import (
    ConsoleSnapshot,
    LaunchEvent,
    LaunchInfo,
    ProcessInfo,
    ProcessState,
)
from bot_console.tui.files.folders import expanded_path
from bot_console.tui.format import clock_text
from bot_console.tui.panes.launch.follow import Follower
from bot_console.tui.panes.launch.output import STYLES, ProcessOutput, rule
from bot_console.tui.panes.launch.rows import ProcessRows, Row, matches, rows
from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.panes.pane import answer_of
from bot_console.tui.panes.transitions import ask_transition, state_text
from bot_console.tui.safety.stop_wording import ended_lock_warning
from bot_console.tui.screens.facts import FactsScreen
from bot_console.tui.text.counted import counted
from bot_console.tui.text.endings import ending_text
from bot_console.tui.text.redraw_interval import is_due
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.picture import Line, Picture
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Choice, Confirmation, Form, Option, matching_options
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from textual.app import ComposeResult

MAX_EVENTS = 4
"""Launch events shown below the tree."""
MAX_EVENTS_IN_FEW_ROWS, MIN_ROWS_FOR_ALL_EVENTS = 2, 30
"""Launch events shown if the pane has fewer rows than `MIN_ROWS_FOR_ALL_EVENTS`."""
MIN_ROWS_FOR_OUTPUT = 19
"""Minimum rows of the pane to show the output of the process at the cursor."""

ALIVE = (ProcessState.RUNNING, ProcessState.STARTING, ProcessState.STOPPING)
NEWS_S = 2.0
"""Minimum seconds between two updates of output and usage; a line after that much silence is shown at once."""

EMPTY = Placeholder(
    "The processes of launch files are listed here, to stop and start one by one; nothing has been launched yet.",
    (("o", "Open a launch file"), ("3", "See the running nodes"), ("?", "Help")),
)


class LaunchPane(ListPane):
    """Processes of all launch files."""

    TITLE = "Launch"
    HELP = (
        "What the launch files have started: state, process id, restarts and last exit code. On a launch file or a\n"
        "group, start, stop, restart and kill mean all of its processes. o opens a launch file and asks for its\n"
        "arguments; several can run at once. E and W count errors and warnings; below the tree are the lines that\n"
        "the process at the cursor logged and printed last."
    )
    BINDINGS = keymap.bindings("launch")

    wall_clock: Callable[[], int] = staticmethod(time.time_ns)
    """Time in ns since the epoch; tests replace it with a clock that they step."""
    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s), replaced in tests."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._info: LaunchInfo | None = None
        self._why_not = ""
        self._elsewhere = ""
        self._problem = ""
        self._read = ""
        self._folded: frozenset[tuple[str, ...]] = frozenset()
        self._follower = Follower()
        self._has_lines = self._has_usage = False
        """Whether the follower has gathered lines, or CPU usage, that are not shown yet."""
        self._news_at = self._lines_at = float("-inf")

    def compose(self) -> ComposeResult:
        """The tree, the status and the output of the process at the cursor, the newest events, and a prompt."""
        yield ProcessRows(self._follower)
        yield StaticText(id="launch-status")
        yield ProcessOutput(id="launch-output")
        yield Picture(id="launch-events")
        yield Prompt(id="launch-prompt")

    @property
    def _list(self) -> ProcessRows:
        return self.query_one(ProcessRows)

    def go_to(self, name: str) -> None:
        """Go to the process of a node."""
        rows = self._list.rows
        at = next((index for index, each in enumerate(rows) if each.process and name in each.process.nodes), None)
        if at is not None:
            self._list.cursor = at

    def focus_target(self) -> None:
        """Focus the tree."""
        self._list.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Redraw the processes if they are a different object."""
        why_not = snapshot.capabilities.launch or (
            "" if self.console.launcher else "this console was started without a launcher"
        )
        self._elsewhere = snapshot.capabilities.launched_elsewhere
        if snapshot.graph.lifecycle != self._list.lifecycle:
            self._list.lifecycle = snapshot.graph.lifecycle
            self._list.refresh()
        state = (snapshot.launch, why_not, snapshot.problem)
        if state[0] is not self._info or state[1:] != (self._why_not, self._problem):
            self._info, self._why_not, self._problem = state
            self._arrange()
            self._show_output()
        self.observe(snapshot)  # the console does not call it before the first parts are made
        self._has_lines |= self._follower.read(snapshot.logs, self.console.logs.record)
        self._show_news()

    def observe(self, snapshot: ConsoleSnapshot) -> None:
        """Sample the CPU usage, also while hidden."""
        if not self.has_parts:
            return
        processes = snapshot.launch.processes
        self._follower.update_processes(processes)
        self._has_usage |= self._follower.sample(processes, self.clock())

    def _show_news(self) -> None:
        """Show what the processes have printed and used since the last update, at most every `NEWS_S`."""
        now = self.clock()
        after_silence = self._has_lines and now - self._lines_at >= NEWS_S
        if after_silence or ((self._has_lines or self._has_usage) and is_due(self._news_at, now, NEWS_S)):
            self._news_at = now
            self._lines_at = now if self._has_lines else self._lines_at
            self._has_lines = self._has_usage = False
            self._list.follow()
            self._show_output()

    def _show_output(self) -> None:
        """Show the newest lines of the process at the cursor, or of the processes of the group there."""
        row, info = self._list.current, self._info or LaunchInfo()
        inside = [each.key for each in info.processes if row and _belongs(each, row.group)]
        keys = [row.process.key] if row and row.process else inside
        lines = (line for key in keys for line in self._follower.of(key).lines)
        name = "" if row is None else sanitize(row.process.label if row.process else row.group[-1])
        self.query_one(ProcessOutput).show_lines(name, lines, named=row is not None and row.process is None)

    def _arrange(self) -> None:
        info = self._info or LaunchInfo()
        self._make_room()
        there = tuple(each for each in info.processes if matches(each, self._query))
        self._list.exchange(rows(replace(info, processes=there), self._folded))
        self.report_filter(len(there), len(info.processes))
        self._report()
        self._show_events()

    def _show_events(self) -> None:
        info = self._info or LaunchInfo()
        stamp = self.time_cursor.stamp
        until = [each for each in info.timeline if stamp is None or each.stamp <= stamp]
        events = self.query_one("#launch-events", Picture)
        width = events.size.width
        lines: list[Line] = [
            ((cut(f" {event_text(each)}", width), STYLES.get(each.severity, "dim")),) for each in until[-MAX_EVENTS:]
        ]
        if stamp is not None:
            lines = [*lines[1 - MAX_EVENTS :], ((f" ◆ {clock_text(stamp)}", "accent"),)]
        lines = lines[-MAX_EVENTS_IN_FEW_ROWS:] if self.size.height < MIN_ROWS_FOR_ALL_EVENTS else lines
        if lines and self.has_class("with-output"):
            lines.insert(0, rule("newest events, t lists all", width))
        events.styles.height = len(lines)
        events.set_lines(lines)

    def on_picture_resized(self, event: Picture.Resized) -> None:
        """Cut the events and the output to the new width."""
        event.stop()
        self._show_events()
        self._show_output()

    def time_moved(self, stamp: int | None) -> None:
        """Show the events up to another moment."""
        if not self.is_ending:
            self._show_events()

    def _report(self) -> None:
        info, row = self._info or LaunchInfo(), self._list.current
        self._list.show_placeholder(FILTERED_OUT if info.processes else EMPTY)
        if self._why_not and not info.processes:
            text = self._why_not
        elif info.problem and info.problem != self._read:
            text = info.problem
        elif row is None:
            text = "" if info.processes else self._problem or self._elsewhere
        elif row.process is None:
            text = f"{' / '.join(row.group)}  {counted(row.count, 'process')}"
        else:
            text = self._about(row.process)
        status = self.query_one("#launch-status", StaticText)
        status.show_or_hide(text)
        status.set_class(bool(text) and text == info.problem, "wrong")

    def _about(self, process: ProcessInfo) -> str:
        """Describe a process: how it ended, what is wrong with it, or which nodes it has."""
        ending = ending_text(process, self.wall_clock())
        name = process.nodes[0] if len(process.nodes) == 1 else process.label
        if ending:
            return f"{name} {ending}" + (f"  {process.problem}" if process.problem else "")
        states = self._list.lifecycle
        nodes = (f"{each} ({state_text(states[each])})" if each in states else each for each in process.nodes)
        about = f"{process.label}  {' '.join(nodes)}"
        if process.started_by:
            about = f"read-only: started by {process.started_by}  {' '.join(process.nodes)}"
        return process.problem or about

    def tick(self) -> None:
        """Show output that is due, and how long ago the process at the cursor ended."""
        if not self.display:
            return
        self._show_news()
        row = self._list.current
        if row is not None and row.process is not None and row.process.ended:
            self._report()

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Describe the process at the cursor; the problem of an earlier launch counts as read."""
        event.stop()
        self._read = (self._info or LaunchInfo()).problem
        self._report()
        self._show_output()

    def on_resize(self) -> None:
        """Hide the events, and the output, if the pane is too low for them."""
        self.set_class(self.size.height < 12, "short")
        self._make_room()

    def _make_room(self) -> None:
        """Show the output if there are processes and the pane is high enough."""
        info = self._info or LaunchInfo()
        before = self.has_class("with-output")
        self.set_class(self.size.height >= MIN_ROWS_FOR_OUTPUT and bool(info.processes), "with-output")
        if self.has_parts and self.has_class("with-output") != before:
            self._show_events()

    def action_fold(self, closed: bool) -> None:
        """Fold or unfold the group at the cursor."""
        row = self._list.current
        if row is None:
            return
        self._folded = self._folded | {row.group} if closed else self._folded - {row.group}
        self._arrange()
        heads = (
            index for index, each in enumerate(self._list.rows) if each.process is None and each.group == row.group
        )
        if closed:
            self._list.cursor = next(heads, 0)

    def action_detail(self) -> None:
        """Show everything about the process at the cursor; fold or unfold a group."""
        row = self._list.current
        if row is None:
            return
        if row.process is None:
            self.action_fold(not row.folded)
        else:
            self.host.push_screen(FactsScreen(row.process.label, facts(row.process, self._info or LaunchInfo())))

    def action_timeline(self) -> None:
        """List all launch events, newest first; choosing one moves the time cursor to it."""
        events = {str(each.seq): each for each in reversed((self._info or LaunchInfo()).timeline)}

        def go(seq: str) -> None:
            self.time_cursor.move(events[seq].stamp, self)
            self.time_moved(events[seq].stamp)

        find = partial(matching_options, [Option(event_text(each), value=seq) for seq, each in events.items()])
        hint = "type to filter, Enter shows that moment in Logs, Plot and World"
        empty = "No event matches." if events else "Nothing has been launched yet."
        self.ask(Choice("Launch events", go, find=find, hint=hint, empty=empty))

    def action_do(self, verb: str) -> None:
        """Start, stop, restart or kill the process or group at the cursor."""
        row = self._list.current
        if row is None or self.console.launcher is None or not self.may_change():
            return
        chosen = self._controlled(row)
        if not chosen:
            return
        if row.process is None:
            chosen = [each for each in chosen if not is_pointless(verb, each)]
            if not chosen:
                self.notify(f"{sanitize(row.group[-1])}: nothing to {verb}", severity="warning", markup=False)
                return
        held = [] if verb == "start" else ended_lock_warning(self.console.snapshot(), chosen)
        if held or verb == "kill" or (row.process is None and verb != "start"):
            names = "\n".join([*held, *(each.label for each in chosen)])
            of = f" of {sanitize(row.group[-1])}" if row.process is None and row.group else ""
            question = f"{verb.capitalize()} {counted(len(chosen), 'process')}{of}?"
            then = partial(self._do, verb, chosen)
            self.ask(Confirmation(question, lambda _: then(), partial(self._ended, verb, chosen), reasons=names))
        else:
            self._do(verb, chosen)

    def _controlled(self, row: Row) -> list[ProcessInfo]:
        """The processes of a row that this console can start and stop; notifies if it controls none of them."""
        info = self._info or LaunchInfo()
        every = [row.process] if row.process else [each for each in info.processes if _belongs(each, row.group)]
        chosen = [each for each in every if not each.started_by]
        if every and not chosen:
            who = sanitize(every[0].started_by)
            self.notify(f"Read-only here: started by {who}; Ctrl-C there ends it", severity="warning", markup=False)
        return chosen

    def _do(self, verb: str, processes: list[ProcessInfo]) -> None:
        for each in processes:
            answer: Future[Answer] = getattr(self.console.launcher, verb)(each.key)
            answer.add_done_callback(lambda done: self.host.call_later(self._answered, done))

    def _ended(self, verb: str, processes: Sequence[ProcessInfo]) -> str:
        """Why a verb has become pointless, as all of its processes have ended; otherwise empty."""
        now = {each.key: each for each in self.console.snapshot().launch.processes}
        if any(each.key in now and not is_pointless(verb, now[each.key]) for each in processes):
            return ""
        who = processes[0].label if len(processes) == 1 else "All of them"
        return f"{who} ended in the meantime; nothing was done."

    def _answered(self, done: Future[Answer]) -> None:
        answer = answer_of(done)
        if not answer.ok:
            self.report(answer)

    def action_policy(self) -> None:
        """Restart the processes at the cursor whenever they fail; if that is on for all of them, turn it off."""
        row, launcher = self._list.current, self.console.launcher
        if row is None or launcher is None or not self.may_change():
            return
        chosen = self._controlled(row)
        own = [each for each in chosen if not (each.program and each.program.respawn)] or chosen
        stays = all(each.restart_policy for each in own)
        for each in own:
            change = launcher.leave_ended if stays else launcher.restart_on_failure
            self.report_later(change(each.key))

    def action_transition(self) -> None:
        """Ask which transition the lifecycle nodes at the cursor should make."""
        row = self._list.current
        info = self._info or LaunchInfo()
        chosen = [each for each in info.processes if row and (each == row.process or not row.process)]
        nodes = [node for each in chosen if row and _belongs(each, row.group) for node in each.nodes]
        ask_transition(self, self.console.snapshot().graph, nodes)

    def action_write(self) -> None:
        """Ask for the launch file to write."""

        def write(path: Path) -> Answer:
            return self.console.graph.write_launch(str(path))

        self.ask_file("write a launch file for the running system", "live.launch.py", write, replaces=False)

    def action_open(self) -> None:
        """Ask for a launch file and its arguments, then launch it."""
        if self.console.launcher is None or self._why_not:
            self.notify(self._why_not or "There is no launcher.", severity="warning", markup=False)
            return
        if not self.may_change():
            return
        files = self.console.launcher.files()
        self.ask(
            Choice(
                "Open a launch file",
                self._chosen,
                attempt=partial(_file_problem, files),
                find=partial(files_for, files),
                hint="type part of a name, or a path",
                empty="No launch files in the workspace; type a path.",
            )
        )

    def _chosen(self, path: str) -> None:
        self.run_worker(self._ask(path), exclusive=True, group="launch", exit_on_error=False)

    async def _ask(self, path: str) -> None:
        """Read the arguments in a thread, as a launch file is a program that may take its time, then ask for them."""
        launcher = self.console.launcher
        if launcher is None:
            return
        try:
            arguments = await asyncio.to_thread(launcher.arguments, path)
        except ValueError as error:
            self.host.push_screen(FactsScreen("This launch file cannot be read", [("", str(error).splitlines())]))
            return
        if arguments:
            self.ask(Form(f"Launch {Path(path).name}", partial(self._launch, path), arguments=arguments))
        else:
            self._launch(path, {})

    def _launch(self, path: str, values: Mapping[str, str]) -> None:
        if self.console.launcher is not None:
            self._read = ""
            answer = self.console.launcher.launch(path, values)
            answer.add_done_callback(lambda done: self.host.call_later(self._launched, done))

    def _launched(self, done: Future[Answer]) -> None:
        """Show the answer, unless the pane already shows its text as the launch's problem."""
        shown = self.console.snapshot().launch.problem
        if done.exception() is not None or not shown or done.result().text != shown:
            self._answered(done)


def _file_problem(files: Sequence[str], path: str) -> str:
    """Why a typed path is no launch file; empty if it is an existing file or one of the known ones."""
    return "" if path in files or Path(path).is_file() else f"There is no file {sanitize(path)}."


def files_for(files: Sequence[str], typed: str) -> Sequence[Option]:
    """The launch files that match the typed words; if none does, the typed text is taken as a path."""
    try:
        query = parse(typed)
    except ValueError:
        query = Query()
    found = [each for each in files if query.matches(each)]
    if not found and typed.strip():
        found = [str(expanded_path(typed.strip()))]
    return [Option(Path(each).name, str(Path(each).parent), each) for each in found]


def is_pointless(verb: str, process: ProcessInfo) -> bool:
    """Whether a verb on a whole group has nothing to do for one of its processes.

    Starting a process that is stopping is not pointless: it starts as soon as it has ended.
    """
    if process.state is ProcessState.MISSING:
        return True
    if verb == "start":
        return process.state in (ProcessState.RUNNING, ProcessState.STARTING)
    return verb != "restart" and process.state not in ALIVE


def _belongs(process: ProcessInfo, group: tuple[str, ...]) -> bool:
    return process.group[: len(group)] == group


def event_text(event: LaunchEvent) -> str:
    """A launch event on one line."""
    return f"{clock_text(event.stamp)[:8]} {sanitize(event.text)}"


def facts(process: ProcessInfo, info: LaunchInfo) -> list[tuple[str, list[str]]]:
    """Everything known about a process."""
    no_pid = "in the launch host" if process.state in ALIVE else "none"
    state = process.state.value + ("" if process.exit_code is None else f", last exit code {process.exit_code}")
    known = [f"state     {state}", f"pid       {process.pid or no_pid}", f"restarts  {process.restarts}"]
    known += [f"restarted {restart_text(process)}"]
    known += [f"CPU       {process.cpu:.1%}"] if process.cpu is not None else []
    known += [f"memory    {process.memory} MB"] if process.memory is not None else []
    events = [event_text(each) for each in info.timeline if process.label in each.text]
    return [
        ("Process", known),
        ("Problem", process.problem.splitlines()),
        ("Launched by", [process.started_by] if process.started_by else list(process.group)),
        ("Nodes", list(process.nodes)),
        ("Events", events[-12:]),
    ]


def restart_text(process: ProcessInfo) -> str:
    """When a process is restarted automatically."""
    if process.program is not None and process.program.respawn:
        return "whenever it ends (respawn in its launch file)"
    return process.restart_policy or "never"
