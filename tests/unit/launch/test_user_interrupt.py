"""The SIGINT handler of a launch: installed while it runs, then restored only if nobody replaced it."""

from __future__ import annotations

import asyncio
import signal
from typing import Any

from bot_console.runtime.process import NodeProcess
from bot_console.runtime.process.stepping.stepped_time import stepped
from launch.user_interrupt import UserInterrupt


def test_late_collection_of_a_killed_launch_keeps_another_programs_handler() -> None:
    interrupt = UserInterrupt(lambda again: None)
    found: list[Any] = []

    async def enter() -> None:
        interrupt.__enter__()

    def launches() -> None:
        loop = asyncio.new_event_loop()
        loop.run_until_complete(enter())
        loop.close()

    def collects() -> None:
        signal.signal(signal.SIGINT, own)
        interrupt.__exit__()
        found.append(signal.getsignal(signal.SIGINT))

    def own(number: int, frame: Any) -> None:
        """The handler of another program."""

    with stepped() as clock:
        for name, main in (("launch", launches), ("other", collects)):
            process = NodeProcess(name, clock)
            process.start(main)
            assert process.wait(1.0) == 0
    assert found == [own]
