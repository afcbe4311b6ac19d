"""A launch description that runs beside tests, in a separate thread with its own event loop."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Coroutine
from concurrent.futures import Future, wait
from typing import Any

from bot_console.runtime.process.stepping.event_loop import new_event_loop
from launch_testing.actions.ready import ReadyToTest
from launch_testing.test_run import entities_of

from launch import LaunchDescription, LaunchService

END_TIMEOUT_S = 30.0
"""Time (s) within which a launch has to end."""


class Running:
    """Starts in the constructor and returns when the launch is ready; `close` ends its loop."""

    def __init__(
        self, description: LaunchDescription, shutdown_when_idle: bool = True, auto_shutdown: bool = True
    ) -> None:
        marks = [each for each in entities_of(description) if isinstance(each, ReadyToTest)]
        if len(marks) > 1:
            raise RuntimeError(
                "launch_pytest fixtures must return a LaunchDescription containing only one ReadyToTest action"
            )
        if not marks:
            marks = [ReadyToTest()]
            description.add_action(marks[0])
        ready: Future[None] = Future()
        marks[0]._add_callback(lambda: None if ready.done() else ready.set_result(None))
        self._ends_itself = not auto_shutdown
        self.loop = new_event_loop()
        self.service = LaunchService(noninteractive=True)
        self.service.include_launch_description(description)
        self._thread = threading.Thread(target=self.loop.run_forever, daemon=True)
        self._thread.start()
        self._ended = self._submit(self.service.run_async(shutdown_when_idle=shutdown_when_idle))
        wait((ready, self._ended), return_when="FIRST_COMPLETED")
        if not ready.done():
            self.close()
            raise RuntimeError(f"launch ended before it was ready: {self.service.failure}")

    def _submit(self, work: Coroutine[Any, Any, Any]) -> Future[Any]:
        return asyncio.run_coroutine_threadsafe(work, self.loop)

    def run(self, work: Coroutine[Any, Any, Any]) -> Any:
        """Run a coroutine in the loop of the launch and return its result."""
        return self._submit(work).result()

    def shutdown(self) -> None:
        """End the launch, unless it is to end by itself, and wait for its end; the loop keeps running."""
        if not self._ends_itself:
            self.service.shutdown()
        self._ended.result(END_TIMEOUT_S)

    def close(self) -> None:
        """End the launch, the loop and the thread."""
        try:
            self.shutdown()
        finally:
            self.loop.call_soon_threadsafe(self.loop.stop)
            self._thread.join(END_TIMEOUT_S)
            self.loop.close()
