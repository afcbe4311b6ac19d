"""The parameter services as clients see them, and `AsyncParameterClient`."""

from pathlib import Path
from typing import Any

import pytest
from rcl_interfaces import srv
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient

ALL = [
    "describe_parameters",
    "get_parameter_types",
    "get_parameters",
    "list_parameters",
    "set_parameters",
    "set_parameters_atomically",
]


def server_of(ros: Any, **options: Any) -> Node:
    node = ros.node("server", **options)
    limits = FloatingPointRange(from_value=0.0, to_value=5.0)
    node.declare_parameter("speed", 1.0, ParameterDescriptor(floating_point_range=[limits]))
    node.declare_parameters("", [("count", 3), ("gains.p", 1.5), ("ids", [1, 2]), ("empty", Parameter.Type.INTEGER)])
    node.declare_parameter("dyn", 1, ParameterDescriptor(dynamic_typing=True))
    return node


def messages(**values: Any) -> list[Any]:
    return [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]


def ask(ros: Any, service: Any, name: str, **fields: Any) -> Any:
    return ros.ask(ros.node("asker"), service, f"/server/{name}", **fields)


def test_services_have_upstreams_names(ros: Any) -> None:
    node = ros.node("server", namespace="/ns")
    names = [name for name, _ in node.get_service_names_and_types_by_node("server", "/ns")]
    assert [name for name in sorted(names) if "parameter" in name] == [f"/ns/server/{name}" for name in ALL]
    ros.node("quiet", start_parameter_services=False)
    names = [name for name, _ in node.get_service_names_and_types_by_node("quiet", "/")]
    assert names == ["/quiet/get_type_description"]


@pytest.mark.parametrize(
    ("names", "found"),
    [(["speed", "gains.p"], [1.0, 1.5]), (["speed", "nope"], []), (["speed", "empty"], []), ([], [])],
)
def test_get_parameters_returns_values_of_declared_names(names: list[str], found: list[float], ros: Any) -> None:
    server_of(ros)
    response = ask(ros, srv.GetParameters, "get_parameters", names=names)
    assert [value.double_value for value in response.values] == found


def test_types_and_descriptors_are_returned(ros: Any) -> None:
    server_of(ros)
    types = ask(ros, srv.GetParameterTypes, "get_parameter_types", names=["speed", "ids", "empty"]).types
    assert list(types) == [3, 7, 0]
    assert list(ask(ros, srv.GetParameterTypes, "get_parameter_types", names=["speed", "nope"]).types) == []
    [found] = ask(ros, srv.DescribeParameters, "describe_parameters", names=["speed"]).descriptors
    assert (found.name, found.type, found.floating_point_range[0].to_value) == ("speed", 3, 5.0)
    assert ask(ros, srv.DescribeParameters, "describe_parameters", names=["speed", "nope"]).descriptors == []


def test_undeclared_parameters_are_returned_as_not_set_if_allowed(ros: Any) -> None:
    server_of(ros, allow_undeclared_parameters=True)
    values = ask(ros, srv.GetParameters, "get_parameters", names=["speed", "nope"]).values
    assert [value.type for value in values] == [3, 0]
    assert list(ask(ros, srv.GetParameterTypes, "get_parameter_types", names=["nope"]).types) == [0]


def test_list_parameters_returns_names_and_prefixes(ros: Any) -> None:
    server_of(ros)
    result = ask(ros, srv.ListParameters, "list_parameters", prefixes=["gains", "count"], depth=0).result
    assert (result.names, result.prefixes) == (["count", "gains.p"], ["gains"])


def test_set_parameters_reports_each_result(ros: Any) -> None:
    node = server_of(ros)
    wanted = messages(count=4, nope=1, speed=9.0, ids=[7])
    results = ask(ros, srv.SetParameters, "set_parameters", parameters=wanted).results
    assert [(each.successful, each.reason) for each in results] == [
        (True, ""),
        (False, "Invalid access to undeclared parameter(s): []"),
        (False, "Parameter speed out of range Min: 0.0, Max: 5.0, value: 9.0"),
        (True, ""),
    ]
    assert node.get_parameter("count").value == 4
    assert f"{node.get_parameter('ids').value}" == "array('q', [7])"


def test_atomic_set_changes_all_or_nothing(ros: Any) -> None:
    node = server_of(ros)
    name = "set_parameters_atomically"
    refused = ask(ros, srv.SetParametersAtomically, name, parameters=messages(count=4, speed=9.0)).result
    assert not refused.successful
    unknown = ask(ros, srv.SetParametersAtomically, name, parameters=messages(count=4, nope=1)).result
    assert unknown.reason == "Invalid access to undeclared parameter(s): []"
    assert node.get_parameter("count").value == 3
    assert ask(ros, srv.SetParametersAtomically, name, parameters=messages(count=4, speed=2.0)).result.successful
    assert [each.value for each in node.get_parameters(["count", "speed"])] == [4, 2.0]


def test_exception_in_a_callback_leaves_spin_without_an_answer(ros: Any) -> None:
    node = server_of(ros)

    def fail(parameters: Any) -> SetParametersResult:
        raise ValueError("boom")

    node.add_on_set_parameters_callback(fail)
    client = ros.node("asker").create_client(srv.SetParameters, "/server/set_parameters")
    future = client.call_async(srv.SetParameters.Request(parameters=messages(count=4)))
    with pytest.raises(ValueError, match="boom"):
        ros.spin(future.done)
    ros.settle()
    assert not future.done()
    assert node.get_parameter("count").value == 3


def client_of(ros: Any) -> AsyncParameterClient:
    return AsyncParameterClient(ros.node("asker"), "server")


def result(ros: Any, future: Any) -> Any:
    ros.spin(future.done)
    return future.result()


def test_wait_for_services_waits_until_its_timeout(ros: Any) -> None:
    client = client_of(ros)
    assert not client.services_are_ready()
    assert not client.wait_for_services(timeout_sec=0.0)
    server_of(ros)
    assert client.wait_for_services(timeout_sec=5.0)
    assert client.services_are_ready()


def test_client_methods_call_their_services(ros: Any) -> None:
    node, client = server_of(ros), client_of(ros)
    assert result(ros, client.get_parameters(["speed"])).values[0].double_value == 1.0
    assert list(result(ros, client.get_parameter_types(["speed", "ids"])).types) == [3, 7]
    assert result(ros, client.list_parameters(["gains"], 1)).result.names == ["gains.p"]
    assert "speed" in result(ros, client.list_parameters()).result.names
    assert result(ros, client.describe_parameters(["speed"])).descriptors[0].name == "speed"
    wanted = [Parameter("speed", value=2.0), Parameter("count", value="x").to_parameter_msg()]
    assert [each.successful for each in result(ros, client.set_parameters(wanted)).results] == [True, False]
    assert not result(ros, client.set_parameters_atomically(wanted)).result.successful
    deleted = result(ros, client.delete_parameters(["dyn", "count"])).results
    assert [each.reason for each in deleted] == ["", "Static parameter cannot be undeclared"]
    assert not node.has_parameter("dyn")


def test_client_callback_gets_the_future(ros: Any) -> None:
    server_of(ros)
    got: list[Any] = []
    client_of(ros).get_parameters(["count"], callback=lambda future: got.append(future.result().values[0]))
    ros.spin(lambda: bool(got))
    assert got[0].integer_value == 3


def test_parameter_file_can_be_loaded(ros: Any, tmp_path: Path) -> None:
    node, client = server_of(ros), client_of(ros)
    path = tmp_path / "f.yaml"
    path.write_text(
        "server:\n  ros__parameters:\n    speed: 2.5\n    gains: {p: 9.5}\n"
        "other:\n  ros__parameters:\n    count: 77\n"
        "/**:\n  ros__parameters:\n    speed: 4.5\n"
    )
    assert len(result(ros, client.load_parameter_file(str(path))).results) == 3
    assert [each.value for each in node.get_parameters(["speed", "gains.p", "count"])] == [2.5, 9.5, 77]
    path.write_text("/**:\n  ros__parameters:\n    speed: 4.5\n    count: x\n")
    with pytest.raises(RuntimeError, match="does not contain selected parameters"):
        client.load_parameter_file(str(path))
    assert not result(ros, client.load_parameter_file_atomically(str(path), use_wildcard=True)).result.successful
    with pytest.raises(FileNotFoundError):
        client.load_parameter_file(str(tmp_path / "none.yaml"))


def test_client_receives_parameter_events(ros: Any) -> None:
    client = client_of(ros)
    heard: list[str] = []
    client.on_parameter_event(lambda event: heard.append(event.node))
    server = ros.node("changing")
    server.declare_parameter("x", 1)
    ros.spin(lambda: "/changing" in heard)
