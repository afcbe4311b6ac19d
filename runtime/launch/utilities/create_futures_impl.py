"""Creating futures in the launch's event loop."""

from __future__ import annotations

import asyncio


def create_future(loop: asyncio.AbstractEventLoop | None) -> asyncio.Future[None]:
    """Return a new future; raises `RuntimeError` if no loop is running."""
    return (asyncio.get_running_loop() if loop is None else loop).create_future()
