"""A process that is frozen, or does not read its subscriptions, delays no other process."""

import os
import signal
import time

import pytest
from bot_console.runtime.process import on_notice
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.whole_graph import WholeGraph
from helpers.processes.two_processes import DOMAIN, two_processes
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import Trigger

SCANS = 1000
SCAN = LaserScan(ranges=[1.0] * 360, intensities=[2.0] * 360)
EVERYTHING = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=0)


@pytest.fixture(scope="module")
def here(tmp_path_factory):
    with two_processes(tmp_path_factory.mktemp("mesh") / "s", peers=2) as (system, (_, frozen)):
        system.publisher = system.node.create_publisher(LaserScan, "/scan", EVERYTHING)
        system.until(lambda: system.publisher.get_subscription_count() == 2)
        frozen.send_signal(signal.SIGSTOP)
        system.frozen, system.folder = frozen.pid, os.environ["BOT_CONSOLE_SOCKET_DIR"]
        yield system


def duration_of(action) -> float:
    began = time.monotonic()
    action()
    return time.monotonic() - began


def test_a_reliable_publisher_does_not_block_and_active_subscribers_get_everything(here):
    longest = max(duration_of(lambda: here.publisher.publish(SCAN)) for _ in range(SCANS))
    assert longest < 1.0  # waiting for the frozen process would take 2 s; this takes 0.1 s on a quiet machine
    asked = here.node.create_client(Trigger, "/scans")
    here.until(asked.service_is_ready)
    here.until(lambda: here.result(asked.call_async(Trigger.Request())).message == str(SCANS))


def test_graph_queries_and_new_entities_do_not_wait_for_the_frozen_process(here):
    assert duration_of(here.node.get_node_names) < 1.0
    assert "peer" in here.node.get_node_names()
    assert duration_of(lambda: here.node.create_publisher(String, "/new", 10)) < 1.0
    assert duration_of(lambda: here.node.create_subscription(String, "/new", lambda message: None, 10)) < 1.0
    assert duration_of(lambda: Node("another", context=here.context).destroy_node()) < 2.0


def test_a_service_of_another_process_responds(here):
    client = here.node.create_client(Trigger, "/pull")
    here.until(client.service_is_ready)
    assert here.result(client.call_async(Trigger.Request())).success


def test_the_frozen_process_is_reported_at_once_with_its_nodes(here):
    assert {pid: list(nodes) for pid, nodes in here.context.bus.stopped().items()} == {here.frozen: ["/other/peer"]}


def test_a_later_process_learns_which_one_is_frozen_and_sees_the_others(here, monkeypatch):
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", here.folder)
    output = []
    forget = on_notice(lambda process, text: output.append(text))
    session = open_session(DOMAIN)
    here.until(lambda: len(session.linked()) == 2)
    graph = WholeGraph(session, lambda owner: None)
    forget()
    session.close()
    assert sorted(each.name for each in graph.tables.nodes()) == ["here", "peer"]
    (text,) = output
    assert f"process {here.frozen} is stopped" in text
