"""Selection of processes, and a process that only keeps the launch running."""

import sys

from launch.actions import ExecuteProcess
from launch_testing.util.proc_lookup import NO_CMD_ARGS, NoMatchingProcessException, resolveProcesses

__all__ = ["NO_CMD_ARGS", "KeepAliveProc", "NoMatchingProcessException", "resolveProcesses"]

_STAY = """
import time
try:
    while True:
        time.sleep(3600)
except KeyboardInterrupt:
    pass
"""


def KeepAliveProc() -> ExecuteProcess:
    """Return a process that runs until the launch ends, for tests whose own processes may all end earlier."""
    return ExecuteProcess(cmd=[sys.executable, "-c", _STAY])
