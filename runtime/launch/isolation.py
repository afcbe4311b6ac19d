"""Whether a Python program of a launch gets a process of its own: every program of a user does, ours are composed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.children.child_discovery import children_meet
from bot_console.runtime.process import current
from bot_console.runtime.process.lockstep.coordinator import coordinator_of
from launch.child import CAN_FORK, PythonProgram

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

CONFIGURATION = "isolation"
"""The launch configuration with which our nodes get processes, too: `isolation:=process`."""
PROCESS = "process"


def has_own_process(context: LaunchContext, program: PythonProgram) -> bool:
    """Whether a program gets a separate process; raises `RuntimeError` for an invalid configuration.

    A user's program gets none where it could not meet the nodes of this process: in a system that is isolated in it,
    in a stepped run without a coordinator, and on a platform that cannot fork.
    """
    wanted = context.launch_configurations.get(CONFIGURATION, "")
    if wanted not in ("", PROCESS):
        raise RuntimeError(
            f"the launch argument '{CONFIGURATION}' must be '{PROCESS}', not '{wanted}': programs of yours always run "
            f"in processes of their own, and with '{CONFIGURATION}:={PROCESS}' the robot's nodes do, too"
        )
    clock = current().clock
    if not CAN_FORK or (clock.stepped and coordinator_of(clock) is None):
        return False
    return wanted == PROCESS or (not program.is_ours and (clock.stepped or children_meet()))
