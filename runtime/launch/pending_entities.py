"""What a launch still waits for."""

from __future__ import annotations

import asyncio
from collections import deque
from typing import Any


class PendingEntities:
    """Futures of entities that are not done, and a way to wait until anything changes, at a cost that is flat."""

    def __init__(self) -> None:
        self._futures: set[asyncio.Future[Any]] = set()
        self._failures: deque[BaseException] = deque()
        self._waiter: asyncio.Future[None] | None = None
        self._woken = False

    def __bool__(self) -> bool:
        return bool(self._futures or self._failures)

    def add(self, future: asyncio.Future[Any]) -> None:
        """Wait for a future, too."""
        if future not in self._futures:
            self._futures.add(future)
            future.add_done_callback(self._done)

    def raise_failures(self) -> None:
        """Raise the exception of a future that has failed, once."""
        if self._failures:
            raise self._failures.popleft()

    def wake(self) -> None:
        """Something has changed."""
        self._woken = True
        if self._waiter is not None and not self._waiter.done():
            self._waiter.set_result(None)

    async def changed(self) -> None:
        """Block until something has changed since the last call."""
        if not self._woken:
            self._waiter = asyncio.get_running_loop().create_future()
            try:
                await self._waiter
            finally:
                self._waiter = None
        self._woken = False

    def _done(self, future: asyncio.Future[Any]) -> None:
        self._futures.discard(future)
        if not future.cancelled():
            error = future.exception()
            if error is not None:
                self._failures.append(error)
        self.wake()
