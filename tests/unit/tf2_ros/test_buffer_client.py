"""The buffer client, which queries another process: the times it accepts."""

from __future__ import annotations

from typing import Any

import pytest
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import BufferClient, TimeoutException


@pytest.fixture
def client(node: Node) -> BufferClient:
    return BufferClient(node, "nobody_serves")


def test_message_stamp_is_accepted_with_a_warning(client: BufferClient) -> None:
    stamp: Any = Time(seconds=1).to_msg()
    with (
        pytest.warns(UserWarning, match=r"builtin_interfaces\.msg\.Time argument is deprecated"),
        pytest.raises(TimeoutException, match="The BufferServer is not ready"),
    ):
        client.lookup_transform("foo", "bar", stamp)


def test_other_time_types_are_rejected(client: BufferClient) -> None:
    second: Any = 1.0
    with pytest.raises(TypeError, match=r"Must pass a rclpy\.time\.Time object"):
        client.lookup_transform("foo", "bar", second)
