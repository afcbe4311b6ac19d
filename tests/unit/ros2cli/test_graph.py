"""`ros2 node` and `ros2 service` with nodes written in the test."""

from __future__ import annotations

import pytest

SERVER = """
from example_interfaces.srv import AddTwoInts
from std_srvs.srv import SetBool
node = Node('adder', namespace='math')
def add(request, response):
    response.sum = request.a + request.b
    return response
node.create_service(AddTwoInts, 'add', add)
node.create_service(SetBool, '_hidden', lambda request, response: response)
client = node.create_client(SetBool, 'switch')
"""


def test_node_list_counts_and_hides_hidden_nodes(ros) -> None:
    ros.node(SERVER)
    ros.node("node = Node('b')")
    ros.node("node = Node('_hidden')")
    assert ros.ask("node", "list").stdout == "/b\n/math/adder\n"
    assert ros.ask("node", "list", "-c").stdout == "2\n"
    assert ros.ask("node", "list", "--no-daemon", "-a", "-c").stdout == "4\n"


def test_duplicate_node_names_are_warned_about(ros) -> None:
    for _ in range(2):
        ros.node("node = Node('twin')")
    listed = ros.ask("node", "list")
    assert listed.stdout == "/twin\n/twin\n"
    assert listed.stderr.startswith("WARNING: Be aware that there are nodes in the graph that share an exact name")


def test_node_info_lists_endpoints(ros) -> None:
    ros.node(SERVER)
    info = ros.ask("node", "info", "/math/adder").stdout
    assert info.startswith("/math/adder\n  Subscribers:\n\n  Publishers:\n    /parameter_events: ")
    assert "    /math/add: example_interfaces/srv/AddTwoInts\n" in info
    assert "  Service Clients:\n    /math/switch: std_srvs/srv/SetBool\n" in info
    assert "_hidden" not in info
    assert "/math/_hidden" in ros.ask("node", "info", "/math/adder", "--include-hidden").stdout
    missing = ros.ask("node", "info", "/adder")
    assert (missing.exit, missing.stdout, missing.stderr) == (1, "", "Unable to find node '/adder'\n")


def test_service_list_type_find_and_info(ros) -> None:
    ros.node(SERVER)
    assert "/math/add [example_interfaces/srv/AddTwoInts]\n" in ros.ask("service", "list", "-t").stdout
    assert ros.ask("service", "type", "/math/add").stdout == "example_interfaces/srv/AddTwoInts\n"
    assert ros.ask("service", "find", "example_interfaces/srv/AddTwoInts").stdout == "/math/add\n"
    assert ros.ask("service", "info", "/math/add").stdout == (
        "Type: example_interfaces/srv/AddTwoInts\nClients count: 0\nServices count: 1\n"
    )
    hidden = ros.ask("service", "list", "--include-hidden-services").stdout.split()
    assert "/math/_hidden" in hidden
    assert "/math/_hidden" not in ros.ask("service", "list").stdout


def test_call_prints_request_and_response(ros) -> None:
    ros.node(SERVER)
    called = ros.ask("service", "call", "/math/add", "example_interfaces/srv/AddTwoInts", "{a: 2, b: 3}")
    assert called.stdout == (
        "requester: making request: example_interfaces.srv.AddTwoInts_Request(a=2, b=3)\n\n"
        "response:\nexample_interfaces.srv.AddTwoInts_Response(sum=5)\n\n"
    )


def test_call_waits_for_the_service(ros) -> None:
    waiting = ros.ros2("service", "call", "/math/add", "example_interfaces/srv/AddTwoInts", "{a: 2}")
    ros.run(1.0)
    assert waiting.stdout == "waiting for service to become available...\n"
    ros.node(SERVER)
    assert ros.finish(waiting).stdout.endswith("AddTwoInts_Response(sum=2)\n\n")


def test_service_that_appears_is_called_at_once(ros) -> None:
    waiting = ros.ros2("service", "call", "/math/add", "example_interfaces/srv/AddTwoInts", "{a: 2}")
    ros.run(1.02)
    ros.node(SERVER, seconds=0.04)
    assert waiting.exit == 0


def test_call_repeats_at_a_rate(ros) -> None:
    ros.node(SERVER)
    words = ("service", "call", "-r", "2", "/math/add", "example_interfaces/srv/AddTwoInts")
    assert ros.ask(*words, stop_after=1.7).stdout.count("response:\n") == 4


def test_call_rejects_invalid_requests_and_types(ros) -> None:
    ros.node(SERVER)
    wrong = ros.ask("service", "call", "/math/add", "example_interfaces/srv/AddTwoInts", "{c: 2}")
    assert wrong.exit == 1
    assert wrong.stderr == "Failed to populate field: 'AddTwoInts_Request' object has no attribute 'c'\n"
    assert ros.ask("service", "call", "/x", "std_srvs/srv/Nope").stderr == "The passed service type is invalid\n"


def test_hidden_nodes_and_services_are_included_on_request(ros) -> None:
    ros.node(SERVER)
    ros.node("node = Node('_secret')")
    assert ros.ask("node", "info", "/_secret").stderr == "Unable to find node '/_secret'\n"
    assert ros.ask("node", "info", "/_secret", "--include-hidden").stdout.startswith("/_secret\n")
    assert ros.ask("service", "type", "/math/_hidden").exit == 1
    assert ros.ask("service", "type", "/math/_hidden", "--include-hidden-services").stdout == "std_srvs/srv/SetBool\n"


INTROSPECTED = """
from example_interfaces.srv import AddTwoInts
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
node = Node('math')
def add(request, response):
    response.sum = request.a + request.b
    return response
service = node.create_service(AddTwoInts, 'add', add)
service.configure_introspection(node.get_clock(), qos_profile_system_default, ServiceIntrospectionState.CONTENTS)
"""


def test_service_echo_prints_introspection_events(ros) -> None:
    ros.node(INTROSPECTED)
    echo = ros.ros2("service", "echo", "--flow-style", "/add")
    ros.run(0.5)
    ros.ask("service", "call", "/add", "example_interfaces/srv/AddTwoInts", "{a: 2, b: 3}")
    echo.process.interrupt()
    received, sent = ros.finish(echo).stdout.split("---\n")[:2]
    assert received.startswith("info:\n  event_type: REQUEST_RECEIVED\n  stamp:\n    sec: ")
    assert "\n  client_gid: [" in received
    assert received.endswith("request: [{a: 2, b: 3}]\nresponse: []\n")
    assert sent.startswith("info:\n  event_type: RESPONSE_SENT\n")
    assert sent.endswith("request: []\nresponse: [{sum: 5}]\n")


def test_service_echo_needs_a_type(ros) -> None:
    assert ros.ask("service", "echo", "/x").stderr == "Could not load the type for the passed service\n"
    assert ros.ask("service", "echo", "/x", "std_srvs/srv/Nope").stderr == (
        "The service type 'std_srvs/srv/Nope' is invalid\n"
    )


def test_call_accepts_type_without_srv_and_requires_a_map(ros) -> None:
    ros.node(SERVER)
    assert ros.ask("service", "call", "/math/add", "example_interfaces/AddTwoInts", "{a: 1}").exit == 0
    assert ros.ask("service", "call", "/x", "std_srvs/srv/Empty", "hello").stderr == (
        "Failed to populate field: Value 'hello' is expected to be a dictionary but is a str\n"
    )
    assert ros.ask("service", "call", "/x", "std_msgs/msg/String").stderr == "The passed type is not a service\n"


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("topic", "pub", "-w0", "/x", "std_msgs/msg/UInt8", "{data: 256}"), "an integer in [0, 255], not int (256)"),
        (("service", "call", "/x", "rcl_interfaces/srv/ListParameters", "{depth: -1}"), "not int (-1)"),
        (
            ("action", "send_goal", "/x", "example_interfaces/action/Fibonacci", "{order: 3000000000}"),
            "not int (3000000000)",
        ),
        (("topic", "pub", "-w0", "/x", "sensor_msgs/msg/Imu", "{orientation_covariance: [1.0]}"), "exactly 9, not"),
    ],
)
def test_value_that_a_field_cannot_hold_is_refused_in_one_line(ros, words: tuple[str, ...], reason: str) -> None:
    refused = ros.ask(*words)
    assert (refused.exit, refused.stderr.count("\n")) == (1, 1)
    assert refused.stderr.startswith("Failed to populate ") and reason in refused.stderr
