"""The life cycle of one launched process: what was requested of it and what happened to it. No launch API, no locks."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from enum import Enum

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.launch.restart_policy import DEFAULT_RESTARTS, STEADY_S, RestartPolicy
from bot_console.tui.console.model import ProcessInfo, ProcessState, Program

INTERRUPTED = (0, -2, -15, 130)
"""Exit codes of a process that ended on request."""
KILLED = -9
MAX_PID = 1 << 22
"""The highest process id that Linux assigns; a node that shares its process with others has a placeholder above it."""

STARTS = ("start", "restart")
POLICIES = ("restart_on_failure", "leave_ended")
ENDED = (ProcessState.EXITED, ProcessState.CRASHED, ProcessState.ABANDONED, ProcessState.MISSING)


class Order(Enum):
    """The next action to take on a process."""

    NOTHING = 0
    START = 1
    SHUT_DOWN = 2
    """Send SIGINT, and escalate as launch does."""
    KILL = 3


class LaunchedProcess:
    """The displayed state of a process, and the requests that wait for its next change."""

    def __init__(
        self,
        key: str,
        label: str,
        group: tuple[str, ...] = (),
        program: Program | None = None,
        *,
        policy: RestartPolicy = DEFAULT_RESTARTS,
        restarts: bool = False,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`restarts` says whether `policy` applies from the beginning; `clock` returns seconds."""
        self._policy = policy
        self._clock = clock
        self._attempts = 0
        """Consecutive restarts after failures."""
        self._began = 0.0
        self._due: float | None = None
        """The time (of `clock`) at which it is due for a restart."""
        self.info = ProcessInfo(key, label, ProcessState.STARTING, group=group, program=program)
        if restarts and not self._respawns:
            self.info = replace(self.info, restart_policy=policy.text)
        self._starts = 0
        self._alive = False
        self._ran = False
        self._reported = False
        self._again = False
        self._fault = self._stall_reason = ""
        self._waiting: list[tuple[str, Future[Answer]]] = []

    @property
    def _respawns(self) -> bool:
        """Whether launch respawns the process."""
        return self.info.program is not None and self.info.program.respawn

    def due(self) -> Order:
        """The order that is due now: to start the process if its delay after a failure is over."""
        if self._due is None or self._clock() < self._due:
            return Order.NOTHING
        return self._start()

    def forget_restart(self) -> None:
        """Cancel a due restart, because its launch has ended."""
        if self._due is not None:
            self._due = None
            code = self.info.exit_code
            self.info = replace(self.info, problem=self._why(code or 0))

    @property
    def alive(self) -> bool:
        """Whether it was started and has not ended."""
        return self._alive

    def want(self, verb: str) -> tuple[Order, Future[Answer]]:
        """Request one of `start`, `stop`, `kill`, `restart`, answered when that is done, or one of `POLICIES`."""
        outcome: Future[Answer] = Future()
        if verb in POLICIES or (verb not in STARTS and self._due is not None):
            outcome.set_result(self._set_policy(verb) if verb in POLICIES else self._cancel_restart())
            return Order.NOTHING, outcome
        refusal = self._refusal(verb)
        if refusal:
            outcome.set_result(Answer(False, refusal))
            return Order.NOTHING, outcome
        self._waiting.append((verb, outcome))
        return (self._want_running(verb) if verb in STARTS else self._want_ended(verb)), outcome

    def _set_policy(self, verb: str) -> Answer:
        label = self.info.label
        if self._respawns:
            return Answer(False, f"{label}: its launch file says when it is started again (respawn)")
        wanted = verb == "restart_on_failure"
        if not wanted:
            self.forget_restart()
        self._attempts = 0
        self.info = replace(self.info, restart_policy=self._policy.text if wanted else "")
        return Answer(True, f"{label} is restarted {self.info.restart_policy}" if wanted else f"{label} stays ended")

    def _cancel_restart(self) -> Answer:
        self.forget_restart()
        return Answer(True, f"{self.info.label} is not restarted")

    def _refusal(self, verb: str) -> str:
        state, label = self.info.state, self.info.label
        if state is ProcessState.MISSING:
            return f"{label} is not available here: {self.info.problem}"
        if verb == "start" and state is ProcessState.RUNNING:
            return f"{label} is already running"
        if verb in STARTS and state is ProcessState.STARTING:
            return f"{label} is starting already"
        if verb not in STARTS and state in ENDED:
            return f"{label} is not running"
        return ""

    def _want_running(self, verb: str) -> Order:
        if self.info.state in ENDED:
            return self._start()
        self._again = True
        return self._request_exit() if self.info.state is ProcessState.RUNNING else Order.NOTHING

    def _want_ended(self, verb: str) -> Order:
        if self._again:
            self._again = False
            done = "killed" if verb == "kill" else "stopped"
            self._settle(STARTS, Answer(False, f"{self.info.label} was {done} instead"))
        if verb == "kill" and self._alive:
            self._request_exit()
            return Order.KILL
        return Order.NOTHING if self.info.state is ProcessState.STOPPING else self._request_exit()

    def _start(self) -> Order:
        self._again = self._reported = self._ran = False
        self._due = None
        self.info = replace(self.info, state=ProcessState.STARTING, problem="")
        return Order.START

    def _request_exit(self) -> Order:
        self.exit_requested()
        return Order.SHUT_DOWN

    def exit_requested(self) -> None:
        """Record that a person, or the end of the launch, has requested its end."""
        if self.info.state not in ENDED:
            self._reported = True
            requested = self.info.end_requested if self.info.state is ProcessState.STOPPING else time.time_ns()
            self.info = replace(self.info, state=ProcessState.STOPPING, end_requested=requested)

    def started(self, label: str, pid: int, nodes: tuple[str, ...] = ()) -> Order:
        """Record that it runs, requested or not; launch may change its label each time.

        A node without a process of its own has a placeholder for a process id, which is not kept.
        """
        own = pid if pid <= MAX_PID else None
        restarts, self._starts, self._alive = self._starts, self._starts + 1, True
        self._ran, self._stall_reason = True, ""
        self._began = self._clock()
        state = ProcessState.STOPPING if self._reported else ProcessState.RUNNING
        nodes = nodes or self.info.nodes
        self.info = replace(
            self.info,
            label=label,
            state=state,
            pid=own,
            nodes=nodes,
            restarts=restarts,
            problem="",
            started=time.time_ns(),
        )
        if self._reported:
            return Order.SHUT_DOWN
        self._settle(STARTS, Answer(True, f"{self.info.label} runs" + (f", pid {own}" if own else "")))
        return Order.NOTHING

    def missing(self, why: str) -> None:
        """Record that its executable is missing and that the launch continues without it."""
        self.info = replace(self.info, state=ProcessState.MISSING, problem=why)

    def exited(self, code: int, respawns: bool, fault: str = "") -> Order:
        """Record that it has ended; `respawns`: launch will start it again, `fault`: the exception that it printed."""
        self._fault = fault
        self._alive = False
        self.info = replace(self.info, exit_code=code, pid=None, cpu=None, memory=None, ended=time.time_ns())
        if not respawns:
            return self._end()
        if any(verb == "stop" for verb, _ in self._waiting):
            return Order.NOTHING  # it had just ended without a request; launch already knows not to start it again
        self._reported = False
        why = f"{self._why(code)}; launch starts it again" if code else ""
        self.info = replace(self.info, state=ProcessState.STARTING, problem=why)
        self._settle(("stop", "kill"), Answer(True, f"{self.info.label} has ended, and launch starts it again"))
        return Order.NOTHING

    def over(self, why: str = "") -> Order:
        """Record that launch will not start it again; `why` says what went wrong if it never ran."""
        if self._alive or self.info.state in ENDED:
            return Order.NOTHING
        if not self._ran and not self._reported:
            problem = why or "it did not start; the log says why"
            self.info = replace(self.info, state=ProcessState.CRASHED, problem=problem)
            self._again = False
            self._settle(STARTS, Answer(False, f"{self.info.label}: {problem}"))
        return self._end()

    def _end(self) -> Order:
        code = self.info.exit_code if self._ran else None
        if self.info.state not in ENDED:
            fine = code is None or (code in INTERRUPTED if self._reported else code == 0)
            state = ProcessState.EXITED if fine else ProcessState.CRASHED
            self.info = replace(self.info, state=state, problem="" if fine else self._why(code or 0))
            if not fine and self._ran and not self._reported and not self._again and self.info.restart_policy:
                self._schedule_restart()
        ended = "" if code is None else f", exit code {code}"
        self._settle(("stop", "kill"), Answer(True, f"{self.info.label} has ended{ended}"))
        if self._again:
            return self._start()
        self._settle(STARTS, Answer(False, f"{self.info.label} has ended{ended}"))
        return Order.NOTHING

    def _schedule_restart(self) -> None:
        if self._clock() - self._began >= STEADY_S:
            self._attempts = 0
        if self._attempts >= self._policy.attempts:
            often = "once" if self._attempts == 1 else f"{self._attempts} times"
            text = f"given up after it was restarted {often}: {self.info.problem}"
        else:
            self._attempts += 1
            delay = self._policy.delay_before(self._attempts)
            self._due = self._clock() + delay
            count = f"{self._attempts} of {self._policy.attempts}"
            text = f"restarts after {delay:g} s ({count}): {self.info.problem}"
        self.info = replace(self.info, problem=text)

    def _why(self, code: int) -> str:
        """Why it has ended: the signal, the exception that it printed, or the exit code."""
        return _reason(code) if code < 0 or not self._fault else self._fault

    def abandoned(self, where: str) -> None:
        """Record that some of its code still runs although it was killed."""
        problem = f"was killed, but some of its code keeps running: {where}"
        self.info = replace(self.info, state=ProcessState.ABANDONED, problem=problem)

    def uses(self, cpu: float | None, memory: int | None) -> bool:
        """Set its CPU usage (1.0 is one whole CPU) and its memory (MB); returns whether they have changed."""
        if (cpu, memory) == (self.info.cpu, self.info.memory) or not self._alive:
            return False
        self.info = replace(self.info, cpu=cpu, memory=memory)
        return True

    def set_stall_reason(self, why: str) -> bool:
        """Set the reason why it makes no progress, empty if it does; returns whether the reason has changed."""
        if why == self._stall_reason or not self._alive:
            return False
        self._stall_reason = why
        self.info = replace(self.info, problem=why)
        return True

    def _settle(self, verbs: tuple[str, ...], answer: Answer) -> None:
        due = [outcome for verb, outcome in self._waiting if verb in verbs]
        self._waiting = [each for each in self._waiting if each[0] not in verbs]
        for outcome in due:
            outcome.set_result(answer)


def _reason(code: int) -> str:
    if code == KILLED:
        return f"was killed (exit code {code})"
    if code < 0:
        return f"was ended by {_signal(-code)} (exit code {code}); its last lines are in the log"
    return f"ended with exit code {code}; its last lines are in the log"


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:  # a real-time signal
        return f"signal {number}"
