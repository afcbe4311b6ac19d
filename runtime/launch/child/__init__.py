"""The process behind an action that executes something.

It is an operating system process (`os_child`), a node process, i.e. a thread of this process (`node_child`), or a
separate process for a Python program (`forked_child`).
"""

from bot_console.runtime.children.own_fork_server import CAN_FORK, close_fork_server, fork_server
from launch.child.child import Child, Output
from launch.child.process_reports import News, on_news, report_news
from launch.child.python_program import PythonProgram
from launch.child.start import start_child

__all__ = [
    "CAN_FORK",
    "Child",
    "News",
    "Output",
    "PythonProgram",
    "close_fork_server",
    "fork_server",
    "on_news",
    "report_news",
    "start_child",
]
