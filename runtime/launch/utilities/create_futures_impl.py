"""Creating futures in the launch's event loop."""

from __future__ import annotations

import asyncio
from typing import Any


def create_future(loop: asyncio.AbstractEventLoop | None) -> asyncio.Future[Any]:
    """A new future; raises `RuntimeError` where no loop runs."""
    return (asyncio.get_running_loop() if loop is None else loop).create_future()
