"""What the console says of a robot that tells nothing any more: how old it is, and no speed."""

from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.robot.drive_link import DriveLink
from bot_console.tui.console.robot.world_watch import WorldWatch
from bot_console.tui.widgets.status_bar import drive_text
from nav_msgs.msg import Odometry
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

GRAPH = GraphInfo(nodes=(NodeInfo("/robot", publishers=(Endpoint("/odom", ("nav_msgs/msg/Odometry",)),)),))


def test_a_robot_that_has_gone_silent_has_no_actual_speed():
    context = Context()
    context.init([], domain_id=3900)
    console, robot = Node("console", context=context), Node("robot", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(console)
    clock = [100.0]
    odometry = robot.create_publisher(Odometry, "/odom", 10)
    world, drive = WorldWatch(console, lambda: clock[0]), DriveLink(console)
    world.follow(GRAPH)
    message = Odometry()
    message.twist.twist.linear.x = 0.9

    def said() -> str:
        odometry.publish(message)
        for _ in range(5):
            executor.spin_once(timeout_sec=0)
        return drive_text(drive.info(world.info))

    try:
        assert said() == "actual +0.9 m/s"
        clock[0] += 0.9
        assert drive_text(drive.info(world.info)) == "actual +0.9 m/s"
        clock[0] += 4.2
        assert world.info.silent_s == 5 and world.info is world.info
        assert drive_text(drive.info(world.info)) == "the robot is SILENT for 5 s"
        assert said() == "actual +0.9 m/s"
    finally:
        console.destroy_node()
        robot.destroy_node()
        context.try_shutdown()
