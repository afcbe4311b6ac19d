"""Reports of endpoints whose messages do not pass name the nodes, the reason and a remedy; others are not listed."""

from types import SimpleNamespace

import pytest
from bot_console.tui.console.graph.pairs import RMW_ZENOH, UnheardPairs, hash_of, unheard
from bot_console.tui.console.model import Endpoint, GraphInfo, IncompatiblePair, NodeInfo
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

RELIABLE = QoSProfile(depth=10)
WEAK = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SCAN = "sensor_msgs/msg/LaserScan"
ONE, TWO = "RIHS01_" + "1" * 64, "RIHS01_" + "2" * 64


def end(node, qos=RELIABLE, kind=SCAN, type_hash=ONE):
    namespace, _, name = node.rpartition("/")
    return SimpleNamespace(
        node_name=name, node_namespace=namespace or "/", topic_type=kind, topic_type_hash=type_hash, qos_profile=qos
    )


@pytest.mark.parametrize(
    ("publisher", "subscription", "parts"),
    [
        (end("/lidar", WEAK), end("/nav"), ("/nav receives nothing from /lidar", "reliab")),
        (end("/map"), end("/a/view", LATCHED), ("/a/view receives nothing from /map", "change the QoS")),
        (end("/lidar"), end("/nav", type_hash=TWO), ("in /lidar differs from that in /nav", "same definition")),
        (end("/lidar"), end("/nav", kind="std_msgs/msg/String"), ("/nav expects std_msgs/msg/String", "rename")),
    ],
)
def test_incompatible_endpoints_are_reported_with_reason_and_remedy(publisher, subscription, parts):
    (text,) = unheard("/scan", [publisher], [subscription])
    assert text.startswith("/scan: ")
    assert all(part in text for part in parts), text


@pytest.mark.parametrize(
    ("publisher", "subscription"),
    [
        (end("/lidar"), end("/nav", WEAK)),
        (end("/lidar", LATCHED), end("/nav")),
        (end("/lidar", type_hash=None), end("/nav")),
        (end("/lidar", type_hash="RIHS01_" + "0" * 64), end("/nav")),
        (end("/lidar", WEAK), end("/_bot_console")),
    ],
)
def test_compatible_endpoints_and_tools_are_not_reported(publisher, subscription):
    assert list(unheard("/scan", [publisher], [subscription])) == []


def test_an_empty_type_hash_counts_as_unknown():
    assert hash_of(end("/a")) == ONE
    assert hash_of(end("/a", type_hash="INVALID")) == ""
    assert hash_of(SimpleNamespace()) == ""


class FakeNode:
    """Counts the queries."""

    def __init__(self, publishers, subscriptions):
        self.ends = publishers, subscriptions
        self.asked = []

    def get_publishers_info_by_topic(self, topic):
        self.asked.append(topic)
        return self.ends[0]

    def get_subscriptions_info_by_topic(self, topic):
        return self.ends[1]


def test_endpoints_of_different_types_are_not_reported_as_different_definitions():
    node = FakeNode([end("/lidar")], [end("/nav", kind="std_msgs/msg/String", type_hash=TWO)])
    publisher = NodeInfo("/lidar", publishers=(Endpoint("/scan", (SCAN,)),))
    subscription = NodeInfo("/nav", subscriptions=(Endpoint("/scan", ("std_msgs/msg/String",)),))
    pairs = UnheardPairs(node)
    pairs.follow(GraphInfo(nodes=(publisher, subscription)))
    assert pairs.found == ()


def test_a_topic_is_queried_once_and_again_when_its_endpoints_change():
    node = FakeNode([end("/lidar")], [end("/nav", type_hash=TWO)])
    publishes, listens = Endpoint("/scan", (SCAN,), "best effort"), Endpoint("/scan", (SCAN,), "reliable")
    alone = NodeInfo("/lidar", publishers=(publishes, Endpoint("/odom", ())))
    both = GraphInfo(nodes=(alone, NodeInfo("/nav", subscriptions=(listens,))))
    findings = UnheardPairs(node)
    findings.follow(both)
    found = findings.found
    findings.follow(both)
    assert len(found) == 1 and findings.found is found and node.asked == ["/scan"]
    changed = NodeInfo("/nav", subscriptions=(Endpoint("/scan", (SCAN,), "best effort"),))
    node.ends = [end("/lidar")], [end("/nav")]
    findings.follow(GraphInfo(nodes=(alone, changed)))
    assert findings.found == () and node.asked == ["/scan", "/scan"]
    findings.follow(GraphInfo(nodes=(alone,)))
    assert findings.found == ()


DEADLINE = QoSProfile(depth=10, deadline=Duration(seconds=1))
AUTOMATIC = QoSProfile(depth=10, liveliness=LivelinessPolicy.AUTOMATIC)
MANUAL = QoSProfile(depth=10, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC)
INCOMPATIBLE = [
    (WEAK, RELIABLE, "best effort publisher and reliable subscription"),
    (RELIABLE, LATCHED, "volatile publisher and transient local subscription"),
    (RELIABLE, DEADLINE, "subscription has a deadline, but publisher does not"),
    (AUTOMATIC, MANUAL, "publisher's liveliness is automatic and subscription's is manual by topic"),
]


def graph_of_one_topic(offered, requested):
    """A graph with one publisher and two subscriptions, and the pairs found in it."""
    subscriptions = [end("/nav", requested), end("/log", WEAK), end("/_tool", requested)]
    scan = (Endpoint("/scan", (SCAN,)),)
    nodes = NodeInfo("/lidar", scan), *(NodeInfo(name, (), scan) for name in ("/nav", "/log", "/_tool"))
    pairs = UnheardPairs(FakeNode([end("/lidar", offered)], subscriptions))
    pairs.follow(GraphInfo(nodes=nodes))
    return pairs


@pytest.mark.parametrize(("offered", "requested", "reason"), INCOMPATIBLE)
def test_graph_and_doctor_give_the_reason_of_the_middleware_for_each_policy(offered, requested, reason):
    pairs = graph_of_one_topic(offered, requested)
    assert pairs.incompatible == {"/scan": (IncompatiblePair("/lidar", "/nav", reason),)}
    (text,) = unheard("/scan", [end("/lidar", offered)], [end("/nav", requested)])
    assert reason in text
    before = pairs.incompatible
    pairs.follow(GraphInfo(nodes=tuple(pairs._nodes.values())))
    assert pairs.incompatible is before
    pairs.follow(GraphInfo())
    assert pairs.incompatible == {}


@pytest.mark.parametrize(("offered", "requested", "reason"), INCOMPATIBLE)
def test_no_qos_is_incompatible_over_rmw_zenoh(monkeypatch, offered, requested, reason):
    monkeypatch.setattr("bot_console.tui.console.graph.pairs.get_rmw_implementation_identifier", lambda: RMW_ZENOH)
    assert graph_of_one_topic(offered, requested).incompatible == {}
    assert list(unheard("/scan", [end("/lidar", offered)], [end("/nav", requested)])) == []
