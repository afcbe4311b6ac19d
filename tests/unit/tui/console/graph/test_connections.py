"""The graph as lines of text."""

from __future__ import annotations

from bot_console.tui.cli.verbs.graph import lines_of
from bot_console.tui.console.model import Endpoint, GraphInfo, IncompatiblePair, NodeInfo

TRIGGER = ("std_srvs/srv/Trigger",)


def endpoints(*names: str, qos: str = "") -> tuple[Endpoint, ...]:
    return tuple(Endpoint(name, ("a/msg/B",), qos) for name in names)


INFO = GraphInfo(
    (
        NodeInfo("/lidar", endpoints("/scan", "/rosout", qos="best effort volatile 5")),
        NodeInfo(
            "/nav",
            endpoints("/cmd_vel"),
            endpoints("/scan", qos="reliable volatile 5"),
            (Endpoint("/nav/get", TRIGGER),),
        ),
        NodeInfo("/base", (), endpoints("/cmd_vel", "/goal"), (Endpoint("/reset", TRIGGER),)),
        NodeInfo("/person", clients=(Endpoint("/reset", TRIGGER),), action_clients=endpoints("/drive")),
        NodeInfo("/idle"),
        NodeInfo("/_hidden", endpoints("/cmd_vel")),
    ),
    silent=("/base",),
    incompatible={"/scan": (IncompatiblePair("/lidar", "/nav", "best effort publisher and reliable subscription"),)},
)


def test_each_connection_is_one_line() -> None:
    assert list(lines_of(INFO, ("/rosout",))) == [
        "/cmd_vel  /nav → /base (no answer)",
        "/goal  (none) → /base (no answer)",
        "/scan  /lidar → ✗/nav",
        "service /reset  /person → /base (no answer)",
        "action /drive  /person → (none)",
        "/idle  without topics, services and actions",
    ]


def test_names_can_be_left_out() -> None:
    lines = list(lines_of(INFO, ("/rosout", "/base", "/g*")))
    assert lines[0] == "/cmd_vel  /nav → (none)" and not any("/goal" in each for each in lines)
