"""A process that a test starts beside the others, and its state as the test sees it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from launch.actions import ExecuteProcess
from launch.events import IncludeLaunchDescription, matches_action
from launch.events.process import ProcessExited, ProcessStarted, ShutdownProcess
from launch.utilities import ensure_argument_type
from launch_testing.io_handler import ActiveIoHandler
from launch_testing.proc_info_handler import ActiveProcInfoHandler

from launch import LaunchDescription

if TYPE_CHECKING:
    from launch.launch_service import LaunchService


class ProcessProxy:
    """State and output of one process, as recorded by the handlers of a test."""

    def __init__(
        self,
        process_action: ExecuteProcess,
        proc_info: ActiveProcInfoHandler,
        proc_output: ActiveIoHandler,
        *,
        output_filter: Callable[[str], str] | None = None,
    ) -> None:
        ensure_argument_type(process_action, ExecuteProcess, "process_action")
        ensure_argument_type(proc_info, ActiveProcInfoHandler, "proc_info")
        ensure_argument_type(proc_output, ActiveIoHandler, "proc_output")
        if output_filter is not None and not callable(output_filter):
            raise TypeError(f"Expected 'output_filter' to be callable but got '{output_filter!r}'")
        self._action = process_action
        self._proc_info = proc_info
        self._proc_output = proc_output
        self._filter = output_filter

    def wait_for_shutdown(self, timeout: float | None = None) -> bool:
        """Return whether the process ends within `timeout` seconds; None waits without a limit."""
        with self._proc_info.proc_event:
            return self._proc_info.proc_event.wait_for(lambda: self.terminated, timeout)

    def wait_for_output(self, condition: Callable[[str], Any] | None = None, timeout: float | None = None) -> Answer:
        """Return whether the running process's output meets a condition within `timeout` seconds; None accepts any."""
        if condition is not None and not callable(condition):
            raise TypeError(f"Expected 'condition' to be callable but got '{condition!r}'")
        answer = Answer()

        def fits() -> Any:
            if not self.running:
                return False
            answer.text = self.output
            return condition is None or condition(answer.text)

        with self._proc_output.io_event:
            answer.so = bool(self._proc_output.io_event.wait_for(fits, timeout))
        return answer

    @property
    def target_process_action(self) -> ExecuteProcess:
        """The action that runs the process."""
        return self._action

    @property
    def stderr(self) -> str:
        """The process's standard error."""
        return self._text(lambda event: event.from_stderr)

    @property
    def stdout(self) -> str:
        """The process's standard output."""
        return self._text(lambda event: event.from_stdout)

    @property
    def output(self) -> str:
        """All output of the process, in order."""
        return self._text(lambda event: True)

    def _text(self, counts: Callable[[Any], bool]) -> str:
        pieces = (event.text for event in self._proc_output[self._action] if counts(event))
        text = b"".join(pieces).decode(errors="replace")
        return self._filter(text) if self._filter else text

    @property
    def running(self) -> bool:
        """Whether the process has started and not ended."""
        return isinstance(self._last_event(), ProcessStarted)

    @property
    def terminated(self) -> bool:
        """Whether the process has ended."""
        return isinstance(self._last_event(), ProcessExited)

    @property
    def exit_code(self) -> int:
        """The process's exit code."""
        return int(self._proc_info[self._action].returncode)

    def _last_event(self) -> Any:
        return self._proc_info[self._action] if self._action in self._proc_info.processes() else None


class Answer:
    """A truth value that shows the examined text in a failed assertion."""

    so = False
    text: str | None = None

    def __bool__(self) -> bool:
        return self.so

    def __repr__(self) -> str:
        return f"<BoolWithText({self.so}): {self.text!r}>"


@contextmanager
def launch_process(
    launch_service: LaunchService,
    process_action: ExecuteProcess,
    proc_info: ActiveProcInfoHandler,
    proc_output: ActiveIoHandler,
    **kwargs: Any,
) -> Iterator[ProcessProxy]:
    """Start a process in a running launch, yield its proxy, and end it afterwards if it is still running."""
    ensure_argument_type(process_action, ExecuteProcess, "process_action")
    launch_service.emit_event(event=IncludeLaunchDescription(LaunchDescription([process_action])))
    proxy = ProcessProxy(process_action, proc_info, proc_output, **kwargs)
    try:
        yield proxy
    finally:
        if not proxy.terminated:
            launch_service.emit_event(event=ShutdownProcess(process_matcher=matches_action(process_action)))
