"""Calls, from a thread, of services that nodes of a launch offer."""

from __future__ import annotations

import threading
from logging import Logger
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import InvalidHandle
from rclpy.executors import ShutdownException

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from rclpy.client import Client
    from rclpy.task import Future

POLL_S = 1.0


def answered_call(client: Client, request: Any, context: LaunchContext, logger: Logger) -> Future[Any] | None:
    """Wait for a service and its response; returns None, and logs a warning, if the launch shuts down before."""
    awaited = f"'{client.srv_name}' service"
    try:
        while not client.wait_for_service(timeout_sec=0.0 if context.is_shutdown else POLL_S):
            if context.is_shutdown:
                raise ShutdownException
        awaited += " response"
        answered = threading.Event()
        future = client.call_async(request)
        future.add_done_callback(lambda _: answered.set())
        while not answered.wait(POLL_S):
            if context.is_shutdown:
                raise ShutdownException
    except (ShutdownException, InvalidHandle):  # the shutdown also destroys the client, while this thread waits
        logger.warning(f"Abandoning wait for the {awaited}, due to shutdown.")
        return None
    return future
