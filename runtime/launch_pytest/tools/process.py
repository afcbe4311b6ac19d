"""Waits until a process of the launch starts, ends or writes something.

A check of output may return a bool or make assertions. The functions ending in `_sync` are for plain tests; the others
are for coroutines in the loop of the launch.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch.actions.execute_process import ExecuteProcess
    from launch.launch_context import LaunchContext

_Check = Callable[[str], Any]
_POLL_S = 0.02
"""Time (s) between two polls."""


def _started(action: ExecuteProcess) -> bool:
    return "pid" in (action.process_details or {})


def _ended(action: ExecuteProcess) -> bool:
    return action.return_code is not None


def _accepts(check: _Check, text: str) -> bool:
    return check(text) in (None, True)


def _fits(check: _Check, read: Callable[[], str]) -> bool:
    try:
        return _accepts(check, read())
    except AssertionError:
        return False


def _wait_sync(condition: Callable[[], bool], timeout: float | None) -> bool:
    end = None if timeout is None else time.monotonic() + timeout
    while not condition():
        if end is not None and time.monotonic() >= end:
            return False
        time.sleep(_POLL_S)
    return True


async def _wait(condition: Callable[[], bool], timeout: float | None) -> bool:
    end = None if timeout is None else time.monotonic() + timeout
    while not condition():
        if end is not None and time.monotonic() >= end:
            return False
        await asyncio.sleep(_POLL_S)
    return True


def wait_for_start_sync(context: LaunchContext, action: ExecuteProcess, timeout: float | None = None) -> bool:
    """Return whether the process starts in time."""
    return _wait_sync(lambda: _started(action), timeout)


async def wait_for_start(context: LaunchContext, action: ExecuteProcess, timeout: float | None = None) -> bool:
    """Return whether the process starts in time."""
    return await _wait(lambda: _started(action), timeout)


def wait_for_exit_sync(context: LaunchContext, action: ExecuteProcess, timeout: float | None = None) -> bool:
    """Return whether the process ends in time."""
    return _wait_sync(lambda: _ended(action), timeout)


async def wait_for_exit(context: LaunchContext, action: ExecuteProcess, timeout: float | None = None) -> bool:
    """Return whether the process ends in time."""
    return await _wait(lambda: _ended(action), timeout)


def wait_for_output_sync(
    context: LaunchContext, action: ExecuteProcess, validate: _Check, timeout: float | None = None
) -> bool:
    """Return whether the output passes the check in time; at the end an assertion error of the check is raised."""
    return _wait_sync(lambda: _fits(validate, action.get_stdout), timeout) or _accepts(validate, action.get_stdout())


async def wait_for_output(
    context: LaunchContext, action: ExecuteProcess, validate: _Check, timeout: float | None = None
) -> bool:
    """Return whether the output passes the check in time; at the end an assertion error of the check is raised."""
    fits = await _wait(lambda: _fits(validate, action.get_stdout), timeout)
    return fits or _accepts(validate, action.get_stdout())


def wait_for_stderr_sync(
    context: LaunchContext, action: ExecuteProcess, validate: _Check, timeout: float | None = None
) -> bool:
    """Return whether the standard error passes the check in time, as `wait_for_output_sync` does for the output."""
    return _wait_sync(lambda: _fits(validate, action.get_stderr), timeout) or _accepts(validate, action.get_stderr())


async def wait_for_stderr(
    context: LaunchContext, action: ExecuteProcess, validate: _Check, timeout: float | None = None
) -> bool:
    """Return whether the standard error passes the check in time, as `wait_for_output` does for the output."""
    fits = await _wait(lambda: _fits(validate, action.get_stderr), timeout)
    return fits or _accepts(validate, action.get_stderr())


def assert_output_sync(
    context: LaunchContext, action: ExecuteProcess, validate: _Check, timeout: float | None = None
) -> None:
    """Assert that `wait_for_output_sync` succeeds."""
    assert wait_for_output_sync(context, action, validate, timeout), "waiting for output timed out"


async def assert_output(
    context: LaunchContext, action: ExecuteProcess, validate: _Check, timeout: float | None = None
) -> None:
    """Assert that `wait_for_output` succeeds."""
    assert await wait_for_output(context, action, validate, timeout), "waiting for output timed out"


def assert_stderr_sync(
    context: LaunchContext, action: ExecuteProcess, validate: _Check, timeout: float | None = None
) -> None:
    """Assert that `wait_for_stderr_sync` succeeds."""
    assert wait_for_stderr_sync(context, action, validate, timeout), "waiting for stderr timed out"


async def assert_stderr(
    context: LaunchContext, action: ExecuteProcess, validate: _Check, timeout: float | None = None
) -> None:
    """Assert that `wait_for_stderr` succeeds."""
    assert await wait_for_stderr(context, action, validate, timeout), "waiting for stderr timed out"
