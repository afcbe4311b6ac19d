"""Tests of what a launch description starts, as upstream's `launch_testing`: with unittest, alone or under pytest."""

from launch_testing import actions, asserts, markers
from launch_testing.decorators import parametrize, post_shutdown_test
from launch_testing.io_handler import ActiveIoHandler, IoHandler
from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler

__all__ = [
    "ActiveIoHandler",
    "ActiveProcInfoHandler",
    "IoHandler",
    "ProcInfoHandler",
    "actions",
    "asserts",
    "markers",
    "parametrize",
    "post_shutdown_test",
]
