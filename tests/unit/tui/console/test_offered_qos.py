"""A subscription requests the QoS offered, and less as soon as a publisher offers less."""

import pytest
from bot_console.tui.console.offered_qos import OfferedSubscription, weakest
from domains import unused_domain
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

RELIABLE, BEST_EFFORT = ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT
LATCHED, VOLATILE = DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE
BEST = QoSProfile(depth=10, reliability=RELIABLE, durability=LATCHED)
WEAK = QoSProfile(depth=10, reliability=BEST_EFFORT, durability=VOLATILE)


@pytest.fixture
def node():
    context = Context()
    context.init([], domain_id=unused_domain())
    made = Node("console", context=context)
    made.executor_of_test = SingleThreadedExecutor(context=context)
    made.executor_of_test.add_node(made)
    yield made
    made.destroy_node()
    context.try_shutdown()


def settle(node):
    for _ in range(20):
        node.executor_of_test.spin_once(timeout_sec=0)


def requested_qos(node):
    (info,) = node.get_subscriptions_info_by_topic("/t")
    return info.qos_profile.reliability, info.qos_profile.durability


@pytest.mark.parametrize(
    ("offers", "wanted"),
    [
        ([(RELIABLE, LATCHED)], (RELIABLE, LATCHED)),
        ([(RELIABLE, VOLATILE)], (RELIABLE, VOLATILE)),
        ([(BEST_EFFORT, LATCHED)], (BEST_EFFORT, LATCHED)),
        ([(RELIABLE, LATCHED), (BEST_EFFORT, VOLATILE)], (BEST_EFFORT, VOLATILE)),
        ([(ReliabilityPolicy.UNKNOWN, DurabilityPolicy.UNKNOWN)], (BEST_EFFORT, VOLATILE)),
    ],
)
def test_no_more_is_requested_than_all_publishers_offer(offers, wanted):
    profiles = [QoSProfile(depth=1, reliability=one, durability=two) for one, two in offers]
    assert weakest(BEST, profiles) == wanted


def test_no_more_is_requested_than_wanted():
    wanted = QoSProfile(depth=1, reliability=BEST_EFFORT, durability=VOLATILE)
    assert weakest(wanted, [BEST]) == (BEST_EFFORT, VOLATILE)


def test_messages_of_a_weaker_publisher_and_of_all_others_are_received(node):
    heard = []
    strong = node.create_publisher(String, "/t", BEST)
    subscription = OfferedSubscription(node, String, "/t", lambda message: heard.append(message.data), BEST)
    strong.publish(String(data="strong"))
    settle(node)
    weak = node.create_publisher(String, "/t", WEAK)
    subscription.follow()
    assert requested_qos(node) == (BEST_EFFORT, VOLATILE)
    weak.publish(String(data="weak"))
    strong.publish(String(data="strong again"))
    settle(node)
    assert heard == ["strong", "weak", "strong again"]


def test_stronger_qos_is_requested_again_unless_that_would_duplicate_lines(node):
    strong, weak = node.create_publisher(String, "/t", BEST), node.create_publisher(String, "/t", WEAK)
    heard = []
    once = OfferedSubscription(node, String, "/t", lambda message: heard.append(message.data), BEST, once_weak=True)
    once.follow()
    strong.publish(String(data="one"))
    settle(node)
    node.destroy_publisher(weak)
    once.follow()
    settle(node)
    assert heard == ["one"] and requested_qos(node) == (BEST_EFFORT, VOLATILE)
    once.destroy()
    again = OfferedSubscription(node, String, "/t", lambda message: None, BEST)
    again.follow()
    assert requested_qos(node) == (RELIABLE, LATCHED)


def test_without_eager_nothing_is_requested_before_it_is_offered(node):
    heard = []
    subscription = OfferedSubscription(
        node, String, "/offered_late", lambda message: heard.append(message.data), BEST, eager=False
    )
    subscription.follow()
    assert node.get_subscriptions_info_by_topic("/offered_late") == []
    node.create_publisher(String, "/offered_late", BEST).publish(String(data="kept"))
    subscription.follow()
    settle(node)
    assert heard == ["kept"]
