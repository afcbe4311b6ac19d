"""Assertions about how processes have ended."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from launch_testing.processes import resolve

EXIT_OK = 0
EXIT_SIGINT = 130
EXIT_SIGQUIT = 131
EXIT_SIGTERM = 143
EXIT_SIGKILL = 137
EXIT_FORCED = 1
SIGNALS = {EXIT_SIGINT: -2, EXIT_SIGQUIT: -3, EXIT_SIGTERM: -15, EXIT_SIGKILL: -9}
"""What Python says of a process that a signal has ended, by what a shell says."""


def assertExitCodes(
    proc_info: Any, allowable_exit_codes: Iterable[int] = (EXIT_OK,), process: Any = None, cmd_args: Any = None, *,
    strict_proc_matching: bool = True,
) -> None:  # fmt: skip
    """Assert that all processes, or those that are meant, have ended with one of these codes."""
    allowed = set(allowable_exit_codes)
    allowed |= {SIGNALS[each] for each in allowed if each in SIGNALS}
    for action in resolve(proc_info.processes(), process, cmd_args, strict_proc_matching):
        info = proc_info[action]
        assert info.returncode in allowed, f"Proc {info.process_name} exited with code {info.returncode}"
