"""Messages from other processes: sequence numbers reveal losses, garbage is dropped and reported."""

from types import SimpleNamespace

import pytest
from bot_console.runtime.rmw.endpoints import Endpoint, NodeId, SubscriptionEndpoint, Tap, queue_for, take_queued
from bot_console.runtime.rmw.zenoh.remote_subscription import RemoteSubscription
from bot_console.runtime.rmw.zenoh.wire.attachment import key_hash_of, pack
from rclpy.qos import QoSProfile
from rclpy.serialization import serialize_message
from std_msgs.msg import String

KEY_HASH = key_hash_of("key")
GID = bytes(range(16))
QOS = QoSProfile(depth=10)


@pytest.fixture
def topic():
    return "/t"


@pytest.fixture
def received(topic):
    events = []
    endpoint = Endpoint(NodeId("n", "/"), topic, "std_msgs/msg/String", QOS, bytes(16), String)
    subscription = SubscriptionEndpoint(
        endpoint, False, queue_for(QOS), lambda: None, lambda kind, what: events.append((kind, what))
    )
    return RemoteSubscription(SimpleNamespace(lost=0), subscription, "key", set(), Tap()), subscription.queue, events


def give(remote_subscription, number, stamp=5):
    remote_subscription.on_sample(serialize_message(String(data=str(number))), pack(number, stamp, GID))


def test_gap_in_sequence_numbers_is_an_event(received, notices):
    remote_subscription, queue, events = received
    for number in (7, 8, 11):
        give(remote_subscription, number)
    assert [(take_queued(message).data, stamp, number) for message, stamp, _, number, _ in queue] == [
        ("7", 5, 7),
        ("8", 5, 8),
        ("11", 5, 11),
    ]
    assert events == [("lost", 2)]


@pytest.mark.parametrize(("topic", "lost"), [("/rosout", 2), ("/t", 0)])
def test_dropped_log_lines_are_counted_and_reported_once(received, notices, topic, lost):
    remote_subscription, queue, events = received
    for number in range(1, 13):
        give(remote_subscription, number)
    assert [number for _, _, _, number, _ in queue] == list(range(3, 13))
    assert remote_subscription._session.lost == lost and events == [("lost", 1)] * lost
    reported = "messages of '/rosout' come faster than they are taken; of more than 10 the oldest go"
    assert notices == [reported] * (lost > 0)


@pytest.mark.parametrize("topic", ["/rosout"])
def test_dropped_log_lines_from_history_are_not_reported(received, notices, topic):
    remote_subscription, queue, events = received
    remote_subscription._session.declare_subscriber = lambda *what, **how: None
    remote_subscription.open()
    for number in range(1, 13):
        give(remote_subscription, number)
    assert len(queue) == 10 and events == [] and notices == []
    give(remote_subscription, 13, 2**62)
    assert events == [("lost", 1)]


def test_invalid_message_is_dropped_when_taken(received, notices):
    remote_subscription, queue, _ = received
    remote_subscription.on_sample(b"\0\1\0\0\xff", pack(1, 1, GID))
    assert take_queued(queue.popleft()[0]) is None
    assert "'/t' was dropped" in notices[0]


def test_corrupted_message_is_dropped_reported_and_counted(received, notices):
    remote_subscription, queue, events = received
    give(remote_subscription, 1)
    whole = serialize_message(String(data="forward, slowly"))
    remote_subscription.on_sample(whole[:-8] + b"foreign\0", pack(2, 5, GID, whole, KEY_HASH))
    assert len(queue) == 1
    assert notices == [
        "a message on '/t' was dropped: it is not what was sent here: the link to its sender broke during transmission"
    ]
    remote_subscription.on_sample(whole, pack(3, 5, GID, whole, KEY_HASH))
    assert take_queued(queue[-1][0]).data == "forward, slowly"
    assert events == [("lost", 1)]


@pytest.mark.parametrize(("payload", "attachment"), [(b"", None), (b"", b"x")])
def test_garbage_is_dropped(received, payload, attachment):
    remote_subscription, queue, _ = received
    remote_subscription.on_sample(payload, attachment)
    assert not queue
    give(remote_subscription, 2)
    assert len(queue) == 1
