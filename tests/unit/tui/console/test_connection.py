"""The console's connection to ROS: before it exists, when it breaks, and when it is closed with pending requests."""

import pytest
import rclpy
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.console.robot import robot_drive
from bot_console.tui.console.ros_console import RosConsole
from domains import unused_domain
from rclpy.context import Context
from rigs import TIMEOUT_S, until
from std_srvs.srv import Trigger


@pytest.fixture
def domain(monkeypatch):
    number = unused_domain()
    monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
    monkeypatch.setattr(robot_drive, "LAST_ZERO_TIMEOUT_S", 0.0)
    return number


@pytest.fixture
def idle(domain):
    """A node that offers a service and is never spun."""
    context = Context()
    rclpy.init(args=[], context=context, domain_id=domain)
    node = rclpy.create_node("idle", context=context, start_parameter_services=False)
    node.create_service(Trigger, "wait", lambda request, response: response)
    yield node
    node.destroy_node()
    context.shutdown()


@pytest.fixture
def console(domain):
    made = RosConsole()
    yield made
    made.close()


def test_before_it_is_connected_everything_is_refused_and_nothing_is_known(console):
    assert console.snapshot().graph.nodes == ()
    assert console.snapshot() is console.snapshot()
    assert "still connecting" in console.parameters.undo().result(TIMEOUT_S).text
    assert "still connecting" in console.parameters.set("/n", {"a": 1}).result(TIMEOUT_S)[0].reason
    assert not console.plots.watch("/t/data").ok
    console.drive.move(1.0, 0.0)
    console.drive.stop()
    assert list(console.parameters.changes()) == list(console.plots.plottable()) == []


def test_pending_requests_are_answered_when_the_console_is_closed(console, idle):
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    waiting = console.topics.call_service("/wait", "std_srvs/srv/Trigger", {})
    console.close()
    answer = waiting.result(TIMEOUT_S)
    assert (answer.ok, answer.text) == (False, "the console has closed")


def test_a_broken_connection_reports_the_place_and_refuses_from_then_on(console, idle, monkeypatch):
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    waiting = console.topics.call_service("/wait", "std_srvs/srv/Trigger", {})
    assert not console.topics.call_service("/nowhere", "std_srvs/srv/Trigger", {}).result(TIMEOUT_S).ok, (
        "so the one before is sent"
    )

    def broken(self):
        raise RuntimeError("the graph is gone")

    monkeypatch.setattr(GraphWatch, "poll", broken)
    until(lambda: console.snapshot().problem, "the problem")
    assert "the graph is gone" in console.snapshot().problem
    assert "test_connection.py" in console.snapshot().problem
    assert "the graph is gone" in waiting.result(TIMEOUT_S).text
    assert "the graph is gone" in console.parameters.undo().result(TIMEOUT_S).text


def test_closing_before_it_is_connected_leaves_no_thread(console):
    console._closed = True  # as if `close` was called while the thread is still importing
    console.start()
    console._thread.join(TIMEOUT_S)
    assert not console._thread.is_alive()


def test_system_started_from_a_file_has_the_profile_of_that_file(domain, tmp_path):
    (tmp_path / "slow.yaml").write_text("robot_navigator:\n  ros__parameters:\n    max_speed: 0.3\n")
    console = RosConsole(active_profile=str(tmp_path / "slow.yaml"))
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    snapshot = console.snapshot()
    console.close()
    assert snapshot.active_profile == "slow" and [each.name for each in snapshot.profiles] == ["slow"]


def test_a_stop_requested_before_connecting_is_sent_once_connected(console):
    console.drive.stop(True, "at the first key")
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    assert console.snapshot().drive.stopped_here
    assert console.snapshot().drive.stop_reason == "at the first key"


def test_a_stop_withdrawn_before_connecting_is_not_sent(console):
    console.drive.stop(True)
    console.drive.stop(False)
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    assert not console.snapshot().drive.stopped
