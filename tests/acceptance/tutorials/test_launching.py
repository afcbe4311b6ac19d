"""Launch files of the tutorials: two simulators, a mimic between them, arguments, events and timers.

Also a project of several files in all three languages, with namespaces, parameter files and an added frame.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from systems import System, system

TWIST = "geometry_msgs/msg/Twist"
LAUNCH_FILE = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, LogInfo, RegisterEventHandler, TimerAction
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit, OnProcessStart
from launch.substitutions import FindExecutable, LaunchConfiguration, PythonExpression
from launch_ros.actions import Node


def generate_launch_description():
    red = LaunchConfiguration("red")
    leader = Node(package="turtlesim", namespace="leader", executable="turtlesim_node", name="sim")
    follower = Node(package="turtlesim", namespace="follower", executable="turtlesim_node", name="sim")
    mimic = Node(
        package="turtlesim",
        executable="mimic",
        remappings=[("/input/pose", "/leader/turtle1/pose"), ("/output/cmd_vel", "/follower/turtle1/cmd_vel")],
    )
    repaint = ExecuteProcess(
        cmd=[[FindExecutable(name="ros2"), " param set /follower/sim background_r ", red]], shell=True,
        condition=IfCondition(PythonExpression([red, " <= 255"])),
    )
    return LaunchDescription([
        DeclareLaunchArgument("red", default_value="120", description="How red the follower's field is"),
        leader, follower, mimic,
        RegisterEventHandler(OnProcessStart(target_action=follower, on_start=[LogInfo(msg="the follower is up")])),
        RegisterEventHandler(OnProcessExit(target_action=repaint, on_exit=[LogInfo(msg=["painted ", red])])),
        TimerAction(period=2.0, actions=[repaint]),
    ])
"""

PROJECT = {
    "project.launch.xml": """
        <launch>
          <arg name="target" default="turtle1"/>
          <include file="$(dirname)/world.launch.yaml"><arg name="red" value="200"/></include>
          <group>
            <push_ros_namespace namespace="second"/>
            <include file="$(dirname)/world.launch.yaml"><arg name="red" value="10"/></include>
          </group>
          <include file="$(dirname)/frames.launch.py"><arg name="target_frame" value="$(var target)"/></include>
        </launch>
    """.strip(),
    "world.launch.yaml": """
launch:
- arg: {name: red}
- node:
    pkg: turtlesim
    exec: turtlesim_node
    name: sim
    param:
    - from: $(dirname)/world.yaml
    - {name: background_r, value: $(var red)}
""",
    "world.yaml": "/**: {ros__parameters: {background_r: 1, background_g: 2}}",
    "frames.launch.py": """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch_ros.actions import Node


def broadcaster(name):
    turtle = [TextSubstitution(text="turtle"), name]
    return Node(package="turtle_tf2_py", executable="turtle_tf2_broadcaster", name=["of_", name],
                parameters=[{"turtlename": turtle}])


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("target_frame", choices=["turtle1", "carrot1"]),
        broadcaster("1"),
        broadcaster("2"),
        Node(package="tf2_ros", executable="static_transform_publisher",
             arguments=["--y", "2", "--frame-id", "turtle1", "--child-frame-id", "carrot1"]),
        Node(package="turtle_tf2_py", executable="turtle_tf2_listener",
             parameters=[{"target_frame": LaunchConfiguration("target_frame")}]),
    ])
""",
}


@pytest.fixture
def running() -> Iterator[System]:
    with system() as found:
        yield found


def pose(running: System, who: str, turtle: str = "turtle1") -> list[float]:
    text = running.ask("topic", "echo", "--once", f"/{who}/{turtle}/pose".replace("//", "/")).stdout
    return [float(re.findall(rf"^{axis}: ([-\d.e]+)", text, re.M)[0]) for axis in ("x", "y", "theta")]


def test_mimic_runs_between_two_simulators(running: System, tmp_path: Path) -> None:
    file = tmp_path / "mimic.launch.py"
    file.write_text(LAUNCH_FILE)
    launched = running.ros2("launch", str(file), "red:=240")
    running.run(1.0)
    words = ("/leader/turtle1/cmd_vel", TWIST, "{linear: {x: 2.0}, angular: {z: -1.8}}")
    running.ask("topic", "pub", "--once", *words)
    running.run(3.0)
    assert pose(running, "follower") == pytest.approx(pose(running, "leader"), abs=0.1)
    assert pose(running, "follower")[0] > 6.0
    assert "the follower is up" in launched.stderr + launched.stdout
    assert "painted 240" in launched.stderr + launched.stdout
    assert running.ask("param", "get", "/follower/sim", "background_r").stdout == "Integer value is: 240\n"
    assert running.ask("param", "get", "/leader/sim", "background_r").stdout == "Integer value is: 69\n"


def test_arguments_are_shown(running: System, tmp_path: Path) -> None:
    file = tmp_path / "mimic.launch.py"
    file.write_text(LAUNCH_FILE)
    shown = running.ask("launch", str(file), "--show-args").stdout
    assert "'red':" in shown and "How red the follower's field is" in shown and "(default: '120')" in shown


@pytest.mark.slow
def test_project_of_several_files_runs(running: System, tmp_path: Path) -> None:
    for name, text in PROJECT.items():
        (tmp_path / name).write_text(text)
    running.ros2("launch", str(tmp_path / "project.launch.xml"), "target:=carrot1")
    running.run(25.0)
    colours = {
        (name, colour): running.ask("param", "get", name, f"background_{colour}").stdout.split()[-1]
        for name in ("/sim", "/second/sim")
        for colour in "rg"
    }
    assert list(colours.values()) == ["200", "2", "10", "2"]
    x, y, _ = pose(running, "")
    assert pose(running, "", "turtle2")[:2] == pytest.approx([x, y + 2.0], abs=0.2)
