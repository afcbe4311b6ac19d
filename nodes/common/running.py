"""Runs a node of this package from startup to a clean shutdown."""

from __future__ import annotations

import contextlib
import signal
import sys
from collections.abc import Callable

import rclpy
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import ExternalShutdownException
from rclpy.logging import get_logger
from rclpy.node import Node


class CannotStart(Exception):
    """A node cannot work with its configuration; the message says why and how to fix it."""


def run(make_node: Callable[[], Node], args: list[str] | None) -> None:
    """Spin a node until it is interrupted or its context is shut down.

    A refused initial value, or `CannotStart`, becomes one fatal log line and exit code 1.
    """
    _interrupt_once()
    with contextlib.suppress(KeyboardInterrupt):  # also if it arrives while an error is being handled
        _spin(make_node, args)


def _spin(make_node: Callable[[], Node], args: list[str] | None) -> None:
    try:
        rclpy.init(args=args)
        _spin_node(make_node)
    finally:
        rclpy.try_shutdown()


def _spin_node(make_node: Callable[[], Node]) -> None:
    node: Node | None = None
    try:
        node = make_node()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (CannotStart, InvalidParameterTypeException, InvalidParameterValueException) as error:
        get_logger(make_node.__name__).fatal(str(error))
        sys.exit(1)
    except Exception:
        if rclpy.ok():
            raise
        # A signal may shut the context down while a callback is about to publish: a normal end, not an error.
    finally:
        if node is not None:
            node.destroy_node()


def _interrupt_once() -> None:
    """Raise KeyboardInterrupt only for the first Ctrl-C: another one would end the shutdown with a traceback."""
    raised = False

    def interrupt(number: int, frame: object) -> None:
        nonlocal raised
        if not raised:
            raised = True
            raise KeyboardInterrupt

    with contextlib.suppress(ValueError):  # not in the main thread
        signal.signal(signal.SIGINT, interrupt)
