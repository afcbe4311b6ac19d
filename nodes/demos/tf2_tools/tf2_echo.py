"""Program `tf2_echo`: repeatedly prints the transform between two frames."""

from __future__ import annotations

import argparse
import math
from functools import partial

from bot_console_demos.running import run
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.time import Time
from rclpy.utilities import remove_ros_args
from tf2_ros import Buffer, TransformException, TransformListener
from tf_transformations import euler_from_quaternion, quaternion_matrix


class Echo(Node):
    """Prints at a rate (Hz); while there is no transform, reports once a second what it is waiting for."""

    def __init__(self, source: str, target: str, rate: float) -> None:
        super().__init__("tf2_echo")
        self._source, self._target = source, target
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, self)
        self.create_timer(1.0 / rate, self._tick)

    def _tick(self) -> None:
        try:
            found = self._buffer.lookup_transform(self._source, self._target, Time())
        except TransformException as error:
            text = f"Waiting for transform {self._source} ->  {self._target}: {error}"
            self.get_logger().info(text, throttle_duration_sec=1.0)
        else:
            print(described(found), flush=True)


def described(found: TransformStamped) -> str:
    """Format a transform with its rotation in each of the usual representations."""
    stamp, move, turn = found.header.stamp, found.transform.translation, found.transform.rotation
    rotation = (turn.x, turn.y, turn.z, turn.w)
    angles = euler_from_quaternion(rotation)
    matrix = quaternion_matrix(rotation)
    matrix[:3, 3] = (move.x, move.y, move.z)
    rows = ["".join(f"{value:7.3f}" for value in row) for row in matrix.tolist()]
    return "\n".join(
        [
            f"At time {stamp.sec}.{stamp.nanosec}",
            f"- Translation: {_listed((move.x, move.y, move.z))}",
            f"- Rotation: in Quaternion (xyzw) {_listed(rotation)}",
            f"- Rotation: in RPY (radian) {_listed(angles)}",
            f"- Rotation: in RPY (degree) {_listed(tuple(map(math.degrees, angles)))}",
            "- Matrix:",
            *rows,
        ]
    )


def _listed(values: tuple[float, ...]) -> str:
    return "[" + ", ".join(f"{each:.3f}" for each in values) + "]"


def main(args: list[str] | None = None) -> None:
    """Print until stopped."""
    parser = argparse.ArgumentParser("tf2_echo", description="Print the transform between two frames.")
    parser.add_argument("source_frame", help="target frame, in which the source frame is expressed")
    parser.add_argument("target_frame", help="source frame")
    parser.add_argument("rate", nargs="?", type=float, default=1.0, help="rate at which to print (Hz)")
    given = parser.parse_args(remove_ros_args(args)[1:])
    if not 0.0 < given.rate < math.inf:
        parser.error("the rate must be more than 0 Hz")
    run(partial(Echo, given.source_frame, given.target_frame, given.rate), args)
