"""An asyncio loop in stepped time."""

from __future__ import annotations

import asyncio
import time

from bot_console.runtime.process import NodeProcess, stepped
from bot_console.runtime.process.stepping.event_loop import SteppedEventLoop


def test_loop_sleeps_in_virtual_time_while_nodes_run():
    order = []

    async def main():
        asyncio.get_running_loop().call_later(1.5, lambda: order.append(("timer", time.monotonic())))
        await asyncio.sleep(3600)
        order.append(("loop", time.monotonic()))

    def node():
        for _ in range(2):
            time.sleep(1.0)
            order.append(("node", time.monotonic()))

    with stepped() as clock:
        NodeProcess("n", clock).start(node)
        loop = SteppedEventLoop(clock)
        loop.run_until_complete(main())
        loop.close()
    assert order == [("node", 1.0), ("timer", 1.5), ("node", 2.0), ("loop", 3600.0)]


def test_other_threads_call_into_the_loop():
    with stepped() as clock:
        loop = SteppedEventLoop(clock)
        done = loop.create_future()

        def node():
            time.sleep(2.0)
            loop.call_soon_threadsafe(done.set_result, "called")

        NodeProcess("n", clock).start(node)
        assert loop.run_until_complete(done) == "called"
        assert clock.steady_ns() == 2 * 10**9
        assert clock.deterministic
        loop.close()
