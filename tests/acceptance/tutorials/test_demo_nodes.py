"""The first commands of the ROS 2 tutorials, except for turtlesim."""

from __future__ import annotations

import re

import pytest
from systems import Program, system


def message(program: Program) -> list[str]:
    return re.findall(r"\]: ((?:.|\n(?!\[))*)", program.stderr.rstrip("\n"))


@pytest.mark.parametrize(
    ("package", "numbers", "quote"),
    [("demo_nodes_cpp", (1, 2, 3), "'"), ("demo_nodes_py", (0, 1, 2), '"')],
)
def test_listener_receives_messages_of_talker(package: str, numbers: tuple[int, ...], quote: str) -> None:
    with system() as running:
        listener = running.executable(package, "listener")
        talker = running.executable(package, "talker")
        running.run(3.5)
    assert message(talker) == [f"Publishing: {quote}Hello World: {each}{quote}" for each in numbers]
    assert message(listener) == [f"I heard: [Hello World: {each}]" for each in numbers]


def test_listeners_receive_messages_of_qos_and_serialized_talkers() -> None:
    with system() as running:
        talker = running.executable("demo_nodes_py", "talker_qos")
        heard = running.executable("demo_nodes_py", "listener_qos")
        deaf = running.executable("demo_nodes_py", "listener_qos", "--reliable")
        running.run(1.5)
    greeting, *_, last = message(talker)
    assert (greeting, last) == ("Best effort talker", 'Publishing: "Hello World: 0"')
    assert message(heard) == ["Best effort listener", "I heard: [Hello World: 0]"]
    assert "I heard: [Hello World: 0]" not in message(deaf)
    with system() as running:
        listener = running.executable("demo_nodes_py", "listener_serialized")
        running.executable("demo_nodes_py", "talker")
        running.run(1.5)
    assert message(listener) == [r'''I heard: "b'\x00\x01\x00\x00\x0f\x00\x00\x00Hello World: 0\x00'"''']


@pytest.mark.parametrize(
    ("words", "count"), [(("-n", "3"), 3), (("--number_of_cycles", "1", "--ros-args"), 1), ((), 20)]
)
def test_talker_ends_after_given_number_of_messages(words: tuple[str, ...], count: int) -> None:
    with system() as running:
        talker = running.finish(running.executable("demo_nodes_py", "talker_qos", *words))
    assert (talker.exit, len(message(talker))) == (0, count + 1)


def test_listener_ends_after_given_number_of_messages() -> None:
    with system() as running:
        listener = running.executable("demo_nodes_py", "listener_qos", "-n", "2")
        running.executable("demo_nodes_py", "talker")
        running.finish(listener)
        unknown = running.finish(running.executable("demo_nodes_py", "listener_qos", "--nope"))
    assert message(listener)[1:] == ["I heard: [Hello World: 0]", "I heard: [Hello World: 1]"]
    assert (unknown.exit, "unrecognized arguments: --nope" in unknown.stderr) == (2, True)


@pytest.mark.parametrize("package", ["demo_nodes_cpp", "demo_nodes_py"])
def test_client_waits_for_its_server(package: str) -> None:
    with system() as running:
        client = running.executable(package, "add_two_ints_client")
        running.run(1.5)
        server = running.executable(package, "add_two_ints_server")
        running.finish(client)
    assert message(client) == ["service not available, waiting again...", "Result of add_two_ints: 5"]
    assert message(server) == ["Incoming request\na: 2 b: 3"]


def test_parameter_demos_work() -> None:
    with system() as running:
        running.executable("demo_nodes_cpp", "parameter_blackboard", "--ros-args", "-p", "color:=red")
        running.executable("demo_nodes_py", "set_parameters_callback")
        running.run(0.5)
        assert running.ask("param", "get", "/parameter_blackboard", "color").stdout == "String value is: red\n"
        assert running.ask("param", "set", "/parameter_blackboard", "new", "1").exit == 0
        running.ask("param", "set", "/set_parameters_callback", "param1", "28.0")
        assert running.ask("param", "get", "/set_parameters_callback", "param2").stdout == "Double value is: 4.0\n"


SEQUENCE = [0, 1, 1, 2, 3, 5, 8, 13, 21, 34, 55]


@pytest.mark.parametrize(
    ("package", "last"),
    [
        ("action_tutorials_py", f"Result: {SEQUENCE}"),
        ("action_tutorials_cpp", f"Result received: {' '.join(map(str, SEQUENCE))} "),
    ],
)
def test_fibonacci_action_succeeds(package: str, last: str) -> None:
    with system() as running:
        server = running.executable(package, "fibonacci_action_server")
        running.run(0.2)
        client = running.executable(package, "fibonacci_action_client")
        running.finish(client)
    assert message(client)[-1].replace("array('i', ", "").replace("])", "]") == last.rstrip("\n")
    assert len(message(client)) >= 11
    assert "Executing goal" in message(server)[0] + message(server)[1]


def test_minimal_examples_work() -> None:
    with system() as running:
        heard = running.executable("examples_rclpy_minimal_subscriber", "subscriber_member_function")
        running.executable("examples_rclpy_minimal_publisher", "publisher_member_function")
        running.executable("examples_rclpy_minimal_service", "service")
        asked = running.finish(running.executable("examples_rclpy_minimal_client", "client"))
        running.run(1.2)
    assert message(heard)[:2] == ['I heard: "Hello World: 0"', 'I heard: "Hello World: 1"']
    assert message(asked) == ["Result of add_two_ints: for 41 + 1 = 42"]


def test_static_transforms_are_echoed() -> None:
    with system() as running:
        new = ("--x", "1", "--yaw", "1.5707963", "--frame-id", "world", "--child-frame-id", "tower")
        reported = running.executable("tf2_ros", "static_transform_publisher", *new)
        old = running.executable("tf2_ros", "static_transform_publisher", "0", "0", "2", "0", "0", "0", "tower", "top")
        echo = running.executable("tf2_ros", "tf2_echo", "world", "top")
        running.run(2.5)
    assert "from 'world' to 'tower'" in reported.stderr
    assert "Old-style arguments are deprecated" in old.stderr
    assert "- Translation: [1.000, 0.000, 2.000]\n" in echo.stdout
    assert "- Rotation: in RPY (degree) [0.000, -0.000, 90.000]" in echo.stdout.replace(
        "[0.000, 0.000", "[0.000, -0.000"
    )


@pytest.mark.parametrize(
    ("words", "refusal"),
    [
        (["--frame-id", "a", "--child-frame-id", "a"], "cannot publish static transform from 'a' to 'a', exiting"),
        (["--frame-id", "a"], "--child-frame-id"),
        (["--qw", "1", "--yaw", "1", "--frame-id", "a", "--child-frame-id", "b"], "not both"),
    ],
)
def test_invalid_static_transform_is_refused(words: list[str], refusal: str) -> None:
    with system() as running:
        ended = running.finish(running.executable("tf2_ros", "static_transform_publisher", *words))
    assert ended.exit != 0
    assert refusal in ended.stderr


def test_demo_package_is_listed() -> None:
    with system() as running:
        assert running.ask("pkg", "executables", "turtlesim").stdout.split() == [
            *("turtlesim", "draw_square", "turtlesim", "mimic"),
            *("turtlesim", "turtle_teleop_key", "turtlesim", "turtlesim_node"),
        ]
