"""Whether a Python program of a launch runs as a thread of this process or in a separate process."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.process import current
from launch.child import CAN_FORK, PythonProgram

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

CONFIGURATION = "isolation"
"""The launch configuration that decides for all: `isolation:=process` or `isolation:=thread`."""
PROCESS, THREAD = "process", "thread"

_default = [THREAD]


def isolate_by_default(kind: str) -> None:
    """Set the default without that configuration; `process` applies only to users' programs, not to ours."""
    _default[:] = [kind]


def has_own_process(context: LaunchContext, program: PythonProgram) -> bool:
    """Whether a program gets a separate process; raises `RuntimeError` for an invalid configuration.

    Never in a stepped run, where exactly one thread runs at a time.
    """
    wanted = context.launch_configurations.get(CONFIGURATION, "")
    if wanted not in ("", PROCESS, THREAD):
        raise RuntimeError(f"the launch argument '{CONFIGURATION}' must be '{PROCESS}' or '{THREAD}', not '{wanted}'")
    if not CAN_FORK or current().clock.stepped:
        return False
    return wanted == PROCESS or (not wanted and _default[0] == PROCESS and not program.is_ours)
