"""Anomalies of a graph, as text."""

from __future__ import annotations

from bot_console.tui.console.graph.anomalies import findings
from bot_console.tui.console.model import Endpoint, GraphInfo, IncompatiblePair, NodeInfo

SCAN, TWIST = ("sensor_msgs/msg/LaserScan",), ("geometry_msgs/msg/Twist",)
BEST, RELIABLE = "best effort volatile 5", "reliable volatile 10"
OWN = Endpoint("/a/get_parameters", ("rcl_interfaces/srv/GetParameters",))


def message(*nodes: NodeInfo) -> list[str]:
    return [each.text for each in findings(GraphInfo(nodes))]


def test_incompatible_qos_is_reported_with_both_nodes_if_the_middleware_checks_it() -> None:
    nodes = (
        NodeInfo("/lidar", (Endpoint("/scan", SCAN, BEST),)),
        NodeInfo("/nav", (), (Endpoint("/scan", SCAN, RELIABLE),)),
    )
    assert message(*nodes) == []
    pair = IncompatiblePair("/lidar", "/nav", "best effort publisher and reliable subscription")
    (found,) = findings(GraphInfo(nodes, incompatible={"/scan": (pair,)}))
    assert found.fault and found.text == (
        "/scan: nothing arrives from /lidar at /nav: best effort publisher and reliable subscription"
    )


def test_a_topic_without_publisher_is_a_fault_but_one_without_subscription_is_not() -> None:
    listens = NodeInfo("/nav", (), (Endpoint("/goal_pose", TWIST, RELIABLE),))
    assert message(listens) == ["nobody publishes /goal_pose, which /nav listens to"]
    assert message(NodeInfo("/nav", (Endpoint("/plan", TWIST, RELIABLE),))) == []


def test_findings_are_in_the_natural_order_of_their_subjects() -> None:
    listens = [NodeInfo("/nav", (), (Endpoint(f"/robot{number}/goal", TWIST),)) for number in (1, 10, 2)]
    assert [each.partition(",")[0].rpartition(" ")[2] for each in message(*listens)] == [
        "/robot1/goal",
        "/robot2/goal",
        "/robot10/goal",
    ]


def test_two_publishers_are_a_hint_except_on_shared_topics() -> None:
    both = tuple(
        NodeInfo(name, tuple(Endpoint(t, TWIST, RELIABLE) for t in ("/cmd_vel", "/tf"))) for name in ("/a", "/b")
    )
    assert message(*both) == ["two publishers on /cmd_vel: /a, /b"]
    assert not findings(GraphInfo(both))[0].fault


def test_different_types_on_one_topic_are_a_fault() -> None:
    nodes = NodeInfo("/a", (Endpoint("/t", SCAN),)), NodeInfo("/b", (), (Endpoint("/t", TWIST),))
    assert "different types" in message(*nodes)[0] and findings(GraphInfo(nodes))[0].fault


def test_services_and_actions_without_a_server_or_with_two_are_reported() -> None:
    client = NodeInfo("/c", clients=(Endpoint("/reset", ("std_srvs/srv/Trigger",)),))
    server = NodeInfo("/s", services=(Endpoint("/reset", ("std_srvs/srv/Trigger",)),))
    other = NodeInfo("/o", services=server.services)
    assert message(client) == ["nobody serves /reset, which /c asks for"]
    assert message(client, server) == []
    assert message(client, server, other) == ["two servers of /reset: /o, /s"]
    assert message(NodeInfo("/g", action_clients=(Endpoint("/go", ()),))) == ["nobody executes /go, which /g asks for"]


def test_a_node_without_endpoints_is_reported_unless_hidden() -> None:
    assert message(NodeInfo("/a", (Endpoint("/rosout", ()),), services=(OWN,))) == [
        "/a publishes, subscribes to and serves nothing"
    ]
    assert message(NodeInfo("/_tool", (), (Endpoint("/x", TWIST),))) == []


def test_duplicate_node_names_are_a_fault() -> None:
    found = findings(GraphInfo((NodeInfo("/a", copies=2, services=(OWN, Endpoint("/go", ("T",)))),)))
    assert [(each.subject, each.fault) for each in found] == [("/a", True)]
    assert found[0].text.startswith("two nodes are called /a")


def test_topics_published_on_demand_need_no_publisher() -> None:
    topics = ("/initialpose", "/robot1/emergency_stop/arbiter", "/scan")
    base = NodeInfo("/base", (), tuple(Endpoint(each, ("T",)) for each in topics))
    assert message(base) == ["nobody publishes /scan, which /base listens to"]


def test_faults_come_first_and_each_group_is_in_the_order_of_its_subjects() -> None:
    nodes = (
        NodeInfo("/z", (), (Endpoint("/a_topic", TWIST),), clients=(Endpoint("/z_service", ("T",)),)),
        NodeInfo("/y", (), (Endpoint("/b_topic", TWIST),), clients=(Endpoint("/a_service", ("T",)),)),
        NodeInfo("/c_node"),
    )
    found = findings(GraphInfo(nodes, silent=("/y",), debugged=(("/a_node", ""),)))
    assert [(each.subject, each.fault) for each in found] == [
        *((subject, True) for subject in ("/a_service", "/y", "/z_service")),
        *((subject, False) for subject in ("/a_node", "/a_topic", "/b_topic", "/c_node")),
    ]
