"""A robot that has gone silent is shown with the age of its data, and without a speed."""

import math

import pytest
from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.robot.drive_link import DriveLink
from bot_console.tui.console.robot.pose_and_trail import WorldWatch, grid_of
from bot_console.tui.console.robot.robot_model import DriveInfo, WorldInfo
from bot_console.tui.panes.world.map_drawing import Window, WorldDrawing, fitting_window, following_window, scale_text
from bot_console.tui.widgets.status_bar import drive_figures, status_text
from domains import unused_domain
from geometry_msgs.msg import Point, Pose
from nav_msgs.msg import MapMetaData, OccupancyGrid, Odometry
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

GRAPH = GraphInfo(nodes=(NodeInfo("/robot", publishers=(Endpoint("/odom", ("nav_msgs/msg/Odometry",)),)),))


def test_a_silent_robot_has_no_actual_speed():
    context = Context()
    context.init([], domain_id=unused_domain())
    console, robot = Node("console", context=context), Node("robot", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(console)
    clock = [100.0]
    odometry = robot.create_publisher(Odometry, "/odom", 10)
    world, drive = WorldWatch(console, lambda: clock[0]), DriveLink(console)
    world.follow(GRAPH)
    message = Odometry()
    message.twist.twist.linear.x = 0.9

    def status() -> str:
        return status_text(ConsoleSnapshot(drive=drive.info(world.info)))

    def output() -> str:
        odometry.publish(message)
        for _ in range(5):
            executor.spin_once(timeout_sec=0)
        return status()

    try:
        assert output() == "DRIVING                    robot  0.9 m/s"
        clock[0] += 0.9
        assert status() == "DRIVING                    robot  0.9 m/s"
        clock[0] += 4.2
        assert world.info.silent_s == 5 and world.info is world.info
        assert status() == "SILENT 5 s"
        assert output() == "DRIVING                    robot  0.9 m/s"
    finally:
        console.destroy_node()
        robot.destroy_node()
        context.try_shutdown()


EXTREMES = (math.nan, math.inf, -math.inf, 1.7e308, -1.7e308, 1e200, 5e-324, 0.0)


def world_after(*, grid: OccupancyGrid | None = None, odometry: Odometry, scan: LaserScan) -> WorldInfo:
    """The state of a console after these messages."""
    context = Context()
    context.init([], domain_id=unused_domain())
    node = Node("console", context=context)
    world = WorldWatch(node)
    if grid:
        world._on_map(grid)
    world._on_odometry(odometry)
    world._on_odometry(Odometry())
    world._on_odometry(odometry)
    world._on_scan(scan)
    info = world.info
    node.destroy_node()
    context.try_shutdown()
    return info


@pytest.mark.parametrize("number", EXTREMES)
def test_any_numbers_in_messages_are_drawn_or_left_out(number):
    small = max(-3e38, min(3e38, number)) if math.isfinite(number) else number
    odometry = Odometry()
    odometry.pose.pose.position.x = odometry.pose.pose.orientation.z = odometry.twist.twist.linear.x = number
    scan = LaserScan(ranges=[1.0, small, 2.0], angle_increment=small, angle_min=small, range_max=math.inf)
    grid = OccupancyGrid(info=MapMetaData(width=2, height=1, resolution=small), data=[0, 100])
    info = world_after(grid=grid, odometry=odometry, scan=scan)
    for window in (fitting_window(info, 40, 12), following_window(info, 40, 12, 8.0)):
        assert len(WorldDrawing().rows(info, window, 40, 12)) == 12
        assert scale_text(window, 40)
        assert len(scale_text(window, 40, 9)) <= 9
    assert (
        len("  ".join(drive_figures(DriveInfo(asked=(number, 0.0), final=(number, number), actual=(number, number)))))
        < 60
    )


@pytest.mark.parametrize(
    ("width", "height", "resolution", "x"),
    [(0, 0, 0.1, 0.0), (3, 1, 0.1, 0.0), (2, 1, 0.0, 0.0), (2, 1, -1.0, 0.0), (2, 1, 1e30, 0.0), (2, 1, 0.1, math.nan)],
)
def test_an_impossible_map_is_ignored(width, height, resolution, x):
    info = MapMetaData(width=width, height=height, resolution=resolution, origin=Pose(position=Point(x=x)))
    assert grid_of(OccupancyGrid(info=info, data=[0, 100][: width * height])) is None


def test_a_scale_without_room_becomes_a_shorter_one_with_its_length() -> None:
    window = Window(0.0, 0.0, 10.0)  # 0.2 m per cell
    assert scale_text(window, 60) == "├────────┤ 2 m"
    assert scale_text(window, 60, 11) == "├───┤ 1 m"
    assert scale_text(window, 60, 9) == "├───┤ 1 m"
    assert scale_text(window, 60, 3) == ""


def stamped(second: float, x: float) -> Odometry:
    message = Odometry()
    message.header.stamp.sec, message.header.stamp.nanosec = int(second), int(second % 1 * 1e9)
    message.pose.pose.position.x = x
    return message


@pytest.mark.parametrize(
    ("later", "kept"),
    [(0.0, 1), (9.0, 3), (9.6, 3), (30.0, 3)],
    ids=["reset", "a second back, no more", "late message", "forward"],
)
def test_trail_and_scan_from_before_a_jump_back_in_time_are_forgotten(later: float, kept: int) -> None:
    context = Context()
    context.init([], domain_id=unused_domain())
    node = Node("console", context=context)
    world = WorldWatch(node)
    for each in (stamped(9.0, 1.0), stamped(10.0, 2.0)):
        world._on_odometry(each)
    world._on_scan(LaserScan(ranges=[1.0, 1.0, 1.0], angle_increment=0.1, range_max=5.0))
    world._on_odometry(stamped(later, 5.0))
    info = world.info
    node.destroy_node()
    context.try_shutdown()
    assert len(info.trail) == kept and info.pose is not None and info.pose.x == 5.0
    assert bool(len(info.hits)) is (kept > 1)
