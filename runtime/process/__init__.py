"""Node processes: threads that each look like a separate process to their code. Independent of ROS.

Identity
    `current()`: the node process of the calling thread; `MAIN` if there is none (the real process, nothing virtual).
    `ProcessLocal(factory)`: a variable with a separate value per node process.
    `running_as(process)`: run a `with` block as part of a node process.

Time and waiting (everything that blocks goes through these, so that it can be woken and stepped)
    `current().clock`: `steady_ns()`, `system_ns()`, `wakeup()`, `sleep_until(deadline_ns)`, `stepped`.
    A `Wakeup` has `set`, `clear`, `is_set`, `wait(deadline_ns) -> bool`. A wait raises `KeyboardInterrupt` once when
    the process is interrupted, and `ProcessKilled` (not an `Exception`) always once it was killed.

A node process
    `process = NodeProcess("talker-1", clock)`: has `name`, `pid` (synthetic), `state`, `exit_code`, `argv`, `env`.
    `process.start(target, argv=, env=, stdout=, stderr=)`: `target()` is its main program, see `file_program` and
    `entry_point_program`; `stdout`/`stderr` are called with each line of text, newline included, and must not block.
    `process.wait(timeout_s) -> exit_code | None`, `is_alive`, `line()` (where its main thread is).
    `interrupt()` (SIGINT), `terminate()` (SIGTERM), `kill()` (SIGKILL), `send_signal(n)`; `stop(grace_s)`: all in turn.
    `on_interrupt(callback(signum), signals)`: hook that runs before the handler, like that of `rclpy.init`; a hook for
    SIGTERM replaces its default. On `MAIN` it is a real signal handler. `on_abandon(callback())`: the process has ended
    in any way; leave the graph, because its code may still run. `on_exit(callback(process))`: after that, newest
    callback first. All three return a callable that removes the callback.
    Exit codes: 0; n of `sys.exit(n)`; 1 for a text (on its stderr) or an uncaught exception (traceback on its stderr);
    -2 for `KeyboardInterrupt`; -15, -9, -n for a signal.
    `explain_with(hook(exception) -> text | None)`: an exception's cause and how to fix it, given as a notice after the
    traceback. `on_notice(hook(process, text))`: what a node does that cannot be virtual, and lines that hang; to be
    shown as WARN.

Stepped runs
    `with stepped(seed=1) as clock`: virtual time for `MAIN` in this block; `NodeProcess(name, clock)` takes part in it.
    `clock.run_for(seconds)`, `clock.run_until(steady_ns)`: let exactly one thread run at a time up to that time.
    `clock.deterministic`, `clock.stalls`: whether no thread blocked outside the clock, and the lines where one did.

Virtual in a node process: threads and their lists, `sys.argv`, `sys.stdin/stdout/stderr/excepthook`, `os.environ`,
`signal.signal` and `signal.getsignal`. That is all that our nodes, launches and `ros2` commands use of their process;
everything else belongs to the real process. A user's program never runs as a node process.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .clock_source import ClockSource, Wakeup
from .crashes import explain_with
from .current import MAIN, NodeProcess, ProcessLocal, current, running_as
from .node.process_state import ProcessState
from .node.thread_state import ProcessKilled
from .notices import on_notice
from .real_time import RealTime

if TYPE_CHECKING:
    from .program import code_program, entry_point_program, file_program, module_program
    from .stepping.stepped_time import SteppedTime, stepped

_LATE = {
    "code_program": "program",
    "module_program": "program",
    "SteppedTime": "stepping.stepped_time",
    "stepped": "stepping.stepped_time",
    "entry_point_program": "program",
    "file_program": "program",
}


def __getattr__(name: str) -> Any:
    """Import lazily what a plain start does not need."""
    if name in _LATE:
        from importlib import import_module

        return getattr(import_module(f"{__name__}.{_LATE[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


__all__ = [
    "MAIN",
    "ClockSource",
    "NodeProcess",
    "ProcessKilled",
    "ProcessLocal",
    "ProcessState",
    "RealTime",
    "SteppedTime",
    "Wakeup",
    "code_program",
    "current",
    "entry_point_program",
    "explain_with",
    "file_program",
    "module_program",
    "on_notice",
    "running_as",
    "stepped",
]
