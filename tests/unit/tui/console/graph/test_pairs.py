"""What keeps messages from passing is said with who, why and what to do; what passes is not mentioned."""

from types import SimpleNamespace

import pytest
from bot_console.tui.console.graph.pairs import UnheardPairs, hash_of, unheard
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

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
        (end("/lidar", WEAK), end("/nav"), ("/nav hears nothing of /lidar", "reliab")),
        (end("/map"), end("/a/view", LATCHED), ("/a/view hears nothing of /map", "change the QoS")),
        (end("/lidar"), end("/nav", type_hash=TWO), ("defined otherwise in /lidar than in /nav", "same definition")),
        (end("/lidar"), end("/nav", kind="std_msgs/msg/String"), ("/nav wants std_msgs/msg/String", "rename")),
    ],
)
def test_what_does_not_pass_is_reported(publisher, subscription, parts):
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
def test_what_passes_or_is_a_tools_own_affair_is_not(publisher, subscription):
    assert list(unheard("/scan", [publisher], [subscription])) == []


def test_a_hash_that_is_none_counts_as_unknown():
    assert hash_of(end("/a")) == ONE
    assert hash_of(end("/a", type_hash="INVALID")) == ""
    assert hash_of(SimpleNamespace()) == ""


class FakeNode:
    """Counts the questions."""

    def __init__(self, publishers, subscriptions):
        self.ends = publishers, subscriptions
        self.asked = []

    def get_publishers_info_by_topic(self, topic):
        self.asked.append(topic)
        return self.ends[0]

    def get_subscriptions_info_by_topic(self, topic):
        return self.ends[1]


def test_ends_of_two_types_are_no_two_definitions_of_one():
    node = FakeNode([end("/lidar")], [end("/nav", kind="std_msgs/msg/String", type_hash=TWO)])
    publisher = NodeInfo("/lidar", publishers=(Endpoint("/scan", (SCAN,)),))
    subscription = NodeInfo("/nav", subscriptions=(Endpoint("/scan", ("std_msgs/msg/String",)),))
    assert UnheardPairs(node).follow(GraphInfo(nodes=(publisher, subscription))) == ()


def test_a_topic_is_asked_about_once_and_again_when_its_ends_change():
    node = FakeNode([end("/lidar")], [end("/nav", type_hash=TWO)])
    publishes, listens = Endpoint("/scan", (SCAN,), "best effort"), Endpoint("/scan", (SCAN,), "reliable")
    alone = NodeInfo("/lidar", publishers=(publishes, Endpoint("/odom", ())))
    both = GraphInfo(nodes=(alone, NodeInfo("/nav", subscriptions=(listens,))))
    findings = UnheardPairs(node)
    found = findings.follow(both)
    assert len(found) == 1 and findings.follow(both) is found and node.asked == ["/scan"]
    changed = NodeInfo("/nav", subscriptions=(Endpoint("/scan", (SCAN,), "best effort"),))
    node.ends = [end("/lidar")], [end("/nav")]
    assert findings.follow(GraphInfo(nodes=(alone, changed))) == ()
    assert node.asked == ["/scan", "/scan"]
    assert findings.follow(GraphInfo(nodes=(alone,))) == ()
