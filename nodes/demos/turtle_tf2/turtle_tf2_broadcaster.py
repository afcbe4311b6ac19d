"""Node `turtle_tf2_frame_publisher`: the pose of the turtle `turtlename` as a frame in `world`."""

from __future__ import annotations

from bot_console_demos.running import run
from bot_console_demos.turtle_tf2.frames import quaternion
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from turtlesim.msg import Pose


class FramePublisher(Node):
    """Broadcasts each pose that it receives."""

    def __init__(self) -> None:
        super().__init__("turtle_tf2_frame_publisher")
        self._name = str(self.declare_parameter("turtlename", "turtle").value)
        self._broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f"/{self._name}/pose", self._on_pose, 1)

    def _on_pose(self, pose: Pose) -> None:
        frame = TransformStamped(child_frame_id=self._name)
        frame.header.stamp = self.get_clock().now().to_msg()
        frame.header.frame_id = "world"
        frame.transform.translation.x = pose.x
        frame.transform.translation.y = pose.y
        frame.transform.rotation = quaternion(0.0, 0.0, pose.theta)
        self._broadcaster.sendTransform(frame)


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(FramePublisher, args)
