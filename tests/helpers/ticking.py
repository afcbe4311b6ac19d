"""A program that does something at a fixed period, and records when."""

from __future__ import annotations

import time
from collections.abc import Callable

from bot_console.runtime.process import current


def ticker(trace: list[tuple[int, str]], name: str, period: float, count: int) -> Callable[[], None]:
    """Sleeps `period` s and records (steady ns, name), `count` times."""

    def run() -> None:
        for _ in range(count):
            time.sleep(period)
            trace.append((current().clock.steady_ns(), name))

    return run
