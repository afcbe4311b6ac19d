"""Decorators for test descriptions and tests."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable
from typing import Any

KEEP_ALIVE = "__launch_testing_keep_alive"


def keep_alive(test_description: object) -> Any:
    """Mark a description without `ReadyToTest` or processes: tests begin at once, and the launch keeps running."""
    setattr(test_description, KEEP_ALIVE, True)
    return test_description


def retry_on_failure(
    *, times: int | None = None, timeout: float | None = None, delay: float = 0.0
) -> Callable[..., Any]:
    """Repeat a failing test up to `times` times or for `timeout` seconds, with `delay` seconds in between."""
    if times is None and timeout is None:
        raise ValueError("either times or timeout has to be given")

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(function)
        def again(*args: object, **kwargs: object) -> Any:
            deadline = None if timeout is None else time.monotonic() + timeout
            left = times
            while True:
                try:
                    return function(*args, **kwargs)
                except AssertionError:
                    left = None if left is None else left - 1
                    if left == 0 or (deadline is not None and time.monotonic() >= deadline):
                        raise
                time.sleep(delay)

        return again

    return decorate
