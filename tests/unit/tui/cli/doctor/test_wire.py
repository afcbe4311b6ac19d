"""What the doctor reads off the wire: tokens, old attachments, clocks; and captures that can be used as fixtures."""

import itertools
import json
import time

import pytest
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session
from bot_console.runtime.rmw.zenoh.network.router import Router
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of, pack, unpack
from bot_console.runtime.rmw.zenoh.wire.keys import data_key
from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, entity_token, node_token, parse_token
from bot_console.tui.cli.doctor.finding import Level
from bot_console.tui.cli.doctor.wire import to_capture, watch_wire, wire_findings
from processes.ports import free_port

STRING, HASH = "std_msgs/msg/String", "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
OLD = b"\x0fsequence_number" + bytes(40)
LATE_S = 20.0


class Robot:
    """A session that declares a node with one topic, and publishes on it with any attachment."""

    def __init__(self, endpoint: str) -> None:
        self.session = open_network_session(0, ClientConfig((endpoint,)))
        self._node = TokenNode(self.session.zid, 0, "", "/", "robot")
        self.session.declare_token(node_token(0, self._node))

    def topic(self, name: str, number: int):
        token = entity_token(0, self._node, number, "MP", name, STRING, HASH, "::,10:,:,:,,")
        self.session.declare_token(token)
        return token, self.session.declare_publisher(data_key(0, name, STRING, HASH))


@pytest.fixture
def place():
    serving = Serving((f"tcp/127.0.0.1:{free_port()}",))
    router = Router(serving)
    yield serving.endpoints[0]
    router.close()


@pytest.fixture
def robot(place):
    made = Robot(place)
    yield made
    made.session.close()


def observe(place, publishing=lambda: None):
    """What the doctor sees while `publishing` is called repeatedly."""
    import threading

    session, ended = open_network_session(0, ClientConfig((place,))), threading.Event()

    def publish():
        while not ended.wait(0.02):
            publishing()

    thread = threading.Thread(target=publish)
    thread.start()
    try:
        return watch_wire(session, 2.0)
    finally:
        ended.set()
        thread.join()
        session.close()


def levels(wire, about):
    return [(each.level, each.text) for each in wire_findings(wire, 0.0) if each.about == about]


def test_correct_robot_has_no_findings_and_its_capture_matches_byte_by_byte(place, robot):
    token, publisher = robot.topic("/words", 1)
    attachment = pack(7, time.time_ns(), gid_of(token))
    wire = observe(place, lambda: publisher.put(b"\x00\x01\x00\x00", pack(7, time.time_ns(), gid_of(token))))
    assert {each.level for each in wire_findings(wire, 0.0)} == {Level.OK}
    read = json.loads(json.dumps(to_capture(wire, ["a test"])))
    assert [parse_token(each).kind for each in read["tokens"]] == ["MP", "NN"] or len(read["tokens"]) == 2
    (sample, *_) = read["samples"]
    number, _, gid = unpack(bytes.fromhex(sample["attachment"]))
    assert (number, gid, sample["topic"], len(attachment)) == (7, gid_of(token), "/words", 33)


def test_attachment_of_an_old_release_is_recognised(place, robot):
    _, publisher = robot.topic("/words", 1)
    wire = observe(place, lambda: publisher.put(b"\x00\x01\x00\x00", OLD))
    ((level, text),) = levels(wire, "messages")
    assert level is Level.FAIL and "/words" in text and "too old (before Jazzy 0.2.4" in text


def test_wrong_clock_is_reported_with_its_sign(place, robot):
    token, publisher = robot.topic("/words", 1)

    def late():
        publisher.put(b"\x00\x01\x00\x00", pack(1, time.time_ns() - round(LATE_S * 1e9), gid_of(token)))

    ((level, text),) = levels(observe(place, late), "clock")
    assert level is Level.WARN and "20.0 s behind this one" in text


def test_invalid_tokens_are_counted_and_shown(place, robot):
    robot.session.declare_token("@ros2_lv/0/zid/1/2/XX/%/%/robot")
    found = levels(observe(place), "graph")
    assert any(level is Level.WARN and text.startswith("1 tokens do not follow the format") for level, text in found)


def test_tokens_that_arrive_while_listening_count(place, robot):
    calls = itertools.count()

    def come():
        if next(calls) == 50:
            robot.session.declare_token(node_token(0, TokenNode(robot.session.zid, 1, "", "/", "late")))

    wire = observe(place, come)
    assert sorted(each.node.name for each in wire.parsed()[0]) == ["late", "robot"]


def test_empty_domain_says_what_to_check(place):
    ((level, text),) = levels(observe(place), "graph")
    assert level is Level.WARN and "no node is visible" in text


def test_nodes_in_another_domain_are_reported_with_the_domain_to_start_in(place, robot):
    for number, found in ((0, ""), (5, "no node in domain 5: set ROS_DOMAIN_ID=0; nodes are in 0")):
        session = open_network_session(number, ClientConfig((place,)))
        session.declare_token(node_token(5, TokenNode(session.zid, 0, "", "/", "_console")))
        wire = watch_wire(session, 0.0)
        session.close()
        level = Level.WARN if found else Level.OK
        assert levels(wire, "graph") == [(level, found or "1 node, 0 endpoints")]
