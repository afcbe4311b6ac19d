"""Assertions about the exit codes of processes."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from launch_testing.util import resolveProcesses

EXIT_OK = 0
EXIT_SIGINT = 130
EXIT_SIGQUIT = 131
EXIT_SIGTERM = 143
EXIT_SIGKILL = 137
EXIT_SIGSEGV = 139
EXIT_FORCED = 1


def assertExitCodes(
    proc_info: Any, allowable_exit_codes: Collection[int] = (EXIT_OK,), process: Any = None, cmd_args: Any = None, *,
    strict_proc_matching: bool = True,
) -> None:  # fmt: skip
    """Assert that all processes, or the selected ones, have ended with one of these codes.

    A process ended by a signal has the negative signal number; the codes in `EXIT_SIG...` are those that a program or
    shell returns itself.
    """
    for code in allowable_exit_codes:
        assert isinstance(code, int), f"Provided exit code {code} is not an int"
    meant = resolveProcesses(proc_info, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching)
    for info in [proc_info[action] for action in meant]:
        assert info.returncode in allowable_exit_codes, f"Proc {info.process_name} exited with code {info.returncode}"
