"""The life of a node of this package from start to a clean end."""

from __future__ import annotations

import sys
from collections.abc import Callable

import rclpy
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import ExternalShutdownException
from rclpy.logging import get_logger
from rclpy.node import Node


class CannotStart(Exception):
    """A node cannot do its work with what it was given; the text says why and how to mend it."""


def run(make_node: Callable[[], Node], args: list[str] | None) -> None:
    """Spin a node until it is interrupted or its context is shut down.

    A start value that is refused, or `CannotStart`, becomes one fatal log line and exit code 1.
    """
    rclpy.init(args=args)
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
        if _goes_on():
            raise
        # A signal has shut the context down while a callback was about to publish: that is the end, and no fault.
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


def _goes_on() -> bool:
    """Whether nothing has ended the program; a second signal may come just now."""
    try:
        return rclpy.ok()
    except KeyboardInterrupt:
        return False
