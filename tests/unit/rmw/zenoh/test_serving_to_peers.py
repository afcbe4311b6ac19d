"""A robot that admits others is visible to nodes of rmw_zenoh with default configuration, which are peers.

The node is a bare Zenoh session with those settings of rmw_zenoh's default configuration that differ from Zenoh's own.
"""

# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false

import json
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
import zenoh
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, node_token
from polling import until
from processes.ports import free_port

TIMEOUT_S, POLL_S = 20.0, 0.02
DOMAIN = 0


@dataclass
class Peer:
    """A node of rmw_zenoh with its default configuration."""

    port: int
    tokens: set[str] = field(default_factory=set)
    heard: list[bytes] = field(default_factory=list)

    def __post_init__(self) -> None:
        settings = {
            "mode": "peer",
            "connect": {"endpoints": [f"tcp/localhost:{self.port}"]},
            "listen": {"endpoints": ["tcp/localhost:0"]},
            "scouting": {
                "multicast": {"enabled": False},
                "gossip": {
                    "enabled": True,
                    "target": {"router": ["router", "peer"], "peer": ["router"]},
                    "autoconnect": {"router": [], "peer": ["router", "peer"]},
                    "autoconnect_strategy": {"peer": {"to_router": "always", "to_peer": "greater-zid"}},
                },
            },
            "timestamping": {"enabled": True},
        }
        self.session = zenoh.open(zenoh.Config.from_json5(json.dumps(settings)))
        token = node_token(DOMAIN, TokenNode(str(self.session.zid()), 0, "", "/", "node"))
        self.token = self.session.liveliness().declare_token(token)
        self.seen = self.session.liveliness().declare_subscriber("@ros2_lv/**", self.see, history=True)
        self.subscriber = self.session.declare_subscriber("topic/**", self.hear)
        self.publisher = self.session.declare_publisher("topic/node")

    def see(self, sample: zenoh.Sample) -> None:
        """Record a token of the graph."""
        self.tokens.add(str(sample.key_expr))

    def hear(self, sample: zenoh.Sample) -> None:
        """Record a message."""
        self.heard.append(sample.payload.to_bytes())

    def sees(self, zid: str) -> bool:
        """Whether a session's node is in its graph."""
        return any(f"/{zid}/" in each for each in self.tokens)


@dataclass
class Robot:
    """A mesh of two processes' sessions, the second of which admits others."""

    port: int
    heard: list[bytes] = field(default_factory=list)
    tokens: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.early = MeshSession(DOMAIN)
        self.serving = MeshSession(DOMAIN, Serving((f"tcp/127.0.0.1:{self.port}",)))
        self.early.declare_subscriber("topic/**", lambda payload, attachment: self.heard.append(payload))
        self.early.watch_tokens("@ros2_lv/**", lambda key, came: came and self.tokens.add(key))
        for each in (self.early, self.serving):
            each.declare_token(node_token(DOMAIN, TokenNode(each.zid, 0, "", "/", "robot")))
        self.early.declare_queryable("service", lambda query: query.answer(b"answer", b""))
        self.publisher = self.early.declare_publisher("topic/robot")


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Robot]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BOT_CONSOLE_SOCKET_DIR", str(tmp_path_factory.mktemp("mesh")))
        made = Robot(free_port())
        yield made
        made.serving.close()
        made.early.close()


@pytest.fixture(scope="module")
def peers(robot: Robot) -> Iterator[list[Peer]]:
    made = [Peer(robot.port), Peer(robot.port)]
    yield made
    for each in made:
        each.session.close()


def test_peer_sees_all_processes_of_the_robot_and_is_seen_by_them(robot: Robot, peers: list[Peer]) -> None:
    until(lambda: all(each.sees(robot.early.zid) and each.sees(robot.serving.zid) for each in peers))
    until(lambda: all(any(f"/{each.session.zid()}/" in key for key in robot.tokens) for each in peers))


def test_messages_between_peer_and_robot_arrive_once(robot: Robot, peers: list[Peer]) -> None:
    one = peers[0]
    until(lambda: b"warm-up" in one.heard, step=lambda: robot.publisher.put(b"warm-up", b""))
    until(lambda: b"warm-up" in robot.heard, step=lambda: one.publisher.put(b"warm-up"))
    for number in range(3):
        robot.publisher.put(b"down %d" % number, b"")
        one.publisher.put(b"up %d" % number)
    until(lambda: b"down 2" in one.heard and b"up 2" in robot.heard)
    assert [each for each in one.heard if each[:4] == b"down"] == [b"down 0", b"down 1", b"down 2"]
    assert [each for each in robot.heard if each[:2] == b"up"] == [b"up 0", b"up 1", b"up 2"]


def test_peer_gets_response_of_a_service(robot: Robot, peers: list[Peer]) -> None:
    def ask() -> None:
        answers.extend(each.ok.payload.to_bytes() for each in peers[0].session.get("service") if each.ok)

    answers: list[bytes] = []
    until(lambda: answers, step=ask)
    assert set(answers) == {b"answer"}


def test_peers_of_the_router_discover_each_other(peers: list[Peer]) -> None:
    one, two = peers
    until(lambda: one.sees(str(two.session.zid())) and two.sees(str(one.session.zid())))
    until(lambda: b"from peer" in two.heard, step=lambda: one.publisher.put(b"from peer"))
