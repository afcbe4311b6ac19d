"""Spins a node beside a test."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from rclpy.executors import SingleThreadedExecutor

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.node import Node


class MessagePump:
    """Spins a node in a separate thread between `start` and `stop`; also a context manager."""

    def __init__(self, node: Node, context: Context | None = None) -> None:
        self._node = node
        self._context = context
        self._running = False
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Start spinning."""
        self._running = True
        self._thread = threading.Thread(target=self._spin, name="msg_pump_thread", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Stop spinning, and wait up to 5 s for that; raises `Exception` if a callback takes longer."""
        self._running = False
        if self._thread is not None:
            self._thread.join(timeout=5.0)
            if self._thread.is_alive():
                raise Exception("Timed out waiting for message pump to stop")

    def _spin(self) -> None:
        executor = SingleThreadedExecutor(context=self._context)
        executor.add_node(self._node)
        while self._running:
            executor.spin_once(timeout_sec=0.1)
        executor.remove_node(self._node)

    def __enter__(self) -> MessagePump:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()
