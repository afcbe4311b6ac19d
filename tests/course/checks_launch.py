"""Chapter 2 and the project: launch files, their parameters, arguments and remappings."""

from __future__ import annotations

import re
from pathlib import Path

import yaml
from course.page import Page, logs, message_of, stated
from course.rows import Row
from course.table import row
from systems import Program

PRINTED_NODES = {
    "navigator": {"speed": "1.5", "robot_name": "Navigator", "enable_safety": "True"},
    "sensor_handler": {"rate": "10.0", "threshold": "100"},
    "motion_controller": {},
}


def start_launch(page: Page, command: str) -> Program:
    """Start a launch and leave it running."""
    launch = page.start(command, 1.5)
    assert launch.exit is None, launch.output
    return launch


def nodes(page: Page) -> list[str]:
    return page.ask("ros2 node list").stdout.split()


def assert_values(page: Page, node: str, **values: str) -> None:
    assert {name: page.value(f"/{node}", name) for name in values} == values


@row(64)
def check_step_1_loads(page: Page, row: Row) -> None:
    launch = start_launch(page, page.row(65).command)
    assert nodes(page) == ["/my_robot"]
    assert ("INFO", "my_robot", "Robot initialized with speed: 1.0 m/s") in logs(launch)


@row(65, 69, 88, 106)
def check_command_launches(page: Page, row: Row) -> None:
    launch = start_launch(page, row.command)
    assert re.search(r"\[INFO\] \[\w+-1\]: process started with pid \[\d+\]", launch.stdout)
    assert page.stop(launch).exit is not None


@row(66, 67, alike=True)
def check_node_is_listed(page: Page, row: Row) -> None:
    start_launch(page, page.row(65).command)
    assert page.ask(page.row(66).command).stdout == f"{page.row(67).command}\n"


@row(60, 68, alike=True)
def check_step_2_gives_parameters(page: Page, row: Row) -> None:
    start_launch(page, page.row(69).command)
    assert_values(page, "explorer_bot", speed="2.0", robot_name="Explorer-1", enable_safety="True")


@row(70, 71, 72)
def check_output_of_step_2(page: Page, row: Row) -> None:
    launch = start_launch(page, page.row(69).command)
    assert message_of(launch, stated(row.command)) == 1
    assert f"[simple_robot_step2-1] [{stated(row.command).severity}] [" in launch.stdout


@row(59, 73, complete=True, alike=True)
def check_step_3_starts_three_nodes(page: Page, row: Row) -> None:
    start_launch(page, page.row(74).command)
    assert nodes(page) == sorted(f"/{each}" for each in PRINTED_NODES)
    for name, values in PRINTED_NODES.items():
        assert_values(page, name, **values)


def assert_missing(page: Page, command: str, executable: str) -> None:
    launch = page.ask(command)
    assert launch.exit == 1
    assert f"executable '{executable}' not found" in launch.stdout + launch.stderr


@row(74, 85)
def check_missing_executables_are_named(page: Page, row: Row) -> None:
    assert_missing(page, row.command, "sensor_processor")


@row(75, 76, 77, 78, complete=True)
def check_three_nodes_are_listed(page: Page, row: Row) -> None:
    """In alphabetical order, not in the page's (N9)."""
    start_launch(page, page.row(74).command)
    listed = page.ask(page.row(75).command).stdout.split()
    assert row.number == 75 or row.command in listed
    assert listed == sorted(listed)


FROM_FILE = {
    "navigator": {"speed": "2.0", "robot_name": "Navigator-Pro", "enable_safety": "True"},
    "sensor_handler": {"rate": "20.0", "threshold": "150", "filter_enabled": "True"},
    "motion_controller": {"kp_linear": "1.0", "kp_angular": "2.0", "max_acceleration": "0.5"},
}


@row(79, 80, complete=True, alike=True)
def check_step_4_gives_the_file_to_all_nodes(page: Page, row: Row) -> None:
    start_launch(page, page.row(85).command)
    for name, values in FROM_FILE.items():
        assert_values(page, name, **values)


@row(86)
def check_step_5_has_arguments(page: Page, row: Row) -> None:
    start_launch(page, page.row(88).command)
    assert_values(page, "configurable_robot", speed="1.0", robot_name="MyRobot", enable_safety="True")


@row(87, 89, alike=True)
def check_arguments_are_overridden(page: Page, row: Row) -> None:
    start_launch(page, page.row(89).command)
    assert_values(page, "configurable_robot", speed="3.0", robot_name="SpeedRacer", enable_safety="False")


@row(90, 91, 92, 93, 94)
def check_arguments_are_shown(page: Page, row: Row) -> None:
    """The text is that of real ROS 2, including what the page omits (N10)."""
    shown = page.ask(page.row(90).command)
    assert (shown.exit, shown.stderr) == (0, "")
    assert shown.stdout.startswith("Arguments (pass arguments as '<name>:=<value>'):\n")
    if row.number > 91:
        words = re.split(r": | \(default: ", row.command.rstrip(")"))
        name, text, default = words[0], words[1], words[2]
        assert re.search(rf"    {name}:\n        {re.escape(text)}\n        \(default: {default}\)\n", shown.stdout)


@row(95)
def check_basic_file_loads(page: Page, row: Row) -> None:
    start_launch(page, "ros2 launch my_package basic_launch.py")
    assert_values(page, "robot_node", max_speed="2.0", safety_distance="0.5")


@row(96, 105, complete=True, alike=True)
def check_system_loads(page: Page, row: Row) -> None:
    """The configuration file has another key, so the defaults stay (N7)."""
    start_launch(page, page.row(105).command)
    assert nodes(page) == ["/controller", "/planner", "/robot_navigator", "/sensor_handler"]
    assert_values(page, "robot_navigator", max_speed="1.0")
    shown = page.ask(f"{page.row(105).command} --show-args").stdout
    assert "    'use_sim_time':\n        Use simulation clock if true\n        (default: 'false')\n" in shown
    assert re.search(r"    'config_file':\n        .*\n        \(default: '.*robot_config.yaml'\)\n", shown)


NAMESPACES = """from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import Node, PushRosNamespace

def robot(namespace):
    return Node(package='my_package', executable='configurable_robot', namespace=namespace,
                remappings=[('/cmd_vel', 'drive'), ('/scan', '/lidar')])

def generate_launch_description():
    return LaunchDescription([robot('one'), GroupAction([PushRosNamespace('fleet'), robot('two')])])
"""


@row(61)
def check_namespaces_and_remappings_are_configured(page: Page, row: Row) -> None:
    """No listing of the page has a namespace: two of its robots in different namespaces drive on separate topics."""
    file = page.scratch / "namespaces.launch.py"
    file.write_text(NAMESPACES, "utf-8")
    start_launch(page, f"ros2 launch {file}")
    assert nodes(page) == ["/fleet/two/configurable_robot", "/one/configurable_robot"]
    topics = page.ask("ros2 topic list").stdout.split()
    assert {"/one/drive", "/fleet/two/drive", "/lidar"} <= set(topics)
    assert not {"/cmd_vel", "/scan", "/drive"} & set(topics)


@row(97, complete=True)
def check_topics_are_remapped(page: Page, row: Row) -> None:
    start_launch(page, page.row(105).command)
    info = page.ask("ros2 node info /robot_navigator").stdout
    assert "    /robot/scan: sensor_msgs/msg/LaserScan\n" in info
    assert "    /robot/cmd_vel: geometry_msgs/msg/Twist\n" in info
    assert " /cmd_vel:" not in info


@row(98, complete=True)
def check_each_node_gets_its_own_parameters(page: Page, row: Row) -> None:
    launch = start_launch(page, page.row(105).command)
    assert_values(page, "sensor_handler", detection_threshold="100", update_rate="10.0")
    assert_values(page, "planner", algorithm="A*", resolution="0.05")
    command = next(
        line for line in page.stop(launch).stdout.splitlines() if "motion_controller-4" in line and "cmd '" in line
    )
    assert re.search(r"--params-file \S*robot_config.yaml", command)


VALUES = ("max_speed", "safety_distance", "detection_threshold", "enable_safety")


@row(99, 100, 101, 102, 103, 104)
def check_environment_selects_the_values(page: Page, row: Row) -> None:
    name = re.match(r"environment (\w+): .* = (.*)", row.text)
    environment = name[1] if name else "indoor" if row.number == 99 else "moon"
    stated = name or re.match(r"environment (\w+): .* = (.*)", page.row(100).text)
    assert stated is not None
    argument = "" if row.number == 99 else f" environment:={environment}"
    start_launch(page, f"ros2 launch my_package multi_environment_launch.py{argument}")
    assert_values(page, f"robot_{environment}", **dict(zip(VALUES, stated[2].split(", "), strict=True)))


@row(107, complete=True)
def check_missing_file_keeps_the_defaults(page: Page, row: Row) -> None:
    """Real launch warns and starts the nodes (N11)."""
    launch = start_launch(page, row.command)
    assert "Parameter file path is not a file: /path/to/custom_config.yaml" in "".join(
        each for _, each in launch.output
    )
    assert_values(page, "robot_navigator", max_speed="1.0")


@row(108)
def check_launch_files_are_listed_without_a_file(page: Page, row: Row) -> None:
    """As the page says; real ROS 2 refuses (N12)."""
    answer = page.ask(row.command)
    assert answer.exit == 0
    assert ".launch.py" in answer.stdout


PROJECT = ("robot_navigator", "sensor_handler", "safety_monitor", "telemetry_publisher")


def launch_all_four_nodes(page: Page, command: str) -> Program:
    launch = start_launch(page, command)
    assert {f"/{each}" for each in PROJECT} <= set(nodes(page))
    return launch


@row(268, complete=True)
def check_launch_file_of_the_project_gives_all_nodes_the_file(page: Page, row: Row) -> None:
    launch_all_four_nodes(page, page.row(272).command)
    assert nodes(page) == sorted(f"/{each}" for each in PROJECT)
    assert_values(page, "robot_navigator", detection_threshold="150", robot_name="IndoorBot")
    assert_values(page, "safety_monitor", emergency_stop_distance="0.3", warning_distance="0.7")


_listed: list[str] = []
"""The nodes that the page's command names while our system runs."""


@row(272, 274, 275, 276, 277, 278, 279, own=True)
def check_our_system_has_the_nodes_of_the_project(page: Page, row: Row) -> None:
    """Launched once for all rows."""
    if not _listed:
        launch_all_four_nodes(page, page.row(274).command)
        _listed.extend(page.ask(page.row(275).command).stdout.split())
    assert row.number < 276 or row.command in _listed


@row(185, complete=True)
def check_whole_system_is_launched_for_the_tools(page: Page, row: Row) -> None:
    launch = launch_all_four_nodes(page, page.row(272).command)
    for name in PROJECT:
        assert page.ask(f"ros2 param list /{name}").stdout.strip(), f"{name} cannot be tuned"
    assert "robot_navigator" in {each.logger for each in logs(launch)}, "the console has nothing to show of it"


@row(324, own=True)
def check_our_system_is_launched_for_the_tools(page: Page, row: Row) -> None:
    launch = launch_all_four_nodes(page, "ros2 launch intelligent_robot multi_node_system.launch.py")
    assert launch.exit is None and {each.logger for each in logs(launch)} >= {*PROJECT}
    moving = page.ask("ros2 topic echo /odom --field twist.twist.linear.x", stop_after=3.0).stdout
    assert any(float(each) > 0.1 for each in moving.replace("---", "").split()), "the robot stands: nothing to plot"


@row(273, 285, 286, 287, 288, own=True)
def check_environment_is_switched(page: Page, row: Row) -> None:
    """The file is looked for where the command runs (N11): beside the share folder's `config`."""
    page.work_in(page.ask("ros2 pkg prefix --share intelligent_robot").stdout.strip())
    launch = launch_all_four_nodes(page, row.command)
    assert "is not a file" not in "".join(each for _, each in launch.output)
    file = row.command.partition(":=")[2]
    stated = yaml.safe_load(Path(file).read_text("utf-8"))["robot_navigator"]["ros__parameters"]
    assert page.value("/robot_navigator", "robot_name") == stated["robot_name"]


@row(295, 296, 297, 298, 333, 347, own=True, alike=True)
def check_our_launch_file_starts_the_node(page: Page, row: Row) -> None:
    launch_all_four_nodes(page, "ros2 launch intelligent_robot robot_system.launch.py")


@row(321, 322, 323, own=True)
def check_launch_file_exists(page: Page, row: Row) -> None:
    name = re.search(r"[\w.]+\.py", row.text)
    assert name is not None
    start_launch(page, f"ros2 launch intelligent_robot {name[0]}")
    assert "/robot_navigator" in nodes(page)
