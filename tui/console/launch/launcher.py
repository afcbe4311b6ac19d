"""Runs and controls launched processes, using only the public `launch` API and its event handlers."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.graph.full_name import full_node_name
from bot_console.tui.console.launch.arguments import read_arguments
from bot_console.tui.console.launch.process import ENDED, KILLED, LaunchedProcess, Order
from bot_console.tui.console.launch.process_output import Add, ProcessOutput
from bot_console.tui.console.launch.process_verbs import ProcessVerbs
from bot_console.tui.console.launch.restart_policy import DEFAULT_RESTARTS, RestartPolicy
from bot_console.tui.console.launch.restart_recipe import Recipe, recipe
from bot_console.tui.console.launch.run import LaunchRun, Listener
from bot_console.tui.console.launch.timeline import LaunchTimeline
from bot_console.tui.console.launch.title import argument_line, title_of, unique_title
from bot_console.tui.console.launch.vitals import HANGS, FindVitals, Usage, Vitals
from bot_console.tui.console.model import (
    LaunchArgument,
    LaunchInfo,
    ProcessState,
    Severity,
)

if TYPE_CHECKING:
    from launch.events.process import ProcessExited, ProcessStarted

    from launch import LaunchContext

CLOSED = "the console is closing"
KILLED_TIMEOUT_S = 1.0
"""Seconds that launches may take to end after their processes were killed."""
BUSY_S = 6.0
"""Seconds of uninterrupted computation after which a process is reported."""


class Joinable(Protocol):
    """A thread, or anything that can be joined like one."""

    def join(self, timeout: float | None = None) -> object:
        """Wait until it has ended, at most `timeout` seconds."""
        ...


class _ProcessEntry:
    """A launched process with its action, its run, and its monitors."""

    def __init__(self, process: LaunchedProcess, run: LaunchRun, action: Any, made_from: Recipe) -> None:
        self.process = process
        self.run = run
        self.action = action
        self.recipe = made_from
        self.output: ProcessOutput | None = None
        self.vitals: Vitals | None = None
        self.usage: Usage | None = None


class RosLauncher(ProcessVerbs):
    """Runs launch files, each in a LaunchService and a separate thread. Methods may be called from any thread."""

    def __init__(
        self,
        record: Add,
        printed: Callable[[int, str, str], None],
        files: Callable[[], Sequence[str]] = tuple,
        spawn: Callable[[Callable[[], None], str], Joinable] | None = None,
        vitals: FindVitals = lambda pid: None,
        heard: Callable[[str], bool] = lambda name: True,
        every: Add | None = None,
        policy: RestartPolicy = DEFAULT_RESTARTS,
        restarts: bool = False,
    ) -> None:
        """`spawn` starts the thread that launches a file, and keeps launch's own output off the screen.

        `heard` says whether a line of a logger has arrived over `/rosout`; `every` receives all lines of loggers,
        including those that arrive over `/rosout`. `policy` says how failed processes are restarted, and `restarts`
        whether all are until a person decides otherwise.
        """
        self._policy, self._restarts = policy, restarts
        self._record = record
        self._printed = printed
        self._files_of_workspace = files
        self._spawn = spawn or _thread
        self._find_vitals = vitals
        self._heard = heard
        self._every = every
        self._listener = Listener(
            self._started,
            self._output,
            self._exited,
            self._missing,
            self._on_action_completed,
            self._on_run_ending,
            self._fault,
        )
        self._lock = threading.RLock()
        self._entries: dict[str, _ProcessEntry] = {}
        self._by_action: dict[Any, _ProcessEntry] = {}
        self._runs: dict[LaunchRun, Joinable | None] = {}
        self._unanswered: dict[LaunchRun, Future[Answer]] = {}
        self._files: list[str] = []
        self._timeline = LaunchTimeline()
        self._problem = ""
        self._info = LaunchInfo()
        self._delayed = 0
        self._dirty = self._closed = False

    def info(self) -> LaunchInfo:
        """The launches and their processes; the same object until something changes."""
        with self._lock:
            self._poll()
            if self._dirty:
                self._dirty = False
                processes = tuple(each.process.info for each in self._entries.values())
                events = self._timeline.events
                self._info = LaunchInfo(tuple(self._files), processes, events, self._problem, self._delayed)
            return self._info

    def _poll(self) -> None:
        """Update what no event reports: measurements, hangs, due restarts."""
        now = time.monotonic()
        delayed = sum(run.delayed_starts for run in self._runs)
        self._dirty |= delayed != self._delayed
        self._delayed = delayed
        for entry in self._entries.values():
            info = entry.process.info
            if entry.output is not None and entry.process.alive:
                entry.output.settle()
            if not self._closed and (order := entry.process.due()) is not Order.NOTHING:
                self._report(f"{info.label} is restarted after it has failed")
                self._order(entry, order)
            if entry.usage is not None and entry.process.alive:
                self._inspect(entry, entry.usage, now)
            elif entry.vitals is not None and info.exit_code == KILLED and info.state is not ProcessState.ABANDONED:
                where = entry.vitals.hangs_in() if info.state in ENDED else ""
                if where:
                    entry.process.abandoned(where)
                    self._report(f"{info.label} is abandoned: {where}", Severity.WARN)

    def _inspect(self, entry: _ProcessEntry, usage: Usage, now: float) -> None:
        before = usage.busy_s
        usage.poll(now)
        self._dirty |= entry.process.uses(usage.share, usage.memory)
        label = entry.process.info.label
        if entry.process.set_stall_reason(usage.stall_reason):
            self._dirty = True
            if usage.stall_reason.startswith(HANGS):
                self._report(f"{label} {usage.stall_reason}", Severity.WARN)
        if before < BUSY_S <= usage.busy_s:
            self._report(f"{label} has been computing for {BUSY_S:g} s without a pause", Severity.WARN)

    def _report(self, text: str, severity: Severity = Severity.INFO) -> None:
        self._timeline.report(text, severity)
        self._dirty = True

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments that a launch file declares; raises `ValueError` if it cannot be read."""
        return read_arguments(path)

    def files(self) -> Sequence[str]:
        """The launch files of the workspace."""
        return self._files_of_workspace()

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run another launch file; the answer comes when its first process runs, or when it has failed or ended."""
        outcome: Future[Answer] = Future()
        given = dict(arguments)
        with self._lock:
            if self._closed:
                outcome.set_result(Answer(False, CLOSED))
                return outcome
            self._files.append(path)
            self._problem = ""
            self._report(argument_line(path, given))
            shown = {each.title for each in self._runs} | {each.run.title for each in self._entries.values()}
            run = LaunchRun(unique_title(title_of(path, given), shown), self._listener)
            run.path = path
            self._unanswered[run] = outcome
            self._begin(run, lambda: run.run_file(path, given))
        return outcome

    def _begin(self, run: LaunchRun, work: Callable[[], str]) -> None:
        self._runs[run] = None
        self._runs[run] = self._spawn(lambda: self._serve(run, work), run.path)

    def _serve(self, run: LaunchRun, work: Callable[[], str]) -> None:
        try:
            problem = work()
        except (Exception, SystemExit) as error:  # the outermost frame of the launch thread
            problem = run.fault(error)
        with self._lock:
            del self._runs[run]
            of_file = self._unanswered.pop(run, None)
            if problem:
                self._problem = problem
                self._report(problem, Severity.ERROR)
                if not run.logged:
                    self._printed(Severity.ERROR, "launch", problem)
            else:
                self._report(f"{run.title} has ended")
            for entry in [each for each in self._entries.values() if each.run is run]:
                self._run_ended(entry, "" if run.has_begun else problem)
        if of_file is not None:
            of_file.set_result(Answer(not problem, problem or f"{run.title} has ended"))

    def _run_ended(self, entry: _ProcessEntry, why: str) -> None:
        """Record that the run of a process is over; when started again, the process gets a separate run.

        `why` says why the run could not begin; empty if it could.
        """
        if entry.process.info.state is ProcessState.STARTING and not self._closed and not why:
            self._order(entry, Order.START)
        else:
            self._ended(entry, why)

    def _request(self, verb: str, key: str) -> Future[Answer]:
        with self._lock:
            entry = self._entries.get(key)
            if entry is None or self._closed:
                return done(Answer(False, CLOSED if self._closed else f"there is no process {key}"))
            before = entry.process.info
            order, outcome = entry.process.want(verb)
            if entry.process.info is not before or order is not Order.NOTHING:
                self._report(f"{verb.replace('_', ' ')} {before.label}")
            self._order(entry, order)
        return outcome

    def _order(self, entry: _ProcessEntry, order: Order) -> None:
        from launch.events import matches_action
        from launch.events.process import ShutdownProcess, SignalProcess

        if order is Order.START:
            self._start(entry)
        elif entry.action is None:
            return  # not executed yet: the process is ended as soon as it has started
        elif order is Order.KILL:
            entry.run.emit(SignalProcess(signal_number="SIGKILL", process_matcher=matches_action(entry.action)))
        elif order is Order.SHUT_DOWN:
            entry.run.emit(ShutdownProcess(process_matcher=matches_action(entry.action)))

    def _start(self, entry: _ProcessEntry) -> None:
        self._by_action.pop(entry.action, None)
        entry.action = None

        def make() -> Any:
            action = entry.recipe.action()
            with self._lock:
                entry.action = action
                self._by_action[action] = entry
            return action

        def failed(why: str) -> None:
            self._ended(entry, why)

        if entry.run.ending:  # another run of the same file may exist, for processes that were restarted earlier
            entry.run = next((run for run in self._runs if run.title == entry.run.title and not run.ending), entry.run)
        if not entry.run.ending:
            entry.run.start(make, failed)
            return
        file, run = entry.run.path, LaunchRun(entry.run.title, self._listener)
        run.path, entry.run = file, run
        self._begin(run, lambda: run.run_action(make, failed))

    def _started(self, run: LaunchRun, event: ProcessStarted, context: LaunchContext) -> None:
        nodes = _node_names(event.action)
        vitals = self._find_vitals(event.pid)
        with self._lock:
            entry = self._by_action.get(event.action) or self._add_process(run, event, context)
            entry.vitals, entry.usage = vitals, Usage(vitals, time.monotonic()) if vitals else None
            entry.output = ProcessOutput(event.process_name, self._record, self._printed, self._heard, self._every)
            order = entry.process.started(event.process_name, event.pid, nodes)
            info = entry.process.info
            again, pid = f" again ({info.restarts})" if info.restarts else "", f", pid {info.pid}" if info.pid else ""
            self._report(f"{info.label} started{again}{pid}")
            self._order(entry, order)
            outcome = self._unanswered.pop(run, None)
        if outcome is not None:
            outcome.set_result(Answer(True, f"{run.title} runs"))

    def _add_process(self, run: LaunchRun, event: ProcessStarted, context: LaunchContext) -> _ProcessEntry:
        """Add a process that has started for the first time."""
        key = f"{event.process_name}@{len(self._entries)}"
        place = run.tree.place(event.action, context)
        made_from = recipe(event, context)
        process = LaunchedProcess(
            key, event.process_name, place, made_from.program, policy=self._policy, restarts=self._restarts
        )
        entry = _ProcessEntry(process, run, event.action, made_from)
        self._entries[key] = self._by_action[event.action] = entry
        if self._closed or run.ending:
            process.exit_requested()
        return entry

    def _output(self, event: Any) -> None:
        entry = self._by_action.get(event.action)
        if entry is not None and entry.output is not None:
            text = event.text.decode("utf-8", "replace") if isinstance(event.text, bytes) else event.text
            entry.output.feed(text, stderr=event.from_stderr)

    def _exited(self, event: ProcessExited) -> None:
        with self._lock:
            entry = self._by_action.get(event.action)
            if entry is None:
                return
            if entry.output is not None:
                entry.output.close()
            future = event.action.get_asyncio_future()
            respawns = future is not None and not future.done()
            order = entry.process.exited(event.returncode, respawns, entry.output.fault if entry.output else "")
            entry.usage = None
            bad = entry.process.info.state is ProcessState.CRASHED or entry.process.info.problem
            text = f"{entry.process.info.label} ended, exit code {event.returncode}"
            self._report(text, Severity.ERROR if bad else Severity.INFO)
            self._order(entry, order)

    def _missing(self, run: LaunchRun, event: Any, context: LaunchContext) -> None:
        label = f"{event.package}/{event.executable}"
        with self._lock:
            key = f"{label}@{len(self._entries)}"
            process = LaunchedProcess(key, label, run.tree.place(event.action, context))
            process.missing(event.reason)
            self._entries[key] = _ProcessEntry(
                process, run, None, Recipe([], label, {}, "", is_node=True, package=event.package)
            )
            self._report(f"{label} is missing: {event.reason}", Severity.WARN)

    def _on_action_completed(self, action: Any) -> None:
        with self._lock:
            entry = self._by_action.get(action)
            if entry is not None:
                self._ended(entry)

    def _ended(self, entry: _ProcessEntry, why: str = "") -> None:
        """Record that a process has ended and that launch will not start it again."""
        with self._lock:
            before = entry.process.info
            order = entry.process.over(why)
            if entry.process.info is not before:
                self._report(f"{before.label}: {entry.process.info.problem or 'has ended'}")
            self._order(entry, order)

    def _on_run_ending(self, run: LaunchRun, reason: str) -> None:
        with self._lock:
            if reason not in ("", "idle"):
                self._report(f"{run.title} ends: {reason}")
                for entry in self._entries.values():
                    if entry.run is run:
                        entry.process.forget_restart()
            for entry in self._entries.values():
                if entry.run is run and entry.process.alive:
                    entry.process.exit_requested()

    def _fault(self, error: Exception) -> None:
        self._printed(Severity.ERROR, "bot-console", f"the launch pane could not process an event: {error!r}")

    def close(self, timeout_s: float = 10.0) -> None:
        """Shut down all launches and wait, at most `timeout_s` in total; then kill the processes that still run.

        A second call does nothing.
        """
        with self._lock:
            if self._closed:
                return
            self._closed = True
            runs = list(self._runs.items())
        for run, _ in runs:
            run.shut_down()
        if _join_all([thread for _, thread in runs], timeout_s):
            return
        with self._lock:
            for entry in self._entries.values():
                if entry.process.alive:
                    self._order(entry, Order.KILL)
        _join_all([thread for _, thread in runs], KILLED_TIMEOUT_S)


def _join_all(threads: Sequence[Joinable | None], timeout_s: float) -> bool:
    """Wait for these threads, at most `timeout_s` in total; returns whether all have ended."""
    deadline = time.monotonic() + timeout_s
    for each in threads:
        if each is not None:
            each.join(max(0.0, deadline - time.monotonic()))
    return time.monotonic() < deadline


def _thread(target: Callable[[], None], file: str) -> threading.Thread:
    thread = threading.Thread(target=target, name="launch", daemon=True)
    thread.start()
    return thread


def _node_names(action: Any) -> tuple[str, ...]:
    """The fully qualified names of the nodes in a process, if its action has them."""
    if not hasattr(action, "expanded_node_name"):
        return _full_node_name(action)
    name, namespace = action.expanded_node_name, getattr(action, "expanded_node_namespace", "")
    if not name or "<" in name:
        return ()
    return (full_node_name("" if "<" in namespace else namespace, name),)


def _full_node_name(action: Any) -> tuple[str, ...]:
    """The same for a launch_ros with `node_name`, in which placeholders stand for what the program itself decides."""
    try:
        name = str(getattr(action, "node_name", ""))
    except RuntimeError:  # the action was not executed
        return ()
    return (name,) if name and "<" not in name else ()
