"""Whether a publisher sends directly or through the thread that drops nothing depends on its QoS."""

from types import SimpleNamespace

import pytest
from bot_console.runtime.rmw.zenoh.remote_publisher import RemotePublisher
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy


class Link:
    """A session and its sender, which record who sends what."""

    never_waits = False

    def __init__(self):
        self.sent = []

    def declare_publisher(self, key, *, reliable, cache, blocking):
        self.waits = blocking
        return SimpleNamespace(put=lambda data, attachment: self.sent.append("publisher"))

    def send(self, publisher, topic, data, attachment):
        self.sent.append("thread")


@pytest.mark.parametrize(
    ("topic", "qos", "who"),
    [
        ("/scan", QoSProfile(depth=10), "publisher"),
        ("/scan", QoSProfile(depth=999), "publisher"),
        ("/scan", QoSProfile(depth=1000), "thread"),
        ("/scan", QoSProfile(depth=0, history=HistoryPolicy.KEEP_ALL), "thread"),
        ("/scan", QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT), "publisher"),
        ("/rosout", QoSProfile(depth=10), "thread"),
    ],
)
def test_publisher_with_a_deep_queue_sends_through_the_sender_thread(topic, qos, who):
    link = Link()
    endpoint = SimpleNamespace(topic=topic, qos=qos, gid=bytes(16))
    remote_publisher = RemotePublisher(link, link, SimpleNamespace(endpoint=endpoint, history=None), "key")
    remote_publisher.append((b"data", 1, 1, 1, None))
    assert link.sent == [who] and link.waits == (who == "thread")
