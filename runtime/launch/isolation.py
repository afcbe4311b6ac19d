"""Whether a Python program of a launch gets its own process: every user program does, our nodes are composed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.child import CAN_FORK, PythonProgram

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

CONFIGURATION = "isolation"
"""The launch configuration that gives our nodes processes of their own, too: `isolation:=process`."""
PROCESS = "process"


def has_own_process(context: LaunchContext, program: PythonProgram) -> bool:
    """Whether a program gets a separate process; raises `RuntimeError` for an invalid configuration."""
    wanted = context.launch_configurations.get(CONFIGURATION, "")
    if wanted not in ("", PROCESS):
        raise RuntimeError(
            f"the launch argument '{CONFIGURATION}' must be '{PROCESS}', not '{wanted}': programs of yours always run "
            f"in processes of their own, and with '{CONFIGURATION}:={PROCESS}' the robot's nodes do, too"
        )
    return not program.is_ours or (CAN_FORK and wanted == PROCESS)
