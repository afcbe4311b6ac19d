"""Assertions about output and exit codes."""

from launch_testing.asserts.exit_codes import (
    EXIT_FORCED,
    EXIT_OK,
    EXIT_SIGINT,
    EXIT_SIGKILL,
    EXIT_SIGQUIT,
    EXIT_SIGTERM,
    assertExitCodes,
)
from launch_testing.asserts.output import (
    SequentialTextChecker,
    assertInStderr,
    assertInStdout,
    assertSequentialStdout,
)
from launch_testing.processes import NoMatchingProcessException

__all__ = [
    "EXIT_FORCED",
    "EXIT_OK",
    "EXIT_SIGINT",
    "EXIT_SIGKILL",
    "EXIT_SIGQUIT",
    "EXIT_SIGTERM",
    "NoMatchingProcessException",
    "SequentialTextChecker",
    "assertExitCodes",
    "assertInStderr",
    "assertInStdout",
    "assertSequentialStdout",
]
