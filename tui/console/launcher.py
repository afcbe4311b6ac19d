"""Processes as the console sees and steers them: the public `launch` API and its event handlers, nothing else."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

from bot_console.tui.console.model import (
    LaunchArgument,
    LaunchEvent,
    LaunchInfo,
    ProcessInfo,
    ProcessState,
    Severity,
)
from bot_console.tui.console.process_output import Add, OutputReader, Printed
from bot_console.tui.console.protocol import Answer

TIMELINE = 500
INTERRUPTED = (0, -2, -15, 130)
"""Exit codes of a process that ended as it was asked to."""


class Joinable(Protocol):
    """A thread, or what can be waited for like one."""

    def join(self, timeout: float | None = None) -> object:
        """Wait for the end, at most so many seconds."""
        ...


class _Process:
    """A launched process: the action that runs it, what is shown of it, and what reads its output."""

    def __init__(self, action: Any, info: ProcessInfo, readers: dict[bool, tuple[OutputReader, Printed]]) -> None:
        self.action = action
        self.info = info
        self.readers = readers
        self.stopping = False
        self.again = False


class RosLauncher:
    """Runs launch files, each in a LaunchService and thread of its own. Methods may be called from any thread."""

    def __init__(
        self,
        record: Add,
        printed: Callable[[int, str, str], None],
        files: Callable[[], Sequence[str]] = tuple,
        spawn: Callable[[Callable[[], None]], Joinable] | None = None,
    ) -> None:
        """`spawn` starts the thread of a launch, in a way that keeps what launch itself prints off the screen."""
        self._record = record
        self._spawn = spawn or _thread
        self._printed = printed
        self._files_of_workspace = files
        self._lock = threading.RLock()
        self._processes: dict[str, _Process] = {}
        self._keys: dict[int, str] = {}
        self._services: list[Any] = []
        self._threads: list[Joinable] = []
        self._files: list[str] = []
        self._timeline: deque[LaunchEvent] = deque(maxlen=TIMELINE)
        self._events = 0
        self._problem = ""
        self._info = LaunchInfo()
        self._dirty = False

    def info(self) -> LaunchInfo:
        """What is known now; the same object until something changes."""
        if self._dirty:
            with self._lock:
                self._dirty = False
                processes = tuple(each.info for each in self._processes.values())
                self._info = LaunchInfo(tuple(self._files), processes, tuple(self._timeline), self._problem)
        return self._info

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run one more launch file; the answer comes when its first process runs or it has failed."""
        outcome: Future[Answer] = Future()
        given = dict(arguments)
        self._threads.append(self._spawn(lambda: self._serve(path, given, outcome)))
        return outcome

    def _serve(self, path: str, arguments: dict[str, str], outcome: Future[Answer]) -> None:
        from launch.actions import IncludeLaunchDescription
        from launch.launch_description_sources import AnyLaunchDescriptionSource

        from launch import LaunchDescription, LaunchService

        with self._lock:
            self._files.append(path)
            self._problem = ""
            self._tell(f"launch {path}")
        service = LaunchService(noninteractive=True)
        with self._lock:
            self._services.append(service)
        include = IncludeLaunchDescription(AnyLaunchDescriptionSource(path), launch_arguments=arguments.items())
        service.include_launch_description(LaunchDescription([*self._handlers(path, outcome), include]))
        try:
            code = service.run(shutdown_when_idle=True)
            problem = "" if code == 0 or outcome.done() else f"{path} ended with exit code {code}; the log says why"
        except Exception as error:  # the border of the launch thread: shown in the pane
            problem = f"{path}: {error}"
        with self._lock:
            self._services.remove(service)
            if problem:
                self._problem = problem
                self._tell(problem, Severity.ERROR)
            else:
                self._tell(f"{path} has ended")
        if not outcome.done():
            outcome.set_result(Answer(not problem, problem or f"{path} has ended"))

    def _handlers(self, path: str, outcome: Future[Answer]) -> list[Any]:
        from launch.actions import RegisterEventHandler
        from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart

        def started(event: Any, context: Any) -> None:
            self._started(path, event)
            if not outcome.done():
                outcome.set_result(Answer(True, f"{path} runs"))

        return [
            RegisterEventHandler(OnProcessStart(on_start=started)),
            RegisterEventHandler(OnProcessIO(on_stdout=self._printed_text, on_stderr=self._printed_text)),
            RegisterEventHandler(OnProcessExit(on_exit=lambda event, context: self._exited(event))),
        ]

    def _started(self, path: str, event: Any) -> None:
        with self._lock:
            key = self._keys.get(id(event.action))
            if key is None:
                key = self._keys[id(event.action)] = f"{event.process_name}@{len(self._keys)}"
            old = self._processes.get(key)
            info = ProcessInfo(
                key=key,
                label=event.process_name,
                state=ProcessState.RUNNING,
                pid=event.pid,
                nodes=_node_names(event.action),
                group=(Path(path).name,),
                restarts=old.info.restarts + 1 if old else 0,
            )
            self._processes[key] = _Process(event.action, info, self._readers(event.process_name))
            self._tell(f"{event.process_name} started, pid {event.pid}")

    def _readers(self, label: str) -> dict[bool, tuple[OutputReader, Printed]]:
        readers: dict[bool, tuple[OutputReader, Printed]] = {}
        for stderr in (False, True):
            printed = Printed(label, self._printed, stderr=stderr)
            readers[stderr] = (OutputReader(self._record, printed.line), printed)
        return readers

    def _printed_text(self, event: Any) -> None:
        process = self._processes.get(self._keys.get(id(event.action), ""))
        if process:
            text = event.text.decode("utf-8", "replace") if isinstance(event.text, bytes) else event.text
            process.readers[event.from_stderr][0].feed(text)

    def _exited(self, event: Any) -> None:
        with self._lock:
            process = self._processes.get(self._keys.get(id(event.action), ""))
            if process is None:
                return
            for reader, printed in process.readers.values():
                reader.close()
                printed.close()
            code = event.returncode
            fine = code in INTERRUPTED if process.stopping else code == 0
            state = ProcessState.EXITED if fine else ProcessState.CRASHED
            why = "" if fine else f"ended with exit code {code}; its last lines are in the log"
            process.info = replace(process.info, state=state, exit_code=code, pid=None, problem=why)
            self._tell(f"{process.info.label} ended, exit code {code}", Severity.INFO if fine else Severity.ERROR)

    def _tell(self, text: str, severity: Severity = Severity.INFO) -> None:
        self._timeline.append(LaunchEvent(self._events, time.time_ns(), text, severity))
        self._events += 1
        self._dirty = True

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments a launch file declares; raises `ValueError` when it cannot be read."""
        from launch.launch_description_sources import AnyLaunchDescriptionSource

        from launch import LaunchContext

        try:
            context = LaunchContext()
            description = AnyLaunchDescriptionSource(path).get_launch_description(context)
            declared = description.get_launch_arguments()
        except Exception as error:  # a launch file is a program: whatever it raises is its reader's to see
            raise ValueError(f"{path}: {error}") from error
        return [_argument(each, context) for each in declared]

    def files(self) -> Sequence[str]:
        """Launch files of the workspace."""
        return self._files_of_workspace()

    def start(self, key: str) -> Future[Answer]:
        """Start an ended process again."""
        return self._answer(key, "start")

    def stop(self, key: str) -> Future[Answer]:
        """Stop a process as Ctrl-C does."""
        return self._answer(key, "stop")

    def kill(self, key: str) -> Future[Answer]:
        """End a process at once."""
        return self._answer(key, "kill")

    def restart(self, key: str) -> Future[Answer]:
        """Stop, then start."""
        return self._answer(key, "restart")

    def _answer(self, key: str, verb: str) -> Future[Answer]:
        outcome: Future[Answer] = Future()
        outcome.set_result(self._act(key, verb))
        return outcome

    def _act(self, key: str, verb: str) -> Answer:
        from launch.events import matches_action
        from launch.events.process import ShutdownProcess, SignalProcess

        with self._lock:
            process = self._processes.get(key)
            if process is None:
                return Answer(False, f"there is no process {key}")
            if process.info.state is not ProcessState.RUNNING:
                return Answer(False, f"{process.info.label} does not run")
            process.stopping = True
            process.info = replace(process.info, state=ProcessState.STOPPING)
            self._tell(f"{verb} {process.info.label}")
            matcher = matches_action(process.action)
            event = (
                SignalProcess(signal_number="SIGKILL", process_matcher=matcher)
                if verb == "kill"
                else ShutdownProcess(process_matcher=matcher)
            )
            for service in self._services:
                service.emit_event(event)
        return Answer(True, f"{verb}: {process.info.label}")

    def close(self, patience: float = 10.0) -> None:
        """Shut every launch down and wait for it, at most so many seconds in all."""
        with self._lock:
            services = list(self._services)
            for process in self._processes.values():
                process.stopping = True
        deadline = time.monotonic() + patience
        for service in services:
            service.shutdown()
        for thread in self._threads:
            thread.join(max(0.0, deadline - time.monotonic()))


def _thread(target: Callable[[], None]) -> threading.Thread:
    thread = threading.Thread(target=target, name="launch", daemon=True)
    thread.start()
    return thread


def _node_names(action: Any) -> tuple[str, ...]:
    """The ROS names of the nodes in a process, where the action tells them."""
    name = getattr(action, "node_name", "")
    return (name,) if isinstance(name, str) and name and "<" not in name else ()


def _argument(action: Any, context: Any) -> LaunchArgument:
    from launch.utilities import perform_substitutions

    default = action.default_value
    text = None if default is None else perform_substitutions(context, default)
    return LaunchArgument(action.name, action.description or "", text, tuple(action.choices or ()))
