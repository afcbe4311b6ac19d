"""The entities that a launch is waiting for."""

from __future__ import annotations

import asyncio
from collections import deque
from typing import TYPE_CHECKING

from launch.launch_place import report_visited

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity


class PendingEntities:
    """Futures of entities that are not done, and a wait for any change, at constant cost."""

    def __init__(self) -> None:
        self._futures: dict[asyncio.Future[None], LaunchDescriptionEntity] = {}
        self._failures: deque[BaseException] = deque()
        self._waiter: asyncio.Future[None] | None = None
        self._woken = False

    def __bool__(self) -> bool:
        return bool(self._futures or self._failures)

    @property
    def entities(self) -> list[LaunchDescriptionEntity]:
        """The entities that are not done; may be read in any thread."""
        return list(self._futures.values())

    def add(self, future: asyncio.Future[None], entity: LaunchDescriptionEntity) -> None:
        """Add the future of an entity."""
        if future not in self._futures:
            self._futures[future] = entity
            future.add_done_callback(lambda done: self._done(done, entity))

    def raise_failures(self) -> None:
        """Raise the exception of a future that has failed, but only once."""
        if self._failures:
            raise self._failures.popleft()

    def wake(self) -> None:
        """Wake the waiting thread, as something has changed."""
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

    def _done(self, future: asyncio.Future[None], entity: LaunchDescriptionEntity) -> None:
        self._futures.pop(future, None)
        if not future.cancelled():
            error = future.exception()
            if error is not None:
                report_visited(error, entity)
                self._failures.append(error)
        self.wake()
