"""Chapter 3: a node that changes its own parameters, and a client of another node's parameters."""

from __future__ import annotations

from course.page import Page, logs
from course.rows import COURSE, Row
from course.table import row
from systems import Program

NODE = "/dynamic_robot"
RUN = "import rclpy, {module} as page\nrclpy.init()\nrclpy.spin(page.DynamicRobot())"
PRESETS = {
    123: ("normal", "1.0", "50"),
    124: ("aggressive", "3.0", "30"),
    125: ("cautious", "0.5", "80"),
    126: ("eco", "0.8", "60"),
}


def run_as_printed(page: Page, seconds: float = 0.5) -> Program:
    return page.python(RUN.format(module="dynamic_robot"), seconds)


def run_repaired(page: Page) -> Program:
    """The listing, with `Parameter` imported from the intended module (N13)."""
    text = (COURSE / "nodes" / "dynamic_robot.py").read_text("utf-8")
    wrong = "from rcl_interfaces.msg import SetParametersResult, Parameter\n"
    right = "from rcl_interfaces.msg import SetParametersResult\nfrom rclpy.parameter import Parameter\n"
    assert wrong in text
    (page.scratch / "repaired_robot.py").write_text(text.replace(wrong, right), "utf-8")
    setting = f"sys.path.insert(0, {str(page.scratch)!r})\n"
    return page.python(setting + RUN.format(module="repaired_robot"))


def logged(program: Program) -> list[str]:
    return [each.message for each in logs(program)]


def check_module_has_no_main(page: Page, name: str) -> None:
    """There is no main() to run, which is reported with a hint (N14)."""
    failed = page.ask(f"ros2 run my_package {name}")
    assert failed.exit == 1
    assert f"module 'my_package.{name}' has no attribute 'main'" in failed.stderr
    assert "Add def main()" in failed.stderr.splitlines()[-1]


@row(117)
def check_listing_runs_as_printed(page: Page, row: Row) -> None:
    check_module_has_no_main(page, "dynamic_robot")
    robot = run_as_printed(page)
    assert [page.value(NODE, name) for name in ("speed", "mode", "sensitivity")] == ["1.0", "normal", "50"]
    assert row.quoted[-1] in logged(robot)


@row(118)
def check_robot_reports_its_state(page: Page, row: Row) -> None:
    robot = run_as_printed(page, 2.5)
    text = row.command.replace("<mode>", "normal").replace("speed=<v>", "speed=1.0").replace("<v>%", "50%")
    assert logged(robot).count(text) == 2


@row(119, 127)
def check_value_within_the_range_is_accepted(page: Page, row: Row) -> None:
    robot = run_as_printed(page)
    name, value = ("speed", "4.5") if row.number == 119 else ("sensitivity", "70")
    assert page.ask(f"ros2 param set {NODE} {name} {value}").stdout == "Set parameter successful\n"
    assert logged(robot)[-1] == row.command.replace("<v>", value)


@row(120, 122, 128)
def check_value_outside_the_range_is_refused(page: Page, row: Row) -> None:
    run_as_printed(page)
    name, value = {120: ("speed", "7.5"), 122: ("mode", "turbo"), 128: ("sensitivity", "101")}[row.number]
    refused = page.ask(f"ros2 param set {NODE} {name} {value}").stderr
    assert refused == f"Setting parameter failed: {row.command.replace('<v>', value)}\n"


@row(121)
def check_mode_ends_the_printed_node_but_not_the_repaired_one(page: Page, row: Row) -> None:
    robot = run_as_printed(page)
    page.ask(f"ros2 param set {NODE} mode eco", stop_after=3.0)
    assert robot.exit == 1
    assert "AttributeError: type object 'Parameter' has no attribute 'Type'" in robot.stderr
    message = robot.stderr.splitlines()[-1]
    assert "dynamic_robot.py:" in message
    assert "rcl_interfaces.msg" in message
    assert "from rclpy.parameter import Parameter" in message
    robot = run_repaired(page)
    page.ask(f"ros2 param set {NODE} mode eco")
    assert row.quoted[0].replace("<mode>", "eco") in logged(robot)


@row(123, 124, 125, 126)
def check_mode_sets_its_preset(page: Page, row: Row) -> None:
    """The nested set is committed, and its events are published, before the mode's own."""
    robot = run_repaired(page)
    mode, speed, sensitivity = PRESETS[row.number]
    events = page.start("ros2 topic echo /parameter_events --field changed_parameters[0].name".replace("[0].name", ""))
    assert page.ask(f"ros2 param set {NODE} mode {mode}").stdout == "Set parameter successful\n"
    assert [page.value(NODE, name) for name in ("speed", "mode", "sensitivity")] == [speed, mode, sensitivity]
    assert logged(robot)[-3:] == [
        f"Mode changed to: {mode}",
        f"Speed changed to: {speed} m/s",
        f"Sensitivity changed to: {sensitivity}%",
    ]
    order = [
        name for line in events.stdout.splitlines() for name in ("speed", "sensitivity", "mode") if f"'{name}'" in line
    ]
    assert order == ["speed", "sensitivity", "mode"]


CLIENT = """import rclpy, parameter_client as page
rclpy.init()
node = page.ParameterClient()
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(node)
executor.spin_until_future_complete(executor.create_task(node.{call}))
node.get_logger().info('done')
rclpy.spin(node)"""


@row(129)
def check_client_has_its_service_clients(page: Page, row: Row) -> None:
    check_module_has_no_main(page, "parameter_client")
    assert page.node_file("parameter_client.py").exit == 0
    page.python("import rclpy, parameter_client as page\nrclpy.init()\nrclpy.spin(page.ParameterClient())")
    info = page.ask(f"ros2 node info /{row.quoted[1]}").stdout
    clients = info.partition("Service Clients:")[2]
    assert all(f"{each}: " in clients for each in row.quoted[2:])


@row(130)
def check_client_sets_the_speed(page: Page, row: Row) -> None:
    waiting, done, failed = row.quoted[1:] if len(row.quoted) == 4 else row.quoted
    client = page.python(CLIENT.format(call="set_robot_speed(3.5)"), 2.5)
    assert logged(client) == [waiting, waiting]
    run_as_printed(page, 2.0)
    assert done.replace("<v>", "3.5") in logged(client)
    refused = page.python(CLIENT.format(call="set_robot_speed(9.5)"))
    assert (
        "ERROR",
        "parameter_client",
        failed.replace("<reason>", "Speed must be between 0.0 and 5.0, got 9.5"),
    ) in logs(refused)


@row(131)
def check_client_gets_the_parameters(page: Page, row: Row) -> None:
    run_as_printed(page)
    client = page.python(CLIENT.format(call="get_robot_parameters()"))
    stated = [each.replace("<v>", value) for each, value in zip(row.quoted, ("1.0", "normal", "50"), strict=True)]
    assert logged(client) == [*stated, "done"]


@row(132)
def check_wrong_values_are_refused_and_nothing_changes(page: Page, row: Row) -> None:
    run_as_printed(page)
    assert page.ask(f"ros2 param set {NODE} speed 7.5").stderr
    assert page.value(NODE, "speed") == "1.0"
