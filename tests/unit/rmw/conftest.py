"""What tests of the middleware begin with."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import rclpy


@pytest.fixture
def node() -> Iterator[Any]:
    """A node in a context of its own."""
    rclpy.init()
    made = rclpy.create_node("talker")
    yield made
    made.destroy_node()
    rclpy.try_shutdown()
