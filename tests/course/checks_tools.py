"""The parts of chapter 4 that are about nodes, and the troubleshooting pages."""

from __future__ import annotations

from course.checks_parameters import run_row
from course.page import Page, logs, make_workspace
from course.rows import COURSE, Row
from course.table import row


@row(144)
def check_publisher_runs_as_printed(page: Page, row: Row) -> None:
    page.node_file("data_publisher.py", seconds=0.0)
    values = page.ask("ros2 topic echo /robot_speed --field data", stop_after=0.55).stdout.replace("---", "").split()
    assert [round(float(each), 4) for each in values[:3]] == [2.0, 2.0998, 2.1987]
    assert len(values) == 5


@row(171)
def check_excessive_speed_is_an_error(page: Page, row: Row) -> None:
    robot = run_row(page, 133)
    assert page.ask(row.command).stderr.startswith("Setting parameter failed")
    assert logs(robot)[-1] == ("ERROR", "simple_robot", "Speed must be between 0.1 and 5.0, got 100.0")


@row(361, own=True)
def check_missing_package_is_reported(page: Page, row: Row) -> None:
    """`ros2 run` prints only that line, `ros2 launch` adds more (N25); once the package exists, both lines start it."""
    stated, commands = row.command.partition(": ")[2], (page.row(13).command, page.row(65).command)
    ran, launched = (page.ask(each) for each in commands)
    assert (ran.stderr, ran.stdout, ran.exit) == (f"{stated}\n", "", 1)
    assert (launched.exit, stated in launched.stdout + launched.stderr) == (1, True)
    page.work_on(make_workspace(page.scratch))
    assert [page.start(each, 1.5).exit for each in commands] == [None, None]
    assert page.ask("ros2 node list").stdout == "/my_robot\n/simple_robot\n"


@row(365)
def check_package_is_listed(page: Page, row: Row) -> None:
    command, _, wanted = row.command.partition(" | grep ")
    assert wanted in page.ask(command).stdout.split()


FILE_NODE = """import rclpy
rclpy.init(args=['n', '--ros-args', '--params-file', {file!r}])
node = rclpy.create_node('node_name')
node.declare_parameter('param1', 'default')
rclpy.spin(node)"""


def load_file(page: Page, keyword: str) -> str:
    file = page.scratch / "page.yaml"
    file.write_text(f"node_name:\n  {keyword}:\n    param1: value1\n", "utf-8")
    program = page.python(FILE_NODE.format(file=str(file)))
    return page.value("/node_name", "param1") if program.exit is None else program.stderr


@row(366)
def check_right_form_loads(page: Page, row: Row) -> None:
    assert load_file(page, row.quoted[0].rstrip(":")) == "value1"


@row(367)
def check_wrong_form_is_refused(page: Page, row: Row) -> None:
    assert "Cannot have a value before ros__parameters at line 3" in load_file(page, row.quoted[0].rstrip(":"))


@row(81, 368, alike=True)
def check_share_folder_has_the_config(page: Page, row: Row) -> None:
    """The package of these tests has that very line in its `setup.py`."""
    share = page.ask("ros2 pkg prefix --share my_package").stdout.strip()
    found = page.python(f"import os; print(sorted(os.listdir(os.path.join({share!r}, 'config'))))").stdout
    assert found == f"{sorted(each.name for each in (COURSE / 'config').iterdir())}\n"


FOUR = """import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node

class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.speed = 1.0
        {declare}
        {callback}
        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_timer(0.1, self.drive)

    def parameter_callback(self, params):
        for param in params:
            {update}
        return SetParametersResult(successful=True)

    def drive(self):
        twist = Twist()
        {use}
        self.publisher.publish(twist)

rclpy.init()
rclpy.spin(Robot())"""
PARTS = {370: "declare", 371: "callback", 372: "update", 373: "use"}
INSTEAD = {370: "pass", 371: "pass", 372: "pass", 373: "twist.linear.x = 1.0"}
"""What replaces a forgotten part: nothing, or a number instead of the member."""


def driven_speed(page: Page) -> str:
    return page.ask("ros2 topic echo /cmd_vel --once --field linear.x").stdout.split()[0]


def change(page: Page, left_out: int) -> tuple[str, str, str]:
    """The robot's speed before a change to 2.5 m/s, the response to the change, and the speed afterwards."""
    parts = {part: INSTEAD[each] if each == left_out else page.row(each).command for each, part in PARTS.items()}
    robot = page.python(FOUR.format(**parts))
    before = driven_speed(page)
    answer = page.ask("ros2 param set /robot speed 2.5")
    assert robot.exit is None, robot.stderr
    return before, answer.stdout + answer.stderr, driven_speed(page)


@row(370)
def check_undeclared_parameter_cannot_be_set(page: Page, row: Row) -> None:
    before, answer, after = change(page, row.number)
    assert "Setting parameter failed" in answer
    assert (before, after) == ("1.0", "1.0")


@row(371, 372, 373)
def check_change_has_no_effect_without_the_line(page: Page, row: Row) -> None:
    assert change(page, row.number) == ("1.0", "Set parameter successful\n", "1.0")
    assert page.value("/robot", "speed") == "2.5"


@row(374)
def check_change_takes_effect_with_all_four_lines(page: Page, row: Row) -> None:
    assert change(page, 0) == ("1.0", "Set parameter successful\n", "2.5")


@row(375)
def check_distribution_is_named(page: Page, row: Row) -> None:
    name = row.command.removeprefix("echo $")
    assert page.python(f"import os; print(os.environ[{name!r}])").stdout == "jazzy\n"


@row(376)
def check_nodes_are_listed(page: Page, row: Row) -> None:
    run_row(page, 13)
    assert page.ask(row.command).stdout == "/simple_robot\n"


@row(377)
def check_parameters_are_listed(page: Page, row: Row) -> None:
    assert page.ask(row.command).stderr == "Node not found\n"
    page.python("import rclpy\nrclpy.init()\nrclpy.spin(rclpy.create_node('node_name'))")
    assert page.ask(row.command).stdout.split() == ["start_type_description_service", "use_sim_time"]
