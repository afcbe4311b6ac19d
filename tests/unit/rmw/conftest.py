"""Fixtures for tests of the middleware."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import rclpy


@pytest.fixture
def node() -> Iterator[Any]:
    """A node with its own context."""
    rclpy.init()
    made = rclpy.create_node("talker")
    yield made
    made.destroy_node()
    rclpy.try_shutdown()
