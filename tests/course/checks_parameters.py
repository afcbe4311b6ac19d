"""Chapter 1: parameters of one node, set at the start, at runtime and from files."""

from __future__ import annotations

import re

from course.page import Page, logs, message_of, stated
from course.rows import Row
from course.table import row
from systems import Program

STEP_1, STEP_2, STEP_3 = 13, 22, 33
"""The rows with the commands that start the first three robots."""


def run_row(page: Page, number: int, seconds: float = 0.5) -> Program:
    """Start the command of a row and leave it running; it must not print a traceback."""
    program = page.start(page.row(number).command, seconds)
    assert program.exit is None, program.stderr
    return program


def log(severity: str, text: str, logger: str = "simple_robot") -> tuple[str, str, str]:
    return (severity, logger, text)


@row(6)
def check_same_code_drives_at_another_speed(page: Page, row: Row) -> None:
    for number, speed in ((13, "1.0"), (16, "2.5")):
        robot = run_row(page, number, 2.5)
        assert log("INFO", f"Moving at {speed} m/s") in logs(robot)
        page.stop(robot)


ANY_NODE = """import rclpy
rclpy.init(args=['any', '--ros-args', '--params-file', {file!r}])
rclpy.spin(rclpy.create_node('any', automatically_declare_parameters_from_overrides=True))"""
WORDS = {"bool": "Boolean value", "int": "Integer value", "double": "Double value", "string": "String value"}


@row(7, 8, 9, 10, 11)
def check_example_of_each_type_has_that_type(page: Page, row: Row) -> None:
    kind, example = row.quoted
    file = page.scratch / "example.yaml"
    file.write_text(f"any:\n  ros__parameters:\n    {example}\n", "utf-8")
    page.python(ANY_NODE.format(file=str(file)))
    name, value = example.split(": ")
    message = page.ask(f"ros2 param get /any {name}").stdout
    word, shown = message.strip().split(" is: ") if kind != "array" else message.strip().split(" are: ")
    assert word == WORDS.get(kind, "Double values")
    assert value.strip('"') in (shown, shown.lower()) or f"array('d', {value})" == shown


def start_as_printed(page: Page, name: str, period: float, **parameters: str) -> Program:
    """Run a listing for two periods (s) of its timer; its parameters have these values."""
    robot = page.node_file(f"{name}.py", seconds=2 * period + 0.1)
    for parameter, value in parameters.items():
        assert page.value("/simple_robot", parameter) == value
    stamps = [float(each) for each in re.findall(r"\[(\d{10}\.\d{9})\]", robot.stderr)][-2:]
    assert abs(stamps[1] - stamps[0] - period) < 0.01
    return robot


@row(12)
def check_step_1_runs_as_printed(page: Page, row: Row) -> None:
    start_as_printed(page, "simple_robot_step1", 2.0, speed="1.0")


STARTED: dict[int, tuple[str, dict[str, str]]] = {
    13: ("/simple_robot", {"speed": "1.0"}),
    16: ("/simple_robot", {"speed": "2.5"}),
    22: ("/simple_robot", {"speed": "3.0", "robot_name": "Explorer", "enable_safety": "False"}),
    33: ("/simple_robot", {"speed": "1.0", "robot_name": "MyRobot", "enable_safety": "True"}),
    47: ("/configurable_robot", {"max_speed": "2.5", "safety_distance": "0.8", "detection_threshold": "150"}),
    53: ("/configurable_robot", {"max_speed": "2.0", "safety_distance": "0.6", "detection_threshold": "120"}),
    133: ("/simple_robot", {"speed": "1.0", "robot_name": "TestBot", "enable_safety": "True"}),
}
"""The node that a command starts, with all parameters given on the command line and in files, and defaults."""


@row(*STARTED)
def check_command_starts_the_node_with_every_value(page: Page, row: Row) -> None:
    run_row(page, row.number)
    node, values = STARTED[row.number]
    assert page.ask("ros2 node list").stdout == f"{node}\n"
    assert {name: page.value(node, name) for name in values} == values


@row(145)
def check_command_starts_the_publisher(page: Page, row: Row) -> None:
    run_row(page, row.number)
    assert page.ask("ros2 node list").stdout == "/data_publisher\n"
    message = page.ask("ros2 topic echo /robot_speed --field data", stop_after=1.0).stdout.replace("---", "").split()
    assert len(message) >= 9
    assert all(1.0 <= float(each) <= 3.0 for each in message)


@row(14)
def check_default_start(page: Page, row: Row) -> None:
    assert message_of(run_row(page, STEP_1), stated(row.command)) == 1


@row(15)
def check_default_moves(page: Page, row: Row) -> None:
    assert message_of(run_row(page, STEP_1, 5.0), stated(row.command)) == 2


@row(17, 18)
def check_custom_speed(page: Page, row: Row) -> None:
    assert message_of(run_row(page, 16, 3.0), stated(row.command)) == 1


@row(19)
def check_step_2_runs_as_printed(page: Page, row: Row) -> None:
    start_as_printed(page, "simple_robot_step2", 2.0, speed="1.0", robot_name="MyRobot", enable_safety="True")
    described = page.ask("ros2 param describe /simple_robot speed robot_name enable_safety").stdout
    assert described.count("  Description: ") == 3


@row(20, 21)
def check_output_of_step_2(page: Page, row: Row) -> None:
    robot = page.node_file("simple_robot_step2.py", seconds=3.0)
    for text in row.quoted:
        assert log("INFO", text) in logs(robot)


@row(23)
def check_step_2_with_other_values(page: Page, row: Row) -> None:
    robot = run_row(page, STEP_2, 3.0)
    for text in row.quoted:
        assert log("INFO", text) in logs(robot)


@row(24)
def check_describe_answers(page: Page, row: Row) -> None:
    run_row(page, STEP_2)
    answer = page.ask(row.command)
    assert (answer.exit, answer.stderr) == (0, "")


@row(25, 26, 27, 28)
def check_output_of_describe(page: Page, row: Row) -> None:
    run_row(page, STEP_2)
    assert row.command in [line.strip() for line in page.ask(page.row(24).command).stdout.splitlines()]


@row(29)
def check_step_3_runs_as_printed(page: Page, row: Row) -> None:
    robot = start_as_printed(page, "simple_robot_step3", 2.0, speed="1.0", robot_name="MyRobot", enable_safety="True")
    for text in row.quoted[4:]:
        assert log("INFO", text) in logs(robot)


@row(30)
def check_empty_name_is_refused(page: Page, row: Row) -> None:
    robot = run_row(page, STEP_3)
    assert page.ask("ros2 param set /simple_robot robot_name ''").stderr.endswith(f"{row.quoted[1]}\n")
    assert log("ERROR", row.quoted[1]) in logs(robot)


@row(31)
def check_name_is_accepted(page: Page, row: Row) -> None:
    robot = run_row(page, STEP_3)
    page.ask("ros2 param set /simple_robot robot_name Scout")
    assert log("INFO", row.quoted[1].replace("<name>", "Scout")) in logs(robot)


@row(32)
def check_safety_is_reported(page: Page, row: Row) -> None:
    robot = run_row(page, STEP_3)
    for value, text in (("true", row.quoted[1]), ("false", row.quoted[2])):
        page.ask(f"ros2 param set /simple_robot enable_safety {value}")
        assert logs(robot)[-1] == log("WARN", text)


@row(34, 37)
def check_only_the_value_within_the_range_is_set(page: Page, row: Row) -> None:
    run_row(page, STEP_3)
    answer = page.ask(row.command)
    if row.number == 34:
        assert (answer.stdout, page.value("/simple_robot", "speed")) == ("", "1.0")
        assert answer.stderr == "Setting parameter failed: Speed must be between 0.1 and 5.0, got 10.0\n"
    else:
        assert (answer.stdout, answer.stderr) == ("Set parameter successful\n", "")
        assert page.value("/simple_robot", "speed") == "2.5"


@row(35, 38)
def check_set_is_logged(page: Page, row: Row) -> None:
    robot = run_row(page, STEP_3)
    page.ask(page.row(row.number - 1).command)
    assert message_of(robot, stated(row.command)) == 1


@row(36)
def check_refused_value_is_reported(page: Page, row: Row) -> None:
    """The text is that of real ROS 2 (N4)."""
    run_row(page, STEP_3)
    answer = page.ask(page.row(34).command)
    assert answer.stderr.startswith("Setting parameter failed: Speed must be between")
    assert page.value("/simple_robot", "speed") == "1.0"


@row(39)
def check_accepted_value_is_reported(page: Page, row: Row) -> None:
    run_row(page, STEP_3)
    assert page.ask(page.row(37).command).stdout == f"{row.command}\n"
