"""What a node process is to each of those that deal with it: protocols, so that it may know them and they not it.

`node.node_process.NodeProcess` plays the roles of a process, `node.thread_state.ThreadState` that of its threads.
For the type checker only: nothing imports this when it runs.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Mapping, MutableMapping, Sequence
from functools import partial
from io import TextIOBase
from types import ModuleType
from typing import Any, Protocol
from weakref import WeakSet

from .clock_source import ClockSource, WaitingThread
from .node.process_state import ProcessState

Handler = Callable[[int, Any], Any] | int | None
"""What `signal.signal` takes: a function, or a number such as `SIG_DFL`; None for one that is not Python's."""


class NodeThread(WaitingThread, Protocol):
    """A thread of a node process, as those see it who want to wake it or to raise something in it."""

    daemon: bool
    """Whether its process ends without waiting for it, as its program wanted it."""
    ident: int
    waits: int
    """How many waits of the runtime it has entered."""

    @property
    def thread(self) -> threading.Thread:
        """As the program has it."""
        ...

    @property
    def waiting(self) -> bool:
        """Whether it is in a wait of the runtime, from which it can be woken."""
        ...

    @property
    def takes_turns(self) -> bool:
        """Whether it is in step with a run."""
        ...

    def post(self, action: Callable[[], Any]) -> None:
        """Have it call `action` in its present or its next wait."""
        ...

    def take_back(self, action: Callable[[], Any]) -> bool:
        """Withdraw a posted action; whether it was in time."""
        ...

    def throw(self, exception: type[BaseException]) -> None:
        """Raise in it, were it busy."""
        ...

    def kill(self) -> None:
        """Let this wait and every later one raise `ProcessKilled`."""
        ...


class Warned(Protocol):
    """Whom a notice is about."""

    @property
    def name(self) -> str:
        """As the log shows it."""
        ...

    @property
    def notices(self) -> list[str]:
        """Those given so far; each is given once."""
        ...

    @property
    def stderr(self) -> TextIOBase | None:
        """Its standard error stream; None where that is the real one."""
        ...


class RunningProcess(Warned, Protocol):
    """Who is found by a pid: to be sent a signal, or examined."""

    @property
    def state(self) -> ProcessState:
        """How far it has come."""
        ...

    def cpu_seconds(self) -> float | None:
        """Processor time (s) that its threads have used; None where the system does not tell."""
        ...

    def send_signal(self, signum: int) -> None:
        """Deliver a signal by number; without effect once it has ended."""
        ...


class Watched(Warned, Protocol):
    """Who is looked after while it runs."""

    @property
    def is_alive(self) -> bool:
        """Whether it was started and has not ended."""
        ...

    def thread_states(self) -> list[NodeThread]:
        """Its main thread and the threads that it started, those that have ended excepted."""
        ...


class SignalTable(Protocol):
    """What a process has said about its signals."""

    wakeup_fd: int
    """Where each signal writes its number; -1: nowhere."""

    def handler(self, signum: int) -> Handler:
        """What `signal.getsignal` says."""
        ...

    def set_handler(self, signum: int, handler: Handler) -> Handler:
        """What `signal.signal` does."""
        ...

    def pause(self) -> None:
        """Wait until a handler has run."""
        ...


class Pool(Protocol):
    """Threads that do what is submitted to them: an executor of `concurrent.futures`, or one of the runtime."""

    def shutdown(self, wait: bool = ...) -> None:
        """Let its threads end once they have done what was submitted."""
        ...


class OwnModules(Protocol):
    """The modules that a node process has for itself."""

    @property
    def builtins(self) -> dict[str, Any]:
        """The builtins of each of them, by which its code is known."""
        ...

    @property
    def table(self) -> Mapping[str, ModuleType]:
        """What `sys.modules` is to its code."""
        ...

    def owns(self, name: str) -> bool:
        """Whether a dotted module name is, or would be, one of these."""
        ...

    def load(self, name: str) -> ModuleType:
        """The process's own module of that dotted name, imported if need be."""
        ...


class CurrentProcess(Watched, RunningProcess, Protocol):
    """The process that a thread works for, as wraps and ROS see it: it answers what its code asks of its process."""

    main_state: NodeThread | None
    """Its main thread; None before the start, and in the real process: nothing there is virtual."""
    children: dict[threading.Thread, NodeThread]
    """The threads that it has started."""
    pools: WeakSet[Pool]
    """Whose threads end with its main program."""
    exit_functions: list[partial[Any]]
    """Those of `atexit`, oldest first."""
    cpu_of_ended_threads: float
    """Processor time (s)."""
    argv: list[str]
    path: list[str]
    modules: OwnModules | None
    """None where its code shares the interpreter's."""
    overrides: dict[Any, Any]
    """The variables of modules that it has set for itself."""
    locals: dict[Any, Any]
    """The values of `ProcessLocal`."""

    @property
    def clock(self) -> ClockSource:
        """Where its time comes from, and how its threads wait."""
        ...

    @property
    def pid(self) -> int:
        """Synthetic, but that of the real process."""
        ...

    @property
    def env(self) -> MutableMapping[str, str]:
        """Its environment."""
        ...

    @property
    def cwd(self) -> str | None:
        """Where its child processes start; None: where the real process is."""
        ...

    @property
    def stdout(self) -> TextIOBase | None:
        """Its standard output stream; None where that is the real one."""
        ...

    @property
    def signals(self) -> SignalTable:
        """What it has said about its signals."""
        ...

    def deliver_signals(self) -> None:
        """Let signals that are on their way take effect first, where the caller is its main thread."""
        ...

    def on_interrupt(self, callback: Callable[[int], Any], signals: Iterable[int] = ...) -> Callable[[], None]:
        """Call `callback(signum)` first when one of the signals comes. Returns what takes the hook away."""
        ...

    def on_abandon(self, callback: Callable[[], Any]) -> Callable[[], None]:
        """Call `callback()` once it is over, however. Returns what takes the callback away."""
        ...

    def end_with_main(self, pool: Pool) -> None:
        """Once its main program is over, let a pool do what was submitted to it and end, and wait for that."""
        ...

    def guarded(self, callback: Callable[[], Any]) -> None:
        """Call back; an exception becomes a notice."""
        ...

    def die(self, code: int) -> None:
        """End now with this exit code, without last words."""
        ...

    def finish(self, code: int) -> None:
        """Record the end of the process, once, and tell everyone."""
        ...

    def break_off_later(self, states: Sequence[NodeThread]) -> None:
        """Give killed threads a moment to unwind; then raise in those that compute."""
        ...
