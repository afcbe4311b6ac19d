"""Whether a Python program of a launch runs as a thread of this process or in a separate process."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.process import current
from bot_console.runtime.process.lockstep.coordinator import coordinator_of
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

    In a stepped run without a coordinator none does: only threads of this process take turns in it.
    """
    wanted = context.launch_configurations.get(CONFIGURATION, "")
    if wanted not in ("", PROCESS, THREAD):
        raise RuntimeError(f"the launch argument '{CONFIGURATION}' must be '{PROCESS}' or '{THREAD}', not '{wanted}'")
    clock = current().clock
    if not CAN_FORK or (clock.stepped and coordinator_of(clock) is None):
        return False
    users_default = PROCESS if clock.stepped else _default[0]
    return wanted == PROCESS or (not wanted and users_default == PROCESS and not program.is_ours)
