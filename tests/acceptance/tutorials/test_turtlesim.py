"""The turtlesim tutorials, as a person types them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial

import pytest
from systems import Program, System, system

TWIST = "geometry_msgs/msg/Twist"


@pytest.fixture
def running() -> Iterator[System]:
    with system() as found:
        yield found


@pytest.fixture
def sim(running: System) -> Program:
    """A turtlesim that has been running for a while."""
    program = running.executable("turtlesim", "turtlesim_node")
    running.run(0.5)
    return program


def message(program: Program) -> list[str]:
    return re.findall(r"\[turtlesim\]: (.*)", program.stderr)


def pose(running: System, turtle: str = "turtle1") -> dict[str, float]:
    text = running.ask("topic", "echo", "--once", f"/{turtle}/pose").stdout
    return {name: float(value) for name, value in re.findall(r"(\w+): ([-\d.e]+)", text)}


def call(running: System, service: str, kind: str, fields: str = "{}") -> str:
    return running.ask("service", "call", service, kind, fields).stdout


def test_turtlesim_starts_with_upstreams_messages(running: System, sim: Program) -> None:
    assert message(sim) == [
        "Starting turtlesim with node name /turtlesim",
        "Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]",
    ]
    assert running.ask("topic", "list").stdout.split() == [
        "/parameter_events",
        "/rosout",
        "/turtle1/cmd_vel",
        "/turtle1/color_sensor",
        "/turtle1/pose",
    ]
    assert running.ask("action", "list", "-t").stdout == (
        "/turtle1/rotate_absolute [turtlesim/action/RotateAbsolute]\n"
    )
    services = running.ask("service", "list").stdout.split()
    turtles = {"set_pen", "teleport_absolute", "teleport_relative"}
    assert {"/clear", "/kill", "/reset", "/spawn", *(f"/turtle1/{each}" for each in turtles)} <= {*services}


def test_velocity_expires_after_a_second(running: System, sim: Program) -> None:
    running.ask("topic", "pub", "--once", "/turtle1/cmd_vel", TWIST, "{linear: {x: 2.0}, angular: {z: 1.8}}")
    running.run(3.0)
    at_rest = pose(running)
    assert (at_rest["linear_velocity"], at_rest["angular_velocity"]) == (0.0, 0.0)
    # 62 or 63 frames of 16 ms: a quarter of a circle of 2 / 1.8 m.
    assert at_rest["theta"] / (1.8 * 0.016) == pytest.approx(round(at_rest["theta"] / (1.8 * 0.016)), abs=1e-3)
    assert round(at_rest["theta"] / (1.8 * 0.016)) in (62, 63)
    assert running.ask("topic", "echo", "--once", "/turtle1/color_sensor").stdout == "r: 179\ng: 184\nb: 255\n---\n"


def test_turtle_stops_at_walls(running: System, sim: Program) -> None:
    call(running, "/turtle1/teleport_absolute", "turtlesim/srv/TeleportAbsolute", "{x: 11.0, y: 3.0}")
    running.ask("topic", "pub", "--once", "/turtle1/cmd_vel", TWIST, "{linear: {x: 10.0}}")
    running.run(0.5)
    assert pose(running)["x"] == pytest.approx(11.088889, abs=1e-6)
    assert message(sim)[2] == "Oh no! I hit the wall! (Clamping from [x=11.160000, y=8.088889])"


def test_turtles_can_be_spawned_killed_and_reset(running: System, sim: Program) -> None:
    spawn = partial(call, running, "/spawn", "turtlesim/srv/Spawn")
    assert "Spawn_Response(name='leo')" in spawn("{x: 2, y: 2, theta: 0.2, name: leo}")
    assert "Spawn_Response(name='')" in spawn("{name: leo}")
    assert "Spawn_Response(name='turtle2')" in spawn("{x: 1, y: 1}")
    assert pose(running, "leo")["theta"] == pytest.approx(0.2)
    call(running, "/kill", "turtlesim/srv/Kill", "{name: leo}")
    call(running, "/kill", "turtlesim/srv/Kill", "{name: leo}")
    assert "/leo/pose" not in running.ask("topic", "list").stdout
    call(running, "/reset", "std_srvs/srv/Empty")
    assert "/turtle2/pose" not in running.ask("topic", "list").stdout
    assert message(sim)[2:] == [
        "Spawning turtle [leo] at x=[2.000000], y=[2.000000], theta=[0.200000]",
        "A turtle named [leo] already exists",
        "Spawning turtle [turtle2] at x=[1.000000], y=[1.000000], theta=[0.000000]",
        "Tried to kill turtle [leo], which does not exist",
        "Resetting turtlesim.",
        "Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]",
    ]


def test_pen_and_clear_change_the_drawing(running: System, sim: Program) -> None:
    pen = partial(call, running, "/turtle1/set_pen", "turtlesim/srv/SetPen")
    jump = partial(call, running, "/turtle1/teleport_relative", "turtlesim/srv/TeleportRelative")

    def color() -> str:
        return running.ask("topic", "echo", "--once", "/turtle1/color_sensor").stdout.replace("\n", " ")

    assert color().startswith("r: 255 g: 255 b: 255")
    pen("{r: 10, g: 20, b: 30, width: 5}")
    jump("{linear: 1.0}")
    assert color().startswith("r: 10 g: 20 b: 30")
    call(running, "/clear", "std_srvs/srv/Empty")
    assert color().startswith("r: 255 g: 255 b: 255")
    pen("{'off': 1}")
    jump("{linear: 1.0}")
    assert color().startswith("r: 255 g: 255 b: 255")
    assert message(sim)[-1] == "Clearing turtlesim."


def test_rotations_are_goals(running: System, sim: Program) -> None:
    goal = "/turtle1/rotate_absolute", "turtlesim/action/RotateAbsolute"
    done = running.ask("action", "send_goal", *goal, "{theta: 1.57}", "--feedback")
    assert "Goal finished with status: SUCCEEDED" in done.stdout
    assert float(re.findall(r"delta: ([-\d.]+)", done.stdout)[0]) == pytest.approx(-1.552, abs=1e-3)
    assert len(re.findall("remaining:", done.stdout)) > 90
    first = running.ros2("action", "send_goal", *goal, "{theta: -1.57}")
    running.run(0.5)
    running.ask("topic", "pub", "--once", "/turtle1/cmd_vel", TWIST, "{}")
    running.finish(first)
    assert "Goal finished with status: ABORTED" in first.stdout
    second = running.ros2("action", "send_goal", *goal, "{theta: 3.0}")
    running.run(0.5)
    third = running.ask("action", "send_goal", *goal, "{theta: -0.5}")
    running.finish(second)
    assert "ABORTED" in second.stdout
    assert "SUCCEEDED" in third.stdout
    assert message(sim)[2:] == [
        "Rotation goal completed successfully",
        "Velocity command received during rotation goal. Aborting goal",
        "Rotation goal received before a previous goal finished. Aborting previous goal",
        "Rotation goal completed successfully",
    ]


def test_background_is_set_by_parameters(running: System, sim: Program) -> None:
    assert running.ask("param", "get", "/turtlesim", "background_r").stdout == "Integer value is: 69\n"
    described = running.ask("param", "describe", "/turtlesim", "background_b").stdout
    assert "Description: Blue channel of the background color" in described
    assert "Max value: 255" in described
    refused = running.ask("param", "set", "/turtlesim", "background_r", "256")
    assert "Set parameter successful" not in refused.stdout
    assert running.ask("param", "set", "/turtlesim", "background_r", "150").stdout == "Set parameter successful\n"


@pytest.mark.slow
def test_draw_square_draws_a_square(running: System, sim: Program) -> None:
    square = running.executable("turtlesim", "draw_square")
    running.run(40.0)
    goals = re.findall(r"New goal \[([-\d.]+) ([-\d.]+), ([-\d.]+)\]", square.stderr)
    corners = [(7.5, 5.5, 0.0), (7.45, 5.5, 1.57), (7.45, 7.5, 1.57), (7.45, 7.45, 3.14), (5.5, 7.45, 3.14)]
    for goal, corner in zip(goals, corners, strict=False):
        assert tuple(map(float, goal)) == pytest.approx(corner, abs=0.11)
    assert len(goals) > len(corners)
    assert message(sim)[2] == "Resetting turtlesim."


def test_mimic_follows_the_first_turtle(running: System, sim: Program) -> None:
    call(running, "/spawn", "turtlesim/srv/Spawn", "{x: 2, y: 2, name: ape}")
    remaps = ("-r", "input/pose:=turtle1/pose", "-r", "output/cmd_vel:=ape/cmd_vel")
    running.executable("turtlesim", "mimic", "--ros-args", *remaps)
    running.run(0.2)
    running.ask("topic", "pub", "--once", "/turtle1/cmd_vel", TWIST, "{linear: {x: 1.0}}")
    running.run(3.0)
    assert pose(running, "ape")["x"] - 2.0 == pytest.approx(pose(running)["x"] - 5.544445, abs=0.06)
    assert pose(running, "ape")["x"] > 2.9


def test_teleop_asks_for_a_keyboard(running: System) -> None:
    teleop = running.executable("turtlesim", "turtle_teleop_key")
    running.finish(teleop)
    assert teleop.exit == 1
    assert teleop.stderr.splitlines()[-1].endswith("bot-console run turtlesim turtle_teleop_key")
    assert "Traceback" not in teleop.stderr


def test_launch_file_starts_two_simulators(running: System) -> None:
    launched = running.ros2("launch", "turtlesim", "multisim.launch.py")
    running.run(5.0)
    assert running.ask("node", "list").stdout.split() == ["/turtlesim1/turtlesim", "/turtlesim2/turtlesim"]
    remap = ("/turtlesim2/turtle1/cmd_vel", TWIST, "{linear: {x: 1.0}}")
    running.ask("topic", "pub", "--once", *remap)
    running.run(2.0)
    assert pose(running, "turtlesim1/turtle1")["x"] == pytest.approx(5.544445)
    assert pose(running, "turtlesim2/turtle1")["x"] > 6.5
    launched.process.interrupt()
    running.finish(launched)


@pytest.mark.slow
def test_turtle_follows_another_by_its_frame(running: System) -> None:
    running.ros2("launch", "turtle_tf2_py", "turtle_tf2_demo_launch.py")
    running.run(5.0)
    call(running, "/turtle1/teleport_absolute", "turtlesim/srv/TeleportAbsolute", "{x: 9.0, y: 9.0}")
    running.run(20.0)
    second = pose(running, "turtle2")
    assert (second["x"], second["y"]) == pytest.approx((9.0, 9.0), abs=0.3)
