"""QoS of the `ros2 topic` verbs: what they offer and request, and their messages if the two ends are incompatible."""

from __future__ import annotations

import re

import pytest

OFFERS = """
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
node = Node('offers')
best = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
least = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
publishers = [node.create_publisher(String, 'mixed', each) for each in (best, least)]
node.create_timer(0.1, lambda: [each.publish(String(data='x')) for each in publishers])
"""
FALLBACK = "Some, but not all, publishers are offering {0}. Falling back to {1} as it will connect to all publishers\n"
FALLBACKS = (
    FALLBACK.format("QoSReliabilityPolicy.RELIABLE", "QoSReliabilityPolicy.BEST_EFFORT"),
    FALLBACK.format("QoSDurabilityPolicy.TRANSIENT_LOCAL", "QoSDurabilityPolicy.VOLATILE"),
)


@pytest.mark.parametrize("words", [(), ("--qos-profile", "default")])
def test_echo_reports_qos_fallbacks(ros, words: tuple[str, ...]) -> None:
    ros.node(OFFERS)
    assert ros.ask("topic", "echo", "/mixed", "--once", *words).stdout == "".join(FALLBACKS) + "data: x\n---\n"


@pytest.mark.parametrize("words", [("--qos-depth", "3"), ("--qos-history", "keep_all")])
def test_echo_keeps_the_preset_beside_an_option(ros, words: tuple[str, ...]) -> None:
    ros.node(OFFERS)
    echo = ros.ask("topic", "echo", "/mixed", "--once", "--qos-profile", "default", *words)
    assert echo.stdout == "data: x\n---\n"
    assert "offering incompatible QoS" in echo.stderr, "one of the two is best effort, and the preset is reliable"


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        (("--qos-liveliness-lease-duration-seconds", "2.5"), "  Liveliness lease duration: 2500000000 nanoseconds\n"),
        (("--qos-liveliness", "manual_by_topic"), "  Liveliness: MANUAL_BY_TOPIC\n"),
        (("--qos-depth", "0"), "  History (Depth): KEEP_LAST (10)\n"),
        (("--qos-depth", "7"), "  History (Depth): KEEP_LAST (7)\n"),
    ],
)
def test_pub_offers_the_selected_qos(ros, words: tuple[str, ...], shown: str) -> None:
    ros.ros2("topic", "pub", "/t", "std_msgs/msg/Empty", *words)
    ros.run(0.2)
    assert shown in ros.ask("topic", "info", "-v", "/t").stdout


def test_pub_reports_an_incompatible_subscription(ros) -> None:
    pub = ros.ros2("topic", "pub", "/t", "std_msgs/msg/Empty", "--qos-reliability", "best_effort")
    ros.node("from std_msgs.msg import Empty\nnode = Node('s')\nnode.create_subscription(Empty, 't', print, 1)")
    ros.run(1.0)
    assert "New subscription discovered on topic '/t', requesting incompatible QoS." in pub.stderr


SIMULATION = """
from rosgraph_msgs.msg import Clock
from builtin_interfaces.msg import Time
from std_msgs.msg import Int8
node = Node('simulation')
clock = node.create_publisher(Clock, 'clock', 10)
numbers = node.create_publisher(Int8, 'numbers', 10)
ticks = iter(range(1, 100000))
def tick():
    count = next(ticks)
    clock.publish(Clock(clock=Time(sec=count // 2, nanosec=count % 2 * 500000000)))
    numbers.publish(Int8())
node.create_timer(0.25, tick)
"""


def test_pub_uses_simulation_time(ros) -> None:
    """The simulation runs twice as fast: at 1 message per second, 5 messages take 2 s."""
    ros.node(SIMULATION)
    published = ros.ask(
        "topic", "pub", "-s", "-t", "5", "-w", "0", "/p", "geometry_msgs/msg/PointStamped", "header: auto"
    )
    assert published.stdout.count("publishing #") == 5
    assert ros.clock.steady_ns() == pytest.approx(2.2e9, abs=0.4e9)
    seconds = [int(each) for each in re.findall(r"\bsec=(\d+)", published.stdout)]
    assert max(seconds) < 10, "stamps are of the simulation"


def test_bw_uses_simulation_time(ros) -> None:
    ros.node(SIMULATION)
    reported = ros.ask("topic", "bw", "-s", "/numbers", stop_after=4.0).stdout.splitlines()
    assert reported[-2].startswith(("11 B/s", "12 B/s", "13 B/s")), "5 B four times a second, in twice the time"


@pytest.mark.parametrize("text", ["0", "-1"])
def test_time_limit_must_be_positive(ros, text: str) -> None:
    refused = ros.ask("topic", "echo", "/t", "--timeout", text)
    assert (refused.exit, refused.stderr.splitlines()[-1]) == (
        2,
        "ros2 topic echo: error: argument --timeout: Value must be positive",
    )


def test_echo_reports_lost_messages(ros, monkeypatch: pytest.MonkeyPatch) -> None:
    """Within one process no message is lost: the test reports a loss to the subscription, as over a network."""
    from rclpy.event_handler import QoSMessageLostInfo, SubscriptionEventCallbacks

    whole = SubscriptionEventCallbacks.__init__

    def lose(self: object, **callbacks: object) -> None:
        whole(self, **callbacks)  # type: ignore[arg-type]
        report = callbacks.get("message_lost")
        if callable(report):
            report(QoSMessageLostInfo(total_count=3, total_count_change=2))

    ros.node(OFFERS)
    monkeypatch.setattr(SubscriptionEventCallbacks, "__init__", lose)
    words = ("topic", "echo", "/mixed", "--once", "--qos-reliability", "best_effort")
    reported = "A message was lost!!!\n\ttotal count change:2\n\ttotal count: 3---\n"
    assert ros.ask(*words).stdout == f"{reported}data: x\n---\n"
    assert ros.ask(*words, "--no-lost-messages").stdout == "data: x\n---\n"
