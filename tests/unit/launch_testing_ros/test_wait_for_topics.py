"""`WaitForTopics` waits for messages."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Iterator
from typing import Any

import pytest
import rclpy
from launch_testing_ros import WaitForTopics
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from std_msgs.msg import Int32, String


def _spin(executor: SingleThreadedExecutor) -> None:
    with contextlib.suppress(ExternalShutdownException):
        executor.spin()


@pytest.fixture
def talker() -> Iterator[Any]:
    """A node that publishes repeatedly, even without subscribers."""
    rclpy.init()
    node = rclpy.create_node("talker")
    publisher = node.create_publisher(String, "said", 10)
    node.create_timer(0.02, lambda: publisher.publish(String(data="hi")))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=_spin, args=(executor,), daemon=True)
    thread.start()
    yield node
    executor.shutdown()
    thread.join(240.0)
    node.destroy_node()
    rclpy.shutdown()


def test_received_messages_are_kept(talker: Any) -> None:
    with WaitForTopics([("said", String)], timeout=240.0) as waited:
        assert waited.topics_received() == {"said"}
        assert waited.received_messages("said")[0].data == "hi"
        with pytest.raises(KeyError):
            waited.received_messages("other")


def test_timeout_error_names_missing_topics(talker: Any) -> None:
    with pytest.raises(RuntimeError, match="never"), WaitForTopics([("never", Int32), ("said", String)], timeout=0.2):
        pass


@pytest.mark.parametrize("arguments", [None, 5])
def test_callback_is_called_once_in_the_wait(talker: Any, arguments: int | None) -> None:
    calls: list[tuple[Any, ...]] = []
    waited = WaitForTopics(
        [("said", String)], timeout=240.0, callback=lambda *given: calls.append(given), callback_arguments=arguments
    )
    assert calls == []
    assert waited.wait() and waited.wait()
    waited.shutdown()
    assert [len(each) for each in calls] == [1 if arguments is None else 2]
