"""Chapter 4 of the course page by keyboard: each exercise in its words, beside the page's own nodes in terminals."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from bot_console.runtime.workspace import discover
from bot_console.tui.cli.appearance import appearance_of
from bot_console.tui.cli.arguments import parse
from bot_console.tui.files.folders import config_folder
from bot_console.tui.panes.graph.pane import GraphPane
from bot_console.tui.panes.logs.pane import LogsPane
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.panes.plot.pane import PlotPane
from bot_console.tui.session.plugins import find_plugins
from bot_console.tui.widgets.diagram_view import DiagramView
from course.rows import rows
from page_terminals import Screen, Terminals, terminals
from systems import Program
from textual.geometry import Region

pytestmark = pytest.mark.skipif(not rows(), reason="BOT_CONSOLE_COURSE names no course")
SPEED = "/robot_speed/data"
PLUGINS = {
    "rqt_reconfigure": "parameters",
    "rqt_graph": "graph",
    "rqt_console": "logs",
    "rqt_plot": "plot",
    "rqt_publisher": "topics",
}
"""The pane of each rqt plug-in that the page uses.

These are Configuration > Dynamic Reconfigure, Introspection > Node Graph, Logging > Console, Visualization > Plot and
Topics > Message Publisher.
"""
TYPES = {
    "max_speed": "double · 0.1 .. 5.0",
    "detection_threshold": "integer · 0 .. 255",
    "enable_safety": "boolean · ",
    "robot_name": "string · ",
}
"""Parameters of our robot, and the types and limits that the console shows for them."""
EXAMPLE = Path(__file__).resolve().parents[3] / "docs" / "examples" / "my_robot_control"
ROBOT = "ros2 run my_package simple_robot_step3 --ros-args -p speed:=1.0 -p robot_name:=TestBot"


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Terminals]:
    """The page's workspace with the console beside it, shared by all tests of this chapter."""
    with terminals(tmp_path_factory.mktemp("page")) as running:
        yield running


@pytest.fixture(scope="module")
def robot(page: Terminals) -> Program:
    """Terminal 1 of steps 1 and 4."""
    return page.start(ROBOT)


@pytest.fixture(scope="module")
def publisher(page: Terminals) -> Program:
    """Terminal 1 of step 2."""
    return page.start("ros2 run my_package data_publisher")


async def go_to(screen: Screen, name: str) -> None:
    table = screen.pane(ParametersPane).query_one(ParameterRows)

    def at() -> int | None:
        return next((i for i, row in enumerate(table.rows) if row.parameter and row.parameter.name == name), None)

    await screen.until(lambda: at() is not None, f"row of {name}")
    await screen.press("g", *["down"] * (at() or 0))


def test_step_1_the_speed_is_tuned_while_the_robot_runs(page: Terminals, robot: Program) -> None:
    async def play(screen: Screen) -> None:
        await screen.line("ros2 run rqt_reconfigure rqt_reconfigure")
        assert screen.pane(ParametersPane).display
        await screen.shows("/simple_robot", "speed", "robot_name", "TestBot", "enable_safety")
        await go_to(screen, "speed")
        await screen.press("e")
        await screen.enter("3.0")
        await screen.until(lambda: "✓ Speed updated to 3.0 m/s" in robot.stderr, "line in the robot's terminal")
        await screen.shows("•* speed 3.0 m/s")  # changed since the start, and in no file
        await screen.press("e")
        await screen.enter("10.0")
        await screen.shows("✗ 10.0", "Speed must be between 0.1 and 5.0")
        assert "[ERROR]" in robot.stderr
        assert "Speed must be between 0.1 and 5.0, got 10.0" in robot.stderr

    page.show(play)


@pytest.mark.slow
def test_step_1_a_text_field_and_a_checkbox(page: Terminals, robot: Program) -> None:
    async def play(screen: Screen) -> None:
        await screen.press("1")
        await go_to(screen, "robot_name")
        await screen.press("e")
        await screen.enter("Scout")
        await screen.until(lambda: "✓ Name updated to Scout" in robot.stderr, "new name")
        await go_to(screen, "enable_safety")
        await screen.press("enter", "y")
        await screen.until(lambda: "⚠ Safety DISABLED" in robot.stderr, "switched safety")

    page.show(play)


async def add_curve(screen: Screen, path: str) -> None:
    """Type a path into the topic field, and press Enter."""
    await screen.press("a")
    await screen.enter(path)
    assert path in screen.pane(PlotPane).paths


@pytest.mark.slow
def test_step_2_a_sine_wave_is_plotted(page: Terminals, robot: Program, publisher: Program, tmp_path: Path) -> None:
    async def play(screen: Screen) -> None:
        await screen.line("ros2 run rqt_plot rqt_plot")
        assert screen.pane(PlotPane).display
        await screen.until(lambda: SPEED in page.console.plots.plottable(), "speed to plot")
        await add_curve(screen, SPEED)
        await screen.until(lambda: page.console.plots.samples(SPEED).cursor >= 12, "samples")
        values = page.console.plots.samples(SPEED).values
        steps = [later - earlier for earlier, later in pairwise(values)]
        assert all(1.0 <= each <= 3.0 for each in values)
        assert all(abs(each) < 0.1 for each in steps), "a sine whose argument grows by 0.1"
        await screen.until(lambda: any("\u2800" < each < "\u2900" for each in screen.text()), "curve on the screen")
        await add_curve(screen, "/simple_robot:speed")
        await screen.press("minus", "plus")
        await screen.press("space")
        await screen.shows("paused")
        await screen.press("space", "S")
        screen.app.focused.value = str(tmp_path / "plot.html")
        await screen.press("enter")
        await screen.until((tmp_path / "plot.html").is_file, "saved picture")
        await screen.press("X")

    page.show(play)


@pytest.mark.slow
def test_rqt_plot_lines_of_the_page_wait_for_unpublished_topics(page: Terminals) -> None:
    async def play(screen: Screen) -> None:
        await screen.line("ros2 run rqt_plot rqt_plot /robot/speed /robot/distance")
        await screen.shows("waiting for /robot/speed")
        await screen.line("ros2 run rqt_plot rqt_plot /parameter_events")
        await screen.shows("/parameter_events")
        await screen.press("X")

    page.show(play)


LISTENER = """import rclpy
from geometry_msgs.msg import Twist
from std_msgs.msg import Float64
rclpy.init()
node = rclpy.create_node('listener')
node.create_subscription(Float64, 'robot_speed', lambda message: None, 10)
node.create_subscription(Twist, 'cmd_vel', lambda message: print(message.linear.x, message.angular.z), 10)
rclpy.spin(node)"""


@pytest.fixture(scope="module")
def listener(page: Terminals) -> Program:
    """A node at the other end of the arrows: the page has none."""
    return page.node(LISTENER)


@pytest.mark.slow
def test_step_3_nodes_topics_and_arrows(page: Terminals, robot: Program, publisher: Program, listener: Program) -> None:
    async def play(screen: Screen) -> None:
        await screen.line("ros2 run rqt_graph rqt_graph")
        view = screen.pane(GraphPane).query_one(DiagramView)
        await screen.until(lambda: {"/data_publisher", "/listener"} <= {*view.places}, "graph")
        await screen.shows("data_publisher", "robot_speed", "listener")
        topics = []
        for mode in ("Nodes only", "Nodes/Topics (active)", "Nodes/Topics (all)"):
            await screen.press("m")
            await screen.shows(mode)
            await screen.until(lambda: {"/data_publisher", "/listener"} <= {*view.places}, "the same nodes")
            topics.append({each for each in view.places if each.startswith("topic:")})
            if mode != "Nodes only":
                links = {("/data_publisher", "topic:/robot_speed"), ("topic:/robot_speed", "/listener")}
                assert links <= {*view._links}
        nodes_only, active, every = topics
        assert not nodes_only and active < every and "topic:/robot_speed" in active

    page.show(play)


@pytest.mark.slow
def test_step_4_an_error_is_found_among_warnings(page: Terminals, robot: Program) -> None:
    async def play(screen: Screen) -> None:
        await screen.line("ros2 run rqt_console rqt_console")
        assert screen.pane(LogsPane).display
        await screen.press("w")
        page.ask("ros2 param set /simple_robot speed 100.0")
        await screen.shows("Speed must be between 0.1 and 5.0, got 100.0")
        await screen.until(lambda: "] Speed: " not in screen.text(), "log without what is below a warning")
        await screen.press("G", "enter")
        await screen.shows("simple_robot_step3.py", "parameter_callback")
        await screen.press("escape", "w")
        for severity in ("INFO", "WARN", "ERROR", "FATAL"):
            await screen.press("v")
            assert f">= {severity}" in screen.text()
        await screen.press("escape", "slash")
        await screen.enter("speed")
        page.ask("ros2 param set /simple_robot robot_name Ada")

        def found() -> list[str]:
            return [line.lower() for line in screen.lines() if "/simple_robot" in line]

        await screen.until(lambda: found() and all("speed" in each for each in found()), "log of that word alone")

    page.show(play)


async def choose(screen: Screen, *keys_and_panes: str) -> None:
    """Arrange the panes: a key, and the pane that it should add."""
    for key, pane in zip(keys_and_panes[::2], keys_and_panes[1::2], strict=True):
        await screen.press(key)
        await screen.enter(pane)


def places(screen: Screen) -> dict[str, Region]:
    return {pane.id or "": pane.region for pane in screen.app.visible_panes()}


async def build_dashboard(screen: Screen) -> None:
    """Plot top left, parameters top right, console bottom left, graph bottom right."""
    await screen.press("V")
    for _ in screen.app.visible_panes()[1:]:
        await screen.press("x")
    await choose(screen, "r", "plot", "s", "logs", "v", "graph")
    await screen.press("up")
    await choose(screen, "v", "parameters")


@pytest.mark.slow
def test_step_5_a_dashboard_is_built_saved_and_loaded(page: Terminals, robot: Program) -> None:
    kept: dict[str, Region] = {}

    async def build(screen: Screen) -> None:
        await screen.line("rqt")
        await build_dashboard(screen)
        before = places(screen)
        assert before.keys() == {"plot", "parameters", "logs", "graph"}
        plot, parameters, logs, graph = (before[each] for each in ("plot", "parameters", "logs", "graph"))
        assert (plot.x, plot.y) < (parameters.x, logs.y) and (parameters.y, logs.x) == (plot.y, plot.x)
        assert graph.x > logs.x and graph.y == logs.y
        await screen.press("right_square_bracket", "plus")
        assert places(screen) != before, "each panel is resized as needed"
        await screen.press("w")
        await screen.enter("my_robot_dashboard")
        await screen.press("escape")
        kept.update(places(screen))

    async def load(screen: Screen) -> None:
        assert places(screen) == kept
        await screen.shows("my_robot_dashboard")

    page.show(build, appearance=appearance_of(parse([])))
    saved = config_folder() / "layouts" / "my_robot_dashboard.yaml"
    page.show(load, appearance=appearance_of(parse(["--perspective-file", str(saved)])))
    page.show(load, appearance=appearance_of(parse(["--layout", "my_robot_dashboard"])))


@pytest.mark.slow
def test_workflow_shows_all_panes_side_by_side(page: Terminals, robot: Program, publisher: Program) -> None:
    async def play(screen: Screen) -> None:
        await build_dashboard(screen)
        await screen.press("escape")
        await go_to(screen, "speed")
        await screen.press("p", "e")
        await screen.enter("4.5")
        await screen.shows("✓ Speed updated to 4.5 m/s", "/data_publisher", "4.5")
        await screen.until(
            lambda: 4.5 in page.console.plots.samples("/simple_robot:speed").values, "the value as a curve"
        )
        assert {"plot", "parameters", "logs", "graph"} == places(screen).keys()

    page.show(play, (160, 50))


def test_the_robot_is_steered_by_key(page: Terminals, listener: Program) -> None:
    async def play(screen: Screen) -> None:
        await screen.line("ros2 run rqt_robot_steering rqt_robot_steering")
        await screen.shows("/cmd_vel")
        await screen.press("enter", "w", "a")
        await screen.until(lambda: any(float(each.split()[0]) > 0 for each in listener.stdout.splitlines()), "speed")
        await screen.until(lambda: any(float(each.split()[1]) > 0 for each in listener.stdout.splitlines()), "turn")
        await screen.press("escape")
        await screen.until(lambda: listener.stdout.splitlines()[-1] == "0.0 0.0", "a robot at rest")
        await screen.press("h")

    page.show(play)


@pytest.mark.slow
def test_each_plug_in_of_the_menu_is_a_pane_and_messages_are_published(page: Terminals, listener: Program) -> None:
    async def play(screen: Screen) -> None:
        for program, pane in PLUGINS.items():
            await screen.line(program)
            assert screen.app.current_pane.id == pane, program
        await screen.until(lambda: "/robot_speed" in screen.text(), "topic")
        await screen.press("slash")
        await screen.enter("cmd_vel")
        await screen.press("P")
        await screen.shows("Publish to /cmd_vel", "linear", "angular")
        count = len(listener.stdout.splitlines())
        await screen.press("s")
        await screen.until(lambda: len(listener.stdout.splitlines()) > count, "message")
        await screen.press("q")

    page.show(play)


@pytest.mark.slow
def test_types_and_limits_are_shown(page: Terminals) -> None:
    robot = page.start("ros2 run bot_console_robot robot_node")  # the page's declares no range (N15)

    async def play(screen: Screen) -> None:
        await screen.line("ros2 run rqt_reconfigure rqt_reconfigure")
        for name, facts in TYPES.items():
            await go_to(screen, name)
            await screen.shows(facts)
        await go_to(screen, "max_speed")
        await screen.press("e")
        await screen.enter("99")
        await screen.shows("✗ 99.0", "out of range Min: 0.1, Max: 5.0", "max_speed 1.0 m/s")

    try:
        page.show(play)
    finally:
        robot.process.kill()


@pytest.mark.slow
def test_own_plug_in_starts_and_stops_the_robot(page: Terminals) -> None:
    shutil.copytree(EXAMPLE, page.workspace / "src" / "my_robot_control", dirs_exist_ok=True)
    discover.use(discover.Workspace([page.workspace / "src"]))
    driver = page.start("ros2 run intelligent_robot robot_node")

    async def play(screen: Screen) -> None:
        await screen.until(lambda: "/robot_navigator" in page.console.snapshot().parameters, "robot")
        await screen.press("ctrl+p")
        await screen.enter("My robot")
        await screen.shows("Robot Status: OK", "Start Robot", "Stop Robot")
        await press_button(screen, "stop")
        await screen.shows("Robot Status: Stopped")
        await screen.until(lambda: "✓ Max speed: 0.1 m/s" in driver.stderr, "call of the parameter service")
        await press_button(screen, "start")
        await screen.shows("Robot Status: Running")
        await screen.until(lambda: "✓ Max speed: 1.0 m/s" in driver.stderr, "call of the parameter service")

    page.show(play, plugins=find_plugins)
    driver.process.kill()


async def press_button(screen: Screen, name: str) -> None:
    """Press a button of the plug-in: Tab until it has the focus, then Enter."""
    await screen.press(*{"stop": ["tab"], "start": ["shift+tab"]}[name], "enter")
