"""Chapter 1, from step 4 to the exercise: a robot that is tuned while it runs, and parameter files."""

from __future__ import annotations

from pathlib import Path

from course.checks_parameters import run_row
from course.page import Page, logs
from course.rows import Row
from course.table import row
from systems import Program

NODE = "/configurable_robot"
EXERCISE = Path(__file__).parent / "exercise_robot.py"


def start_robot(page: Page) -> Program:
    return page.node_file("configurable_robot.py")


@row(40)
def check_robot_runs_as_printed(page: Page, row: Row) -> None:
    robot = start_robot(page)
    defaults = {"max_speed": "1.0", "safety_distance": "0.5", "detection_threshold": "100", "enable_safety": "True"}
    assert {name: page.value(NODE, name) for name in defaults} == defaults
    info = page.ask(f"ros2 node info {NODE}").stdout
    assert "/cmd_vel: geometry_msgs/msg/Twist" in info
    assert "/scan: sensor_msgs/msg/LaserScan" in info
    assert ("INFO", "configurable_robot", row.quoted[-1]) in logs(robot)


@row(41, 42, 43)
def check_number_is_changed(page: Page, row: Row) -> None:
    robot = start_robot(page)
    name, value = {41: ("max_speed", "2.5"), 42: ("safety_distance", "0.9"), 43: ("detection_threshold", "42")}[
        row.number
    ]
    page.ask(f"ros2 param set {NODE} {name} {value}")
    assert logs(robot)[-1].message == row.command.replace("<v>", value)


@row(44)
def check_safety_is_switched(page: Page, row: Row) -> None:
    robot = start_robot(page)
    for value, text in zip(("true", "false"), row.quoted, strict=True):
        page.ask(f"ros2 param set {NODE} enable_safety {value}")
        assert logs(robot)[-1].message == text


def speed_after_scan(page: Page, nearest: float) -> str:
    """`linear.x` of the robot's response to a scan."""
    echo = page.start("ros2 topic echo /cmd_vel --once --field linear.x")
    page.ask(f"ros2 topic pub --once /scan sensor_msgs/msg/LaserScan '{{ranges: [3.0, {nearest}]}}'")
    return echo.stdout.splitlines()[0]


@row(45)
def check_robot_stops_before_an_obstacle(page: Page, row: Row) -> None:
    robot = start_robot(page)
    assert speed_after_scan(page, 0.25) == "0.0"
    assert logs(robot)[-1] == ("WARN", "configurable_robot", row.quoted[1].replace("<d, 2 decimals>", "0.25"))


@row(46)
def check_robot_drives_on_without_an_obstacle(page: Page, row: Row) -> None:
    start_robot(page)
    page.ask(f"ros2 param set {NODE} max_speed 1.5")
    assert speed_after_scan(page, 2.0) == "1.5"
    page.ask(f"ros2 param set {NODE} enable_safety false")
    assert speed_after_scan(page, 0.25) == "1.5"


@row(48)
def check_parameters_are_listed(page: Page, row: Row) -> None:
    run_row(page, 47)
    listed = page.ask(row.command).stdout.split()
    assert {"max_speed", "safety_distance", "detection_threshold", "enable_safety"} <= set(listed)


@row(49)
def check_value_of_the_command_line_is_set(page: Page, row: Row) -> None:
    """The value in the node, which includes later changes."""
    run_row(page, 47)
    assert page.ask(row.command).stdout == "Double value is: 2.5\n"
    assert page.ask(row.command.replace("max_speed", "safety_distance")).stdout == "Double value is: 0.8\n"
    page.ask(f"ros2 param set {NODE} max_speed 1.25")
    assert page.ask(row.command).stdout == "Double value is: 1.25\n"


@row(50)
def check_value_is_set(page: Page, row: Row) -> None:
    run_row(page, 47)
    assert page.ask(row.command).stdout == "Set parameter successful\n"
    assert page.ask(page.row(49).command).stdout == "Double value is: 3.0\n"


@row(51)
def check_dump_has_no_such_option(page: Page, row: Row) -> None:
    """As in current ROS 2 (N6); without the option the parameters are printed."""
    run_row(page, 47)
    answer = page.ask(row.command)
    assert answer.exit == 2
    assert "unrecognized arguments: --output-dir" in answer.stderr
    assert "max_speed: 2.5" in page.ask(row.command.partition(" --output-dir")[0]).stdout


@row(52)
def check_file_loads(page: Page, row: Row) -> None:
    """A name that the node does not declare is ignored (N7)."""
    run_row(page, 53)
    stated = {"max_speed": "2.0", "safety_distance": "0.6", "detection_threshold": "120", "enable_safety": "True"}
    assert {name: page.value(NODE, name) for name in stated} == stated
    assert page.ask(f"ros2 param get {NODE} robot_name").stderr == "Parameter not set\n"


def exercise(page: Page) -> None:
    assert page.start_file(EXERCISE).exit is None


@row(54, 55, 56, 57)
def check_exercise_declares_the_parameter(page: Page, row: Row) -> None:
    exercise(page)
    name, kind = {
        54: ("robot_name", "string"),
        55: ("max_speed", "double"),
        56: ("turn_rate", "double"),
        57: ("autonomous_mode", "boolean"),
    }[row.number]
    described = page.ask(f"ros2 param describe /exercise_robot {name}").stdout
    assert f"  Type: {kind}\n" in described
    assert ("Min value: 0.1\n    Max value: 5.0" in described) == (row.number == 55)


@row(58)
def check_exercise_is_changed_at_runtime(page: Page, row: Row) -> None:
    exercise(page)
    for name, value in (("robot_name", "Ada"), ("max_speed", "4.5"), ("turn_rate", "0.3"), ("autonomous_mode", "true")):
        assert page.ask(f"ros2 param set /exercise_robot {name} {value}").stdout == "Set parameter successful\n"
    refused = page.ask("ros2 param set /exercise_robot max_speed 5.5").stderr
    assert refused.startswith("Setting parameter failed: Parameter max_speed out of range Min: 0.1, Max: 5.0")
