"""Everything sent to other processes carries a seal, by which a receiver recognises cut and misdirected messages."""

import itertools
import os
import threading

import pytest
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.wire.attachment import key_hash_of, pack, unpack
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError, data_key
from bot_console.runtime.rosidl import type_hash
from geometry_msgs.msg import Twist, Vector3
from helpers.processes.two_processes import DOMAIN, two_processes
from rclpy.qos import HistoryPolicy, QoSProfile
from rclpy.serialization import serialize_message
from std_msgs.msg import String
from std_srvs.srv import Trigger

TIMEOUT_S = 240.0
GID = bytes(range(16))
EVERYTHING = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=0)
PULL = data_key(DOMAIN, "/pull", "std_srvs/srv/Trigger", type_hash.text(Trigger))


@pytest.fixture(scope="module")
def here(tmp_path_factory):
    with two_processes(tmp_path_factory.mktemp("mesh") / "s") as (system, _):
        system.folder = os.environ["BOT_CONSOLE_SOCKET_DIR"]
        yield system


@pytest.fixture
def stranger(here, monkeypatch):
    """A session of the same domain without a node."""
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", here.folder)
    session = open_session(DOMAIN)
    here.until(lambda: len(session.linked()) == 2)
    yield session
    session.close()


def is_sealed(key, payload, attachment):
    unpack(attachment, payload, key_hash_of(key))
    changed = payload[:-1] + bytes([payload[-1] ^ 1])
    for other in ((changed, key_hash_of(key)), (payload, key_hash_of(f"{key}2"))):
        try:
            unpack(attachment, *other)
        except FormatError:
            continue
        return False
    return True


@pytest.mark.parametrize("profile", [QoSProfile(depth=10), EVERYTHING], ids=["depth", "all"])
def test_messages_are_sealed(here, stranger, profile):
    heard = []
    key = data_key(DOMAIN, "/say", "std_msgs/msg/String", type_hash.text(String))
    stranger.declare_subscriber(key, lambda *sample: heard.append(sample))
    publisher = here.node.create_publisher(String, "/say", profile)
    here.until(lambda: publisher.get_subscription_count() == 1)

    def message():
        publisher.publish(String(data="sealed"))
        return heard

    here.until(message)
    here.node.destroy_publisher(publisher)
    assert all(is_sealed(key, *sample) for sample in heard)


def test_requests_and_responses_are_sealed(here, stranger):
    asked, replies, done = [], [], threading.Event()

    def take(query):
        asked.append((query.payload, query.attachment))
        query.drop()

    client = here.node.create_client(Trigger, "/pull")
    here.until(client.service_is_ready)
    stranger.declare_queryable(PULL, take)

    def was_asked():
        here.result(client.call_async(Trigger.Request()))
        return asked

    here.until(was_asked)
    payload = serialize_message(Trigger.Request())
    querier = stranger.declare_querier(PULL, TIMEOUT_S)
    querier.get(payload, pack(1, 5, GID), lambda *reply: replies.append(reply), done.set)
    assert done.wait(TIMEOUT_S)
    assert len(replies) == 1 and all(is_sealed(PULL, *each) for each in (*asked, *replies))


def test_a_truncated_command_is_ignored_and_one_without_seal_is_accepted(here, stranger):
    heard = []
    here.node.create_subscription(Twist, "/cmd_vel", lambda command: heard.append(command.linear.x), 10)
    key = data_key(DOMAIN, "/cmd_vel", "geometry_msgs/msg/Twist", type_hash.text(Twist))
    publisher = stranger.declare_publisher(key, blocking=True)
    slow, fast = (serialize_message(Twist(linear=Vector3(x=speed))) for speed in (0.1, 9.0))

    def came():
        publisher.put(fast, pack(1, 5, GID, slow, key_hash_of(key)))
        publisher.put(slow, pack(2, 5, GID))
        return heard

    here.until(came)
    assert set(heard) == {0.1}


def test_a_request_that_arrives_at_another_service_is_not_served(here, stranger):
    served = []

    def serve(request, response):
        served.append(request)
        return response

    here.node.create_service(Trigger, "/halt", serve)
    halt = data_key(DOMAIN, "/halt", "std_srvs/srv/Trigger", type_hash.text(Trigger))
    querier = stranger.declare_querier(halt, TIMEOUT_S)
    payload, numbers = serialize_message(Trigger.Request()), itertools.count(1)

    def ask(intended_key):
        replies, done = [], threading.Event()
        attachment = pack(next(numbers), 5, GID, payload, key_hash_of(intended_key))
        querier.get(payload, attachment, lambda *reply: replies.append(reply), done.set)
        here.until(done.is_set)
        return replies

    here.until(lambda: ask(halt))
    before = len(served)
    assert not ask(PULL) and len(served) == before > 0
