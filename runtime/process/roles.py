"""The roles that a node process plays for its users: protocols, so that it may depend on them and not vice versa.

`node.node_process.NodeProcess` implements the roles of a process, `node.thread_state.ThreadState` that of its threads.
For the type checker only: nothing imports this at run time.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, MutableMapping, Sequence
from io import TextIOBase
from typing import Any, Protocol
from weakref import WeakSet

from .clock_source import ClockSource, WaitingThread
from .node.process_state import ProcessState

Handler = Callable[[int, Any], Any] | int | None
"""What `signal.signal` accepts: a function, or a number such as `SIG_DFL`; None for a handler not set from Python."""


class NodeThread(WaitingThread, Protocol):
    """A thread of a node process, which can be woken, or made to raise an exception."""

    daemon: bool
    """Whether the process ends without waiting for the thread, as the program has requested."""
    ident: int
    waits: int
    """How many waits of the runtime the thread has entered."""

    @property
    def thread(self) -> threading.Thread:
        """The thread object that the program has."""
        ...

    @property
    def waiting(self) -> bool:
        """Whether the thread is in a wait of the runtime, from which it can be woken."""
        ...

    @property
    def takes_turns(self) -> bool:
        """Whether the thread takes turns in a stepped run."""
        ...

    def post(self, action: Callable[[], Any]) -> None:
        """Make the thread call `action` in its current or next wait."""
        ...

    def take_back(self, action: Callable[[], Any]) -> bool:
        """Withdraw a posted action; return whether it was still pending."""
        ...

    def throw(self, exception: type[BaseException]) -> None:
        """Raise the exception in the thread, even if it is busy."""
        ...

    def kill(self) -> None:
        """Make the thread's current wait and every later one raise `ProcessKilled`."""
        ...


class Warned(Protocol):
    """The process that a notice is about."""

    @property
    def name(self) -> str:
        """The name shown in the log."""
        ...

    @property
    def notices(self) -> list[str]:
        """The notices given so far; each is given once."""
        ...

    @property
    def stderr(self) -> TextIOBase | None:
        """Its standard error stream; None for the real one."""
        ...


class RunningProcess(Warned, Protocol):
    """A process found by its pid, for sending a signal or examining it."""

    @property
    def state(self) -> ProcessState:
        """Its state."""
        ...

    @property
    def is_alive(self) -> bool:
        """Whether it was started and has not ended."""
        ...

    def thread_states(self) -> list[NodeThread]:
        """Return its main thread and the threads it started, except those that have ended."""
        ...

    def cpu_seconds(self) -> float | None:
        """Return the processor time (s) its threads have used; None if the system does not tell."""
        ...

    def send_signal(self, signum: int) -> None:
        """Deliver a signal by number; does nothing if the process has ended."""
        ...


class SignalTable(Protocol):
    """The signal handling of a process."""

    def handler(self, signum: int) -> Handler:
        """Return the handler, as `signal.getsignal` does."""
        ...

    def set_handler(self, signum: int, handler: Handler) -> Handler:
        """Set the handler, as `signal.signal` does."""
        ...


class Pool(Protocol):
    """A thread pool: an executor of `concurrent.futures`, or one of the runtime's own."""

    def shutdown(self, wait: bool = ...) -> None:
        """Let the pool's threads end once they have finished the submitted work."""
        ...


class CurrentProcess(RunningProcess, Protocol):
    """The process that a thread works for, as wrappers and ROS code see it when they ask for process attributes."""

    main_state: NodeThread | None
    """Its main thread; None before the start, and in the real process, where nothing is virtual."""
    children: dict[threading.Thread, NodeThread]
    """The threads it has started."""
    pools: WeakSet[Pool]
    """The pools whose threads end with its main program."""
    cpu_of_ended_threads: float
    """Processor time (s) used by threads of the process that have ended."""
    argv: list[str]
    overrides: dict[Any, Any]
    """The module variables that the process has set for itself."""
    locals: dict[Any, Any]
    """The process's values of `ProcessLocal` variables."""

    @property
    def clock(self) -> ClockSource:
        """Its clock source."""
        ...

    @property
    def pid(self) -> int:
        """Its synthetic pid; the real one for the real process."""
        ...

    @property
    def env(self) -> MutableMapping[str, str]:
        """Its environment."""
        ...

    @property
    def stdout(self) -> TextIOBase | None:
        """Its standard output stream; None for the real one."""
        ...

    @property
    def signals(self) -> SignalTable:
        """Its signal handling."""
        ...

    def deliver_signals(self) -> None:
        """Let pending signals take effect now, if called from the process's main thread."""
        ...

    def on_interrupt(self, callback: Callable[[int], Any], signals: Iterable[int] = ...) -> Callable[[], None]:
        """Call `callback(signum)` before the handler of these signals. Returns a function that removes the hook."""
        ...

    def on_abandon(self, callback: Callable[[], Any]) -> Callable[[], None]:
        """Call `callback()` when the process has ended in any way. Returns a function that removes the callback."""
        ...

    def end_with_main(self, pool: Pool) -> None:
        """When the main program has ended, let a pool finish its submitted work, shut it down, and wait for that."""
        ...

    def guarded(self, callback: Callable[[], Any]) -> None:
        """Call `callback`; an exception becomes a notice."""
        ...

    def die(self, code: int) -> None:
        """End now with this exit code, discarding unfinished output."""
        ...

    def finish(self, code: int) -> None:
        """Record the end of the process, once, and call all callbacks."""
        ...

    def break_off_later(self, states: Sequence[NodeThread]) -> None:
        """Give killed threads a moment to unwind, then raise in those still busy."""
        ...
