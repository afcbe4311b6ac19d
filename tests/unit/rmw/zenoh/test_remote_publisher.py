"""Whether a publisher sends itself, or lets the thread do so that drops nothing: what its QoS says of its queue."""

from types import SimpleNamespace

import pytest
from bot_console.runtime.rmw.zenoh.remote_publisher import RemotePublisher
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy


class Link:
    """A session and its sender, which note who sends what."""

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
def test_what_keeps_much_is_sent_by_the_thread_that_drops_nothing(topic, qos, who):
    link = Link()
    endpoint = SimpleNamespace(topic=topic, qos=qos, gid=bytes(16))
    remote_publisher = RemotePublisher(link, link, SimpleNamespace(endpoint=endpoint, history=None), "key")
    remote_publisher.append((b"data", 1, 1, None))
    assert link.sent == [who] and link.waits == (who == "thread")
