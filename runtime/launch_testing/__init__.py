"""Tests of launched processes, as upstream's `launch_testing`: with unittest, alone or under pytest."""

from launch_testing import actions, asserts, event_handlers, markers, tools, util
from launch_testing.decorators import parametrize, post_shutdown_test, ready_to_test_action_timeout
from launch_testing.io_handler import ActiveIoHandler, IoHandler
from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler

__all__ = [
    "ActiveIoHandler",
    "ActiveProcInfoHandler",
    "IoHandler",
    "ProcInfoHandler",
    "actions",
    "asserts",
    "event_handlers",
    "markers",
    "parametrize",
    "post_shutdown_test",
    "ready_to_test_action_timeout",
    "tools",
    "util",
]
