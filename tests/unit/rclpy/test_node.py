"""Nodes: names, graph queries, destruction, attributes."""

from __future__ import annotations

import gc
from typing import Any

import pytest
from rclpy._rclpy_pybind11 import NodeNameNonExistentError, RCLError, RCLInvalidROSArgsError, UnknownROSArgsError
from rclpy.duration import Duration
from rclpy.exceptions import (
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidServiceNameException,
    InvalidTopicNameException,
)
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, ReliabilityPolicy, qos_profile_sensor_data
from rclpy.topic_endpoint_info import TopicEndpointTypeEnum
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger


@pytest.mark.parametrize(
    ("options", "names"),
    [
        ({}, ("n", "/", "/n", "n")),
        ({"namespace": ""}, ("n", "/", "/n", "n")),
        ({"namespace": "/"}, ("n", "/", "/n", "n")),
        ({"namespace": "ns"}, ("n", "/ns", "/ns/n", "ns.n")),
        ({"namespace": "/a/b"}, ("n", "/a/b", "/a/b/n", "a.b.n")),
        ({"cli_args": ["--ros-args", "-r", "__node:=m", "-r", "__ns:=/x"]}, ("m", "/x", "/x/m", "x.m")),
    ],
)
def test_node_has_its_names(ros: Any, options: dict[str, Any], names: tuple[str, ...]) -> None:
    node = ros.node(**options)
    found = (node.get_name(), node.get_namespace(), node.get_fully_qualified_name(), node.get_logger().name)
    assert found == names


@pytest.mark.parametrize(
    ("name", "namespace", "kind", "text"),
    [
        ("my-node", "", InvalidNodeNameException, "Invalid node name: node name must not contain characters other "
         "than alphanumerics or '_':\n  'my-node'\n     ^"),
        ("", "", InvalidNodeNameException, "Invalid node name: node name must not be empty:\n  ''\n   ^"),
        ("n", "/a/", InvalidNamespaceException, "Invalid namespace: namespace must not end with a '/', unless only "
         "a '/':\n  '/a/'\n     ^"),
        ("n", "a b", InvalidNamespaceException, "Invalid namespace: namespace must not contain characters other "
         "than alphanumerics, '_', or '/':\n  '/a b'\n     ^"),
    ],
)  # fmt: skip
def test_invalid_names_are_rejected(ros: Any, name: str, namespace: str, kind: type[Exception], text: str) -> None:
    with pytest.raises(kind) as caught:
        ros.node(name, namespace=namespace)
    assert str(caught.value) == text


@pytest.mark.parametrize(
    ("rule", "text"),
    [
        (
            "__ns:=/a/",
            "error creating node: invalid node namespace: node name must not start with a number",
        ),
        (
            "__node:=" + "a" * 256,
            "error creating node: invalid node name: node name length should not exceed '255'",
        ),
    ],
)
def test_invalid_remapped_names_are_rejected(ros: Any, rule: str, text: str) -> None:
    ros.init("-r", rule)
    with pytest.raises(RCLError) as caught:
        ros.node()
    assert str(caught.value) == text


@pytest.mark.parametrize(
    ("words", "kind", "text"),
    [
        (["--ros-args", "--foo"], UnknownROSArgsError, "['--foo']"),
        (["--ros-args", "-r"], RCLInvalidROSArgsError, "Failed to parse ROS arguments: "
         "Couldn't parse trailing -r flag. No remap rule found."),
    ],
)  # fmt: skip
def test_invalid_cli_args_are_rejected(ros: Any, words: list[str], kind: type[Exception], text: str) -> None:
    with pytest.raises(kind) as caught:
        ros.node(cli_args=words)
    assert str(caught.value) == text


@pytest.mark.parametrize(("use_global", "topic"), [(True, "/local"), (False, "/local")])
def test_nodes_own_rules_take_precedence(ros: Any, use_global: bool, topic: str) -> None:
    ros.init("-r", "a:=global", "-r", "b:=everywhere")
    node = ros.node(cli_args=["--ros-args", "-r", "a:=local"], use_global_arguments=use_global)
    assert node.resolve_topic_name("a") == topic
    assert node.resolve_topic_name("b") == ("/everywhere" if use_global else "/b")
    assert node.resolve_service_name("a", only_expand=True) == "/a"


@pytest.mark.parametrize(
    ("name", "resolved", "counted", "made"),
    [
        ("a b", RCLError, ValueError, InvalidTopicNameException),
        ("{x}", RCLError, ValueError, ValueError),
        ("a//b", RCLError, InvalidTopicNameException, InvalidTopicNameException),
    ],
)
def test_invalid_topic_names_are_rejected(ros: Any, name: str, resolved: Any, counted: Any, made: Any) -> None:
    node = ros.node()
    with pytest.raises(resolved, match=r"^failed to resolve name: (?!topic name '.*' is invalid)"):
        node.resolve_topic_name(name)
    for count in (node.count_publishers, node.count_subscribers, node.get_publishers_info_by_topic):
        with pytest.raises(counted):
            count(name)
    with pytest.raises(made):
        node.create_publisher(Int32, name, 1)
    with pytest.raises(InvalidServiceNameException if made is InvalidTopicNameException else made):
        node.create_client(Trigger, name)


@pytest.fixture
def system(ros: Any) -> Any:
    """An observer of a small graph."""
    talker, listener = ros.node("talker"), ros.node("listener", namespace="/ns")
    talker.create_publisher(String, "chatter", qos_profile_sensor_data)
    talker.create_client(Trigger, "/ns/do")
    listener.create_subscription(String, "/chatter", print, 10)
    listener.create_service(Trigger, "do", lambda request, response: response)
    return ros.node("observer")


def test_nodes_of_the_graph_are_listed(system: Any) -> None:
    assert system.get_node_names() == ["talker", "listener", "observer"]
    assert system.get_fully_qualified_node_names() == ["/talker", "/ns/listener", "/observer"]
    assert system.get_node_names_and_namespaces() == [("talker", "/"), ("listener", "/ns"), ("observer", "/")]
    assert ("listener", "/ns", "/") in system.get_node_names_and_namespaces_with_enclaves()


def test_topics_and_services_of_the_graph_are_listed(system: Any) -> None:
    assert ("/chatter", ["std_msgs/msg/String"]) in system.get_topic_names_and_types()
    assert ("/ns/do", ["std_srvs/srv/Trigger"]) in system.get_service_names_and_types()
    assert (system.count_publishers("chatter"), system.count_subscribers("/chatter")) == (1, 1)
    assert (system.count_services("/ns/do"), system.count_clients("/ns/do")) == (1, 1)


def test_endpoints_of_a_node_are_listed(system: Any) -> None:
    node = system
    assert ("/chatter", ["std_msgs/msg/String"]) in node.get_publisher_names_and_types_by_node("talker", "/")
    assert node.get_subscriber_names_and_types_by_node("talker", "/") == []
    assert node.get_subscriber_names_and_types_by_node("listener", "/ns") == [("/chatter", ["std_msgs/msg/String"])]
    assert node.get_client_names_and_types_by_node("talker", "") == [("/ns/do", ["std_srvs/srv/Trigger"])]
    assert ("/ns/do", ["std_srvs/srv/Trigger"]) in node.get_service_names_and_types_by_node("listener", "/ns")


@pytest.mark.parametrize("what", ["publisher", "subscriber", "service", "client"])
def test_endpoints_of_an_unknown_node_raise_an_error(system: Any, what: str) -> None:
    ask = getattr(system, f"get_{what}_names_and_types_by_node")
    with pytest.raises(NodeNameNonExistentError, match=f"^cannot get {what} names and types for nonexistent node"):
        ask("nobody", "/")
    with pytest.raises(RCLError, match="node name must not be empty, result: 1"):
        ask("", "/")


def test_endpoint_info_has_the_effective_qos(system: Any) -> None:
    (info,) = system.get_publishers_info_by_topic("chatter")
    assert (info.node_name, info.node_namespace, info.topic_type) == ("talker", "/", "std_msgs/msg/String")
    assert (info.endpoint_type, len(info.endpoint_gid)) == (TopicEndpointTypeEnum.PUBLISHER, 16)
    qos = info.qos_profile
    assert (qos.reliability, qos.durability) == (ReliabilityPolicy.BEST_EFFORT, DurabilityPolicy.VOLATILE)
    assert (qos.liveliness, str(qos.deadline), str(qos.lifespan)) == (
        LivelinessPolicy.AUTOMATIC,
        "Infinite",
        "Infinite",
    )
    (info,) = system.get_subscriptions_info_by_topic("/chatter")
    assert info.qos_profile.reliability is ReliabilityPolicy.RELIABLE
    assert system.get_publishers_info_by_topic("/nothing") == []


def test_counts_ignore_remapping_and_infos_apply_it(ros: Any) -> None:
    ros.init("-r", "a:=b")
    node = ros.node()
    node.create_publisher(String, "a", 1)
    assert (node.count_publishers("a"), node.count_publishers("b")) == (0, 1)
    assert len(node.get_publishers_info_by_topic("a")) == 1


def test_destroyed_node_leaves_the_graph(ros: Any) -> None:
    node, observer = ros.node("gone"), ros.node("observer")
    node.create_publisher(String, "t", 1)
    node.destroy_node()
    assert observer.get_node_names() == ["observer"]
    assert observer.count_publishers("t") == 0
    services = [name for name, _ in observer.get_service_names_and_types() if name.startswith("/gone/")]
    assert services == ["/gone/get_type_description"], "upstream keeps this one while the object lives"
    ros._executor.remove_node(node)
    del node
    gc.collect()
    services = [name for name, _ in observer.get_service_names_and_types() if name.startswith("/gone/")]
    assert services == []


def test_entities_left_by_a_destroyed_node_leave_with_the_context(ros: Any) -> None:
    from rclpy.context import Context

    observer, context = ros.node("observer"), Context()
    context.init([], domain_id=ros.domain)
    node = Node("gone", context=context)
    node.destroy_node()
    context.shutdown()
    assert [name for name, _ in observer.get_service_names_and_types() if name.startswith("/gone/")] == []


def test_duplicate_node_names_are_allowed_with_a_warning(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    ros.node("twin")
    twin = ros.node("twin")
    assert twin.get_node_names() == ["twin", "twin"]
    assert "Publisher already registered for node name: 'twin'." in capfd.readouterr().err


def test_domains_are_separate(ros: Any) -> None:
    from rclpy.context import Context

    node, context = ros.node(), Context()
    context.init([], domain_id=ros.domain + 100_000)
    with Node("far", context=context):
        assert node.get_node_names() == ["n"]
    context.shutdown()


def test_rosout_can_be_disabled(ros: Any) -> None:
    node = ros.node(enable_rosout=False)
    assert [publisher.topic_name for publisher in node.publishers] == ["/parameter_events"]
    assert node.count_publishers("/rosout") == 0


def test_wait_for_node_waits_until_its_timeout(stepped_ros: Any) -> None:
    import threading

    node = stepped_ros.node("early")
    assert node.wait_for_node("/early", 1.0)
    assert not node.wait_for_node("/late", 1.0)
    threading.Timer(0.5, lambda: stepped_ros.node("late")).start()
    assert node.wait_for_node("/late", 5.0)


def test_subclass_without_super_init_gets_a_clear_error(ros: Any) -> None:
    class Forgetful(Node):
        def __init__(self) -> None:
            self.create_timer(1.0, print)

    with pytest.raises(AttributeError):
        Forgetful()


def test_service_with_clients_only_is_listed(ros: Any) -> None:
    node = ros.node()
    node.create_client(Trigger, "/asked")
    assert ("/asked", ["std_srvs/srv/Trigger"]) in node.get_service_names_and_types()


def test_wait_for_node_accepts_name_without_slash(ros: Any) -> None:
    assert ros.node("a").wait_for_node("a", 0.0)
    assert not ros.node("b").wait_for_node("c", 0.0)


@pytest.mark.parametrize("name", ["create_publisher", "declare_parameter", "count_publishers"])
def test_missing_argument_error_names_the_node_method(ros: Any, name: str) -> None:
    with pytest.raises(TypeError, match=rf"^Node\.{name}\(\) missing "):
        getattr(ros.node(), name)()


def test_graph_queries_raise_after_shutdown(ros: Any) -> None:
    node = ros.node()
    ros.context.shutdown()
    with pytest.raises(RCLError, match="failed to get topic names and types: rcl node's context is invalid"):
        node.get_topic_names_and_types()
    with pytest.raises(RCLError, match="failed to get service names and types: rcl node's context is invalid"):
        node.get_service_names_and_types()


def test_tilde_without_slash_is_rejected(ros: Any) -> None:
    node = ros.node()
    with pytest.raises(InvalidTopicNameException, match="a tilde '~' that is not followed by a forward slash"):
        node.create_publisher(String, "~foo", 1)
    assert node.create_publisher(String, "~/foo", 1).topic_name == "/n/foo"


def test_dds_names_of_topics_and_services_can_be_queried(ros: Any) -> None:
    node = ros.node("n", namespace="/ns", start_parameter_services=False, enable_rosout=False)
    node.create_publisher(String, "said", 1)
    node.create_subscription(Int32, "heard", lambda message: None, 1)
    node.create_client(Trigger, "asked")
    node.create_service(Trigger, "offered", lambda request, response: response)
    request, response = (f"std_srvs::srv::dds_::Trigger_{each}_" for each in ("Request", "Response"))
    output = ("rt/ns/said", ["std_msgs::msg::dds_::String_"])
    heard = ("rt/ns/heard", ["std_msgs::msg::dds_::Int32_"])
    asked = [("rq/ns/askedRequest", [request]), ("rr/ns/askedReply", [response])]
    offered = [("rq/ns/offeredRequest", [request]), ("rr/ns/offeredReply", [response])]

    def ours(pairs: Any) -> list[Any]:
        return [each for each in pairs if "/ns/" in each[0] and "type_description" not in each[0]]

    assert ours(node.get_topic_names_and_types(no_demangle=True)) == sorted([output, heard, *asked, *offered])
    published = node.get_publisher_names_and_types_by_node("n", "/ns", no_demangle=True)
    assert ours(published) == sorted([output, asked[0], offered[1]])
    subscribed = node.get_subscriber_names_and_types_by_node("n", "/ns", no_demangle=True)
    assert ours(subscribed) == sorted([heard, asked[1], offered[0]])
    [info] = node.get_publishers_info_by_topic("rt/ns/said", no_mangle=True)
    assert info.topic_type == "std_msgs::msg::dds_::String_"


@pytest.mark.parametrize(
    ("name", "namespace", "problem"),
    [
        ("bad-name", "/", "node name must not contain characters other than alphanumerics or '_', result: 2"),
        ("", "/", "node name must not be empty, result: 1"),
        ("n", "x", "namespace must be absolute, it must lead with a '/', result: 2"),
    ],
)
def test_graph_queries_reject_invalid_names_with_rmw_error(ros: Any, name: str, namespace: str, problem: str) -> None:
    with pytest.raises(RCLError) as refused:
        ros.node().get_publisher_names_and_types_by_node(name, namespace)
    assert str(refused.value) == f"failed to get publisher names and types: {problem}"


def test_zero_duration_is_not_printed_as_infinite(ros: Any) -> None:
    node = ros.node()
    node.create_publisher(String, "said", 1)
    [info] = node.get_publishers_info_by_topic("said")
    assert "Lifespan: Infinite" in str(info)
    info.qos_profile.lifespan = Duration(nanoseconds=0)
    assert "Lifespan: 0 nanoseconds" in str(info)
