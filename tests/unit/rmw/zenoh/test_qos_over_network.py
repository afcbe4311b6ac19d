"""QoS over a router follows rmw_zenoh, which knows no incompatible profiles and lets nothing expire on its way.

The other side is a bare session that declares the tokens of captured nodes of rmw_zenoh_cpp and sends as they do.
"""

import threading
import time

import pytest
import rclpy
from bot_console.runtime.rmw.local import LocalBus, local_bus
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.qos_matching import DDS, RMW_ZENOH
from bot_console.runtime.rmw.zenoh.bus import ZenohBus
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig
from bot_console.runtime.rmw.zenoh.network.router import Router
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.tui.console.graph.pairs import unheard
from bot_console.tui.session.embedded.connecting import connect
from processes.captured_node import CapturedNode
from processes.ports import free_port
from rcl_interfaces.msg import Log
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

BEST_EFFORT, VOLATILE = "2::,5:,:,:,,", "::,10:,:,:,,"
TIMEOUT_S, POLL_S = 20.0, 0.02
MANY = 900
LATCHED = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
WEAK = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)


@pytest.fixture
def config():
    serving = Serving((f"tcp/127.0.0.1:{free_port()}",))
    router = Router(serving)
    yield ClientConfig(serving.endpoints)
    router.close()


@pytest.fixture
def captured_nodes(config):
    made = []

    def make(*what, **how):
        made.append(CapturedNode(config, *what, **how))
        return made[-1]

    yield make
    for each in made:
        each.session.close()


@pytest.fixture
def console(config):
    buses, context = connect(config), Context()
    rclpy.init(args=[], context=context, domain_id=0)
    node = rclpy.create_node("console", context=context, enable_rosout=False, start_parameter_services=False)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    yield node
    executor.shutdown()
    node.destroy_node()
    context.shutdown()
    buses.close()
    choose_middleware(local_bus)


def until(done, node=None, step=lambda: None):
    """Process what arrives until `done`; fail after the timeout."""
    end = time.monotonic() + TIMEOUT_S
    while not done():
        assert time.monotonic() < end
        step()
        if node is None:
            threading.Event().wait(POLL_S)
        else:
            node.executor.spin_once(timeout_sec=POLL_S)


@pytest.mark.parametrize(
    ("offered", "requested"),
    [(BEST_EFFORT, QoSProfile(depth=10)), (VOLATILE, LATCHED), (BEST_EFFORT, LATCHED)],
    ids=["best effort to reliable", "volatile to transient local", "both"],
)
def test_a_subscription_that_requests_more_than_is_offered_receives(captured_nodes, console, offered, requested):
    heard = []
    talker = captured_nodes("MP", "/latched", qos=offered)
    subscription = console.create_subscription(String, "/latched", heard.append, requested)
    until(lambda: console.count_publishers("/latched") and subscription.handle.get_publisher_count(), console)
    until(lambda: heard, console, lambda: talker.send(String(data="hello")))
    infos = console.get_publishers_info_by_topic("/latched"), console.get_subscriptions_info_by_topic("/latched")
    assert all(infos) and list(unheard("/latched", *infos)) == []
    assert rclpy.get_rmw_implementation_identifier() == "rmw_zenoh_cpp"


def test_a_publisher_that_offers_less_than_is_requested_matches_and_delivers(captured_nodes, console):
    listener = captured_nodes("MS", "/tl_sub")
    publisher = console.create_publisher(String, "/tl_sub", WEAK)
    until(lambda: publisher.get_subscription_count() == 1, console)
    until(lambda: listener.heard, console, lambda: publisher.publish(String(data="hello")))
    listener.session.close()
    until(lambda: publisher.get_subscription_count() == 0, console)


def test_nodes_of_one_program_match_by_the_same_rules(console):
    heard = []
    console.create_subscription(String, "/t", heard.append, 10)
    publisher = console.create_publisher(String, "/t", WEAK)
    assert publisher.get_subscription_count() == 1
    publisher.publish(String(data="hello"))
    until(lambda: heard, console)


def test_log_lines_older_than_their_lifespan_are_received(captured_nodes, console):
    base = captured_nodes("MP", "/rosout", cache=1000)
    assert base.token.qos.lifespan.nanoseconds == 10_000_000_000
    minute_ago = time.time_ns() - 60_000_000_000
    for number in range(MANY):
        base.send(Log(msg=f"line {number}", name="base"), minute_ago + number)
    heard = []
    console.create_subscription(Log, "/rosout", lambda line: heard.append(line.msg), LATCHED)
    until(lambda: len(heard) >= MANY, console)
    assert heard == [f"line {number}" for number in range(MANY)]


def test_served_robot_follows_domain_rules_inside_and_rmw_zenoh_rules_behind_its_router(socket_folder):
    serving = Serving((f"tcp/127.0.0.1:{free_port()}",))
    robot, beside = MeshSession(0, serving), MeshSession(0)
    listener = CapturedNode(ClientConfig(serving.endpoints), "MS", "/tl_sub")
    bus = ZenohBus(robot, LocalBus())
    choose_middleware(lambda domain: bus)
    context = Context()
    rclpy.init(args=[], context=context, domain_id=0)
    try:
        assert robot.qos_rules(beside.zid) is robot.qos_rules(robot.zid) is DDS
        assert robot.qos_rules(listener.session.zid) is RMW_ZENOH
        node = rclpy.create_node("robot", context=context, enable_rosout=False, start_parameter_services=False)
        publisher = node.create_publisher(String, "/tl_sub", WEAK)
        until(lambda: publisher.get_subscription_count() == 1)
        until(lambda: listener.heard, None, lambda: publisher.publish(String(data="hello")))
        node.destroy_node()
    finally:
        context.shutdown()
        choose_middleware(local_bus)
        for each in (listener.session, beside, robot):
            each.close()
