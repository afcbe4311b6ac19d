"""Whether a process that has ended is restarted."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from launch.utilities.type_utils import perform_typed_substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class Respawn:
    """Respawns after any exit, until the launch ends or the retries are used up (-1 means no limit)."""

    def __init__(self, wanted: bool | SomeSubstitutionsType, delay: float | None, max_retries: int) -> None:
        self._wanted = wanted
        self.delay = delay
        self._max_retries = max_retries
        self._retries = 0
        self.is_wanted = False

    def evaluate(self, context: LaunchContext) -> None:
        """Evaluate whether respawning is wanted at all."""
        self.is_wanted = bool(perform_typed_substitution(context, self._wanted, bool))

    async def wanted(self, context: LaunchContext, shutdown: asyncio.Future[None] | None) -> bool:
        """Wait for the delay (s) or the end of the launch; return whether to respawn."""
        if not self.is_wanted or context.is_shutdown or shutdown is None or shutdown.done():
            return False
        if 0 <= self._max_retries <= self._retries:
            return False
        self._retries += 1
        if self.delay is not None and self.delay > 0.0:
            await asyncio.wait([shutdown], timeout=self.delay)
        return not shutdown.done()
