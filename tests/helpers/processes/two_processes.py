"""A node in this process and nodes in other processes, in a separate domain."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.zenoh.domain.domain_bus import close_shared_buses, shared_bus
from helpers.processes.mesh import eventually
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

DOMAIN = 61
PEER = Path(__file__).with_name("zenoh_peer.py")


class Here:
    """This process's node, spun while the test waits for something."""

    def __init__(self):
        self.context = Context()
        self.context.init([], domain_id=DOMAIN)
        self.node = Node("here", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)

    def until(self, true: Callable[[], Any]) -> None:
        """Spin the node until a condition holds."""

        def spun():
            self.executor.spin_once(timeout_sec=0.01)
            return true()

        assert eventually(spun)

    def result(self, future: Any) -> Any:
        """Spin the node until a future is done; return its result."""
        self.until(future.done)
        return future.result()


@contextlib.contextmanager
def two_processes(folder: Path, peers: int = 1, *words: str) -> Iterator[tuple[Here, list[subprocess.Popen[bytes]]]]:
    """This process's node, and the discovered processes of `zenoh_peer.py WORDS`; their sockets are in a folder."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BOT_CONSOLE_SOCKET_DIR", str(folder))
        patch.setenv("BOT_CONSOLE_USER_DIR", f"{folder}-user")
        patch.setenv("ROS_DOMAIN_ID", str(DOMAIN))
        choose_middleware(shared_bus)
        started = [subprocess.Popen([sys.executable, str(PEER), *words], env=dict(os.environ)) for _ in range(peers)]
        here = Here()
        try:
            here.until(lambda: here.node.count_publishers("/echo") == peers)
            yield here, started
        finally:
            for each in started:
                each.kill()
                each.wait()
            here.node.destroy_node()
            here.context.shutdown()
            choose_middleware(local_bus)
            close_shared_buses()
