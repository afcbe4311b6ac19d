"""The guarantees of rclpy hold between two processes; all tests of this module share one system."""

import pytest
from example_interfaces.action import Fibonacci
from helpers.processes.two_processes import two_processes
from rcl_interfaces.msg import Log, ParameterEvent
from rclpy.action import ActionClient
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.serialization import deserialize_message
from rclpy.subscription_content_filter_options import ContentFilterOptions
from std_msgs.msg import String
from std_srvs.srv import Trigger


@pytest.fixture(scope="module")
def here(tmp_path_factory):
    with two_processes(tmp_path_factory.mktemp("mesh") / "s", 1, "patient") as (system, _):
        yield system


def test_published_messages_are_received_once_and_in_order(here):
    heard = []
    here.node.create_subscription(String, "/echo", lambda m: heard.append(m.data), 1000)
    publisher = here.node.create_publisher(String, "/say", 1000)
    here.until(lambda: publisher.get_subscription_count() == 1)
    here.until(lambda: here.node.count_publishers("/echo") == 1)
    output = [str(each) for each in range(200)]
    for each in output:
        publisher.publish(String(data=each))
    here.until(lambda: len(heard) >= 200)
    assert heard == output


@pytest.mark.parametrize("raw", [False, True])
def test_content_filter_holds_for_messages_of_another_process(here, raw):
    heard = []
    wanted = ContentFilterOptions("data LIKE %0", ["'%7'"])
    subscription = here.node.create_subscription(
        String, "/echo", heard.append, 1000, raw=raw, content_filter_options=wanted
    )
    everything = []
    other = here.node.create_subscription(String, "/echo", lambda m: everything.append(m.data), 1000)
    publisher = here.node.create_publisher(String, "/say", 1000)
    here.until(lambda: publisher.get_subscription_count() == 1)
    here.until(lambda: here.node.count_publishers("/echo") == 1)
    for number in range(30):
        publisher.publish(String(data=str(number)))
    here.until(lambda: len(everything) >= 30 and len(heard) >= 3)
    assert [deserialize_message(each, String).data if raw else each.data for each in heard] == ["7", "17", "27"]
    for made in (subscription, other):
        here.node.destroy_subscription(made)
    here.node.destroy_publisher(publisher)


def test_a_latched_message_is_delivered_to_late_subscriptions(here):
    heard = []
    qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    here.node.create_subscription(String, "/latched", lambda m: heard.append(m.data), qos)
    here.until(lambda: heard)
    assert heard == ["kept"]


def test_an_incompatible_profile_is_reported_and_nothing_is_received(here):
    reported, heard, fitting = [], [], []
    events = SubscriptionEventCallbacks(incompatible_qos=reported.append)
    here.node.create_subscription(String, "/poor", heard.append, 10, event_callbacks=events)
    here.node.create_subscription(String, "/poor", fitting.append, qos_profile_sensor_data)
    here.until(lambda: reported and len(fitting) > 3)
    assert heard == []
    assert reported[0].total_count == 1


def test_a_service_responds_and_its_log_line_arrives(here):
    lines = []
    qos = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    here.node.create_subscription(Log, "/rosout", lambda line: lines.append(line.msg), qos)
    client = here.node.create_client(Trigger, "/pull")
    here.until(client.service_is_ready)
    answer = here.result(client.call_async(Trigger.Request()))
    assert (answer.success, answer.message) == (True, "pulled")
    here.until(lambda: "somebody pulled" in lines)


@pytest.mark.slow
def test_a_flood_of_log_lines_arrives_complete_and_in_order(here):
    heard = []
    qos = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=0, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    subscription = here.node.create_subscription(Log, "/rosout", lambda line: heard.append(line.msg), qos)
    client = here.node.create_client(Trigger, "/flood")
    here.until(client.service_is_ready)
    done = client.call_async(Trigger.Request())

    def taken():
        for _ in range(1000):  # one message each
            here.executor.spin_once(timeout_sec=0)
        return done.done() and "flood 19999" in heard[-5:]

    here.until(taken)
    flooded = [each for each in heard if each.startswith("flood ")]
    here.node.destroy_subscription(subscription)
    assert flooded == [f"flood {number}" for number in range(20_000)]


def test_an_action_gives_feedback_and_a_result(here):
    client = ActionClient(here.node, Fibonacci, "/fibonacci")
    here.until(client.server_is_ready)
    feedback = []
    goal = here.result(client.send_goal_async(Fibonacci.Goal(order=3), feedback.append))
    assert goal.accepted
    result = here.result(goal.get_result_async()).result
    assert list(result.sequence) == [0, 1, 1, 2, 3]
    assert [list(each.feedback.sequence) for each in feedback] == [[0, 1, 1], [0, 1, 1, 2], [0, 1, 1, 2, 3]]


def test_parameters_are_read_and_set_and_the_change_is_reported(here):
    events = []
    here.node.create_subscription(ParameterEvent, "/parameter_events", events.append, 10)
    client = AsyncParameterClient(here.node, "/other/peer")
    here.until(client.services_are_ready)
    here.until(lambda: here.node.count_publishers("/parameter_events") >= 2)
    assert here.result(client.get_parameters(["speed"])).values[0].double_value == 1.5
    assert here.result(client.set_parameters([Parameter("speed", value=2.5)])).results[0].successful
    here.until(lambda: any(each.node == "/other/peer" for each in events))
    refused = here.result(client.set_parameters([Parameter("speed", value="fast")])).results[0]
    assert not refused.successful and refused.reason


def test_the_graph_shows_both_nodes(here):
    names = here.node.get_node_names_and_namespaces()
    assert sorted(names) == [("here", "/"), ("peer", "/other")]
    (info,) = here.node.get_publishers_info_by_topic("/echo")
    assert (info.node_name, info.node_namespace, info.topic_type) == ("peer", "/other", "std_msgs/msg/String")
    assert str(info.topic_type_hash).startswith("RIHS01_df668c74")
    assert info.qos_profile.depth == 1000
    services = dict(here.node.get_service_names_and_types_by_node("peer", "/other"))
    assert services["/pull"] == ["std_srvs/srv/Trigger"]
