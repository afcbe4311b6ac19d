"""Topics and services work with another implementation of the wire format, in both directions."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from example_interfaces.srv import AddTwoInts
from helpers.processes.two_processes import DOMAIN, two_processes
from std_msgs.msg import String

pytest.importorskip("zenoh_ros2_sdk", reason="zenoh-ros2-sdk is not installed")
PEER = Path(__file__).resolve().parents[1] / "helpers" / "processes" / "sdk_peer.py"


def other_environment(socket: Path) -> dict[str, str]:
    """The environment in which the other implementation connects to our socket, and neither listens nor scouts."""
    settings = {
        "mode": '"peer"',
        "connect/endpoints": f'["unixsock-stream/{socket}"]',
        "listen/endpoints": "[]",
        "scouting/multicast/enabled": "false",
        "scouting/gossip/enabled": "false",
    }
    text = ";".join(f"{name}={value}" for name, value in settings.items())
    return dict(os.environ, ZENOH_CONFIG_OVERRIDE=text)


@pytest.fixture(scope="module")
def here(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mesh") / "s"
    with two_processes(folder, peers=0) as (system, _):
        (socket,) = (each for each in (folder / str(DOMAIN)).iterdir() if each.suffix != ".lock")
        other = subprocess.Popen([sys.executable, str(PEER)], env=other_environment(socket))
        try:
            system.until(lambda: "sdk" in system.node.get_node_names())
            yield system
        finally:
            other.kill()
            other.wait()


def test_messages_of_the_other_implementation_are_received(here):
    heard = []
    here.node.create_subscription(String, "/chatter", lambda message: heard.append(message.data), 10)
    here.until(lambda: len(heard) > 2)
    numbers = [int(each.removeprefix("hello ")) for each in heard]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_a_service_of_the_other_implementation_responds(here):
    client = here.node.create_client(AddTwoInts, "/add")
    here.until(client.service_is_ready)
    assert here.result(client.call_async(AddTwoInts.Request(a=2, b=40))).sum == 42


def test_the_other_implementation_receives_our_messages_and_calls_our_service(here):
    def add(request, response):
        response.sum = request.a + request.b
        return response

    heard = []
    here.node.create_service(AddTwoInts, "/add_here", add)
    here.node.create_subscription(String, "/heard", lambda message: heard.append(message.data), 10)
    publisher = here.node.create_publisher(String, "/said", 10)
    here.until(lambda: publisher.get_subscription_count() == 1)
    publisher.publish(String(data="from here"))
    here.until(lambda: heard)
    assert heard == ["from here 42"]
