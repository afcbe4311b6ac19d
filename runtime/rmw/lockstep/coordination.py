"""Let processes take part in a stepped run of this process."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager

from bot_console.runtime.process.lockstep.coordinator import Coordinator
from bot_console.runtime.process.stepping.stepped_time import SteppedTime
from bot_console.runtime.rmw.lockstep.bus import LockstepBuses
from bot_console.runtime.rmw.lockstep.session import Link
from bot_console.runtime.rmw.lockstep.switchboard import Operation, Switchboard
from bot_console.runtime.rmw.middleware import choose_middleware, chosen_middleware


@contextmanager
def coordinated_run(clock: SteppedTime, seed: int) -> Generator[None]:
    """Within the block, launches in this run start users' programs as separate processes that follow its clock.

    Contexts initialised in the block can communicate with those processes.
    """
    switchboard = Switchboard()

    def send(operation: Operation) -> None:
        own.handle(operation)

    link = Link(send, 0)
    link.published_elsewhere = switchboard.published
    own = switchboard.add(link.take)
    before = chosen_middleware()
    choose_middleware(LockstepBuses(link).of)
    coordinator = Coordinator(clock, switchboard, seed)
    try:
        yield
    finally:
        coordinator.close()
        choose_middleware(*before)
