"""The project: a robot with six parameters, its package, its configuration."""

from __future__ import annotations

import re

from course.checks_parameters import run_row
from course.page import Page, logs
from course.rows import COURSE, Row
from course.table import row
from systems import Program

NODE = "/robot_navigator"
DEFAULTS = {
    "max_speed": "1.0",
    "safety_distance": "0.5",
    "detection_threshold": "100",
    "turn_rate": "1.0",
    "enable_safety": "True",
    "robot_name": "IntelligentRobot",
}


def robot(page: Page, seconds: float = 0.5) -> Program:
    return page.node_file("intelligent_robot/robot_node.py", seconds=seconds)


def logged(program: Program) -> list[str]:
    return [each.message for each in logs(program)]


@row(224, 309)
def check_package_is_created(page: Page, row: Row) -> None:
    answer = page.ask(f"{row.command} --destination-directory {page.scratch}")
    assert (answer.exit, answer.stderr) == (0, "")
    folder = page.scratch / "intelligent_robot"
    files = {str(each.relative_to(folder)) for each in folder.rglob("*") if each.is_file()}
    assert {
        "package.xml",
        "setup.py",
        "setup.cfg",
        "resource/intelligent_robot",
        "intelligent_robot/__init__.py",
    } <= files
    manifest = (folder / "package.xml").read_text("utf-8")
    wanted = row.command.partition("--dependencies ")[2].split()
    assert re.findall(r"<depend>(\w+)</depend>", manifest) == wanted


@row(231, 232, 233, 234, 235)
def check_setup_file_is_read(page: Page, row: Row) -> None:
    names = page.ask("ros2 pkg executables intelligent_robot").stdout.split()[1::2]
    assert names == sorted(["robot_node", "sensor_node", "safety_node", "telemetry_node"])
    if row.number == 231:
        share = page.ask("ros2 pkg prefix --share intelligent_robot").stdout.strip()
        listed = page.python(f"import os; print(sorted(os.listdir({share!r})))").stdout
        assert all(f"'{each}'" in listed for each in ("config", "launch", "package.xml"))
        assert page.ask("ros2 pkg xml intelligent_robot -t version").stdout == "0.0.1\n"
    else:
        assert row.command.partition(" = ")[0] in names


@row(236)
def check_project_robot_runs_as_printed(page: Page, row: Row) -> None:
    """After Ctrl-C its `finally` shuts down a second time, as on real ROS 2 (N27)."""
    started = robot(page)
    info = page.ask(f"ros2 node info {NODE}").stdout
    assert "/cmd_vel: geometry_msgs/msg/Twist" in info.partition("Publishers:")[2]
    assert "/scan: sensor_msgs/msg/LaserScan" in info.partition("Publishers:")[0]
    assert page.stop(started).exit == 1
    assert "rcl_shutdown already called" in started.stderr


@row(237, 238, 239, 240, 241, 242)
def check_parameter_has_default_and_description(page: Page, row: Row) -> None:
    robot(page)
    name = row.command
    description = re.search(r'description "(.*)"', row.text)
    assert description is not None
    assert f"defaults to {page.value(NODE, name)}, " in row.text
    assert f"  Description: {description[1]}\n" in page.ask(f"ros2 param describe {NODE} {name}").stdout


@row(243)
def check_robot_introduces_itself(page: Page, row: Row) -> None:
    assert logged(robot(page)) == row.quoted


CHANGES = {
    "max_speed": ("2.5", "10.0"),
    "safety_distance": ("0.8", "5.0"),
    "detection_threshold": ("42", "300"),
    "turn_rate": ("2.0", "0.05"),
    "robot_name": ("Ada", "''"),
}


@row(244, 246, 248, 250, 252)
def check_good_value_is_accepted(page: Page, row: Row) -> None:
    started = robot(page)
    name = re.match(r"\w+", row.text)
    assert name is not None
    value = CHANGES[name[0]][0]
    assert page.ask(f"ros2 param set {NODE} {name[0]} {value}").stdout == "Set parameter successful\n"
    assert logged(started)[-1] == row.command.replace("<v>", value)
    assert page.value(NODE, name[0]) == value


@row(245, 247, 249, 251, 253)
def check_bad_value_is_refused(page: Page, row: Row) -> None:
    robot(page)
    name = re.match(r"\w+", row.text)
    assert name is not None
    value = CHANGES[name[0]][1]
    refused = page.ask(f"ros2 param set {NODE} {name[0]} {value}").stderr
    assert refused == f"Setting parameter failed: {row.command.replace('<v>', value)}\n"
    assert page.value(NODE, name[0]) == DEFAULTS[name[0]]


@row(254)
def check_safety_is_reported(page: Page, row: Row) -> None:
    started = robot(page)
    for value, text in zip(("true", "false"), row.quoted, strict=True):
        page.ask(f"ros2 param set {NODE} enable_safety {value}")
        assert logs(started)[-1] == ("WARN", "robot_navigator", text)


def response_to_scan(page: Page, *ranges: float) -> list[str]:
    """`linear.x` and `angular.z` of the answer to a scan; empty if there is none."""
    echo = page.start("ros2 topic echo /cmd_vel --csv")
    page.ask(f"ros2 topic pub --once /scan sensor_msgs/msg/LaserScan '{{ranges: {list(ranges)}}}'")
    answer = page.stop(echo).stdout.strip().split(",")
    return [answer[0], answer[5]] if len(answer) == 6 else []


@row(255)
def check_robot_turns_before_an_obstacle(page: Page, row: Row) -> None:
    started = robot(page)
    assert response_to_scan(page, 3.0, 0.25) == ["0.0", "1.0"]
    text = row.quoted[-1].replace("<d, 2 decimals>", "0.25")
    assert ("WARN", "robot_navigator", text) in logs(started)


@row(256)
def check_robot_drives_without_an_obstacle(page: Page, row: Row) -> None:
    robot(page)
    assert response_to_scan(page, 3.0, 2.0) == ["1.0", "0.0"]


@row(257)
def check_ranges_of_zero_are_ignored(page: Page, row: Row) -> None:
    robot(page)
    assert response_to_scan(page, 0.0, 2.0) == ["1.0", "0.0"]
    assert response_to_scan(page, 0.0, -1.0) == []


@row(258)
def check_status_is_reported_each_second(page: Page, row: Row) -> None:
    started = robot(page, 2.5)
    safe = row.quoted[0].replace("<robot_name>", "IntelligentRobot").replace("<v>", "1.0").replace("\\\\", "")
    assert logged(started).count(safe) == 2
    page.ask(f"ros2 param set {NODE} enable_safety false")
    page.run(1.0)
    assert row.quoted[1] in logged(started)[-1]


@row(262, 263)
def check_command_starts_the_robot(page: Page, row: Row) -> None:
    started = run_row(page, row.number)
    assert page.ask("ros2 node list").stdout == f"{NODE}\n"
    name = "Explorer" if row.number == 263 else "IntelligentRobot"
    assert logged(started)[0].endswith(f"{name} initialized!")


SECTION = re.compile(r"^(\w+):$", re.MULTILINE)
ANY = """import rclpy
rclpy.init(args=['n', '--ros-args', '--params-file', {file!r}])
rclpy.spin(rclpy.create_node({name!r}, automatically_declare_parameters_from_overrides=True))"""
INDOOR = {
    "robot_navigator": {"detection_threshold": "150", "turn_rate": "1.0", "robot_name": "IndoorBot"},
    "sensor_handler": {"update_rate": "10.0", "filter_enabled": "True"},
    "safety_monitor": {"emergency_stop_distance": "0.3", "warning_distance": "0.7"},
    "telemetry_publisher": {"publish_rate": "1.0", "include_diagnostics": "True"},
}


@row(264)
def check_indoor_file_loads(page: Page, row: Row) -> None:
    file = COURSE / "config" / "indoor_config.yaml"
    assert SECTION.findall(file.read_text("utf-8")) == list(INDOOR)
    for name, values in INDOOR.items():
        page.python(ANY.format(file=str(file), name=name))
        assert {key: page.value(f"/{name}", key) for key in values} == values


@row(280)
def check_parameters_of_the_robot_are_listed(page: Page, row: Row) -> None:
    run_row(page, 262)
    assert set(DEFAULTS) <= set(page.ask(row.command).stdout.split())


@row(281)
def check_valid_speed_is_set(page: Page, row: Row) -> None:
    run_row(page, 262)
    assert page.ask(row.command).stdout == "Set parameter successful\n"


@row(282)
def check_excessive_speed_is_refused(page: Page, row: Row) -> None:
    run_row(page, 262)
    assert page.ask(row.command).stderr == "Setting parameter failed: Speed must be 0.1-5.0, got 10.0\n"
