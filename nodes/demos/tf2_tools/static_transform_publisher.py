"""Program `static_transform_publisher`: one transform on `/tf_static`, from the command line."""

from __future__ import annotations

import argparse
import math
import secrets
import string
import sys
from collections.abc import Sequence
from functools import partial

from bot_console_demos.running import run
from bot_console_demos.turtle_tf2.frames import quaternion
from geometry_msgs.msg import Quaternion, TransformStamped
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from tf2_ros import StaticTransformBroadcaster

NAME = "static_transform_publisher"
TURN, ANGLES = ("qx", "qy", "qz", "qw"), ("roll", "pitch", "yaw")


class Publisher(Node):
    """Broadcasts the transform, and keeps it available for late subscribers."""

    def __init__(self, frame: TransformStamped) -> None:
        characters = "".join(secrets.choice(string.ascii_letters + string.digits) for _ in range(16))
        super().__init__(f"{NAME}_{characters}")
        frame.header.stamp = self.get_clock().now().to_msg()
        self._broadcaster = StaticTransformBroadcaster(self)
        self._broadcaster.sendTransform(frame)
        move, turn = frame.transform.translation, frame.transform.rotation
        self.get_logger().info(
            "Spinning until stopped - publishing transform\n"
            f"translation: ('{move.x:f}', '{move.y:f}', '{move.z:f}')\n"
            f"rotation: ('{turn.x:f}', '{turn.y:f}', '{turn.z:f}', '{turn.w:f}')\n"
            f"from '{frame.header.frame_id}' to '{frame.child_frame_id}'"
        )


def read(words: Sequence[str]) -> TransformStamped:
    """Return the transform described by a command line; exits with the usage if it is invalid."""
    words = _in_new_style(words)
    parser = argparse.ArgumentParser(NAME, description="Publish a static transform from one frame to another.")
    for name in "xyz":
        parser.add_argument(f"--{name}", type=float, default=0.0, help=f"{name} component of translation (m)")
    for name in TURN:
        parser.add_argument(f"--{name}", type=float, help=f"{name[1]} component of the rotation quaternion")
    for name in ANGLES:
        parser.add_argument(f"--{name}", type=float, help=f"{name} of the rotation (rad)")
    parser.add_argument("--frame-id", required=True, help="parent frame")
    parser.add_argument("--child-frame-id", required=True, help="child frame id")
    given = parser.parse_args(words)
    by_turn = [getattr(given, name) for name in TURN]
    by_angles = [getattr(given, name) for name in ANGLES]
    if any(each is not None for each in by_turn) and any(each is not None for each in by_angles):
        parser.error("give the rotation as a quaternion or by roll, pitch and yaw, not both")
    frame = TransformStamped(child_frame_id=given.child_frame_id)
    frame.header.frame_id = given.frame_id
    move = frame.transform.translation
    move.x, move.y, move.z = given.x, given.y, given.z
    if any(each is not None for each in by_turn):
        x, y, z, w = (default if each is None else each for each, default in zip(by_turn, (0, 0, 0, 1), strict=True))
        length = math.sqrt(x * x + y * y + z * z + w * w)
        if not length:
            parser.error("a quaternion of zeros is not a rotation")
        frame.transform.rotation = Quaternion(x=x / length, y=y / length, z=z / length, w=w / length)
    else:
        frame.transform.rotation = quaternion(*(each or 0.0 for each in by_angles))
    return frame


def _in_new_style(words: Sequence[str]) -> Sequence[str]:
    """Convert old-style arguments, `x y z yaw pitch roll FRAME CHILD` or with a quaternion instead, to options."""
    names = {8: ("x", "y", "z", "yaw", "pitch", "roll"), 9: ("x", "y", "z", *TURN)}.get(len(words))
    if names is None or any(each.startswith("--") for each in words):
        return words
    get_logger(NAME).warning("Old-style arguments are deprecated; see --help for new-style arguments")
    options = [f"--{name}={word}" for name, word in zip(names, words[:-2], strict=True)]
    return [*options, f"--frame-id={words[-2]}", f"--child-frame-id={words[-1]}"]


def main(args: list[str] | None = None) -> None:
    """Publish until stopped."""
    frame = read(remove_ros_args(args)[1:])
    if frame.header.frame_id == frame.child_frame_id:
        get_logger(NAME).error(
            f"cannot publish static transform from '{frame.header.frame_id}' to '{frame.child_frame_id}', exiting"
        )
        sys.exit(1)
    run(partial(Publisher, frame), args)
