"""Transforms between programs: one program offers its buffer to others, which query it like their own."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from systems import Program, System, system


@pytest.fixture
def running() -> Iterator[System]:
    with system() as found:
        yield found


ASKING = """
import threading, rclpy, tf2_geometry_msgs, tf2_ros
from geometry_msgs.msg import PointStamped
from rclpy.duration import Duration
from rclpy.time import Time
rclpy.init()
node = rclpy.create_node("asking")
buffer = tf2_ros.BufferClient(node, "tf2_buffer_server")
threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
buffer.action_client.wait_for_server({wait})
began = node.get_clock().now()
try:
    print({ask})
except tf2_ros.TransformException as error:
    print(type(error).__name__, error)
print("after", round((node.get_clock().now() - began).nanoseconds * 1e-9, 1))
"""


def look_up(running: System, ask: str, wait: float = 5.0) -> Program:
    return running.finish(running.python("-c", ASKING.format(ask=ask, wait=wait)))


def static(running: System, parent: str, child: str, x: float) -> None:
    words = ["--frame-id", parent, "--child-frame-id", child, "--x", str(x)]
    running.executable("tf2_ros", "static_transform_publisher", *words)


def test_buffer_in_another_process_answers(running: System) -> None:
    running.executable("tf2_ros", "buffer_server")
    static(running, "map", "base", 1.5)
    running.run(0.5)
    ask = "buffer.lookup_transform('map', 'base', Time()).transform.translation.x"
    assert look_up(running, ask).stdout == "1.5\nafter 0.0\n"
    full = "buffer.lookup_transform_full('base', Time(), 'map', Time(), 'map').transform.translation.x"
    assert look_up(running, full).stdout == "-1.5\nafter 0.0\n"
    there = "PointStamped(header=buffer.lookup_transform('map', 'base', Time()).header)"
    assert "x=-1.5" in look_up(running, f"buffer.transform({there}, 'base').point").stdout


def test_lookup_waits_for_a_transform_within_its_time_out(running: System) -> None:
    running.executable("tf2_ros", "buffer_server")
    running.run(0.5)
    ask = "buffer.can_transform('map', 'base', Time(), Duration(seconds=5))"
    asked = running.python("-c", ASKING.format(ask=ask, wait=5.0))
    running.run(2.0)
    static(running, "map", "base", 1.5)
    assert re.match(r"True\nafter 2\.[01]\n", running.finish(asked).stdout)


def test_missing_transform_is_reported_with_its_reason(running: System) -> None:
    running.executable("tf2_ros", "buffer_server")
    running.run(0.5)
    ask = "buffer.lookup_transform('map', 'base', Time(), Duration(seconds=1))"
    assert look_up(running, ask).stdout == (
        'LookupException "map" passed to lookupTransform argument target_frame does not exist. \nafter 1.0\n'
    )
    assert look_up(running, "buffer.can_transform('map', 'base', Time())").stdout == "False\nafter 0.0\n"


def test_missing_buffer_server_is_reported(running: System) -> None:
    ask = "buffer.lookup_transform('map', 'base', Time())"
    assert look_up(running, ask, 0.5).stdout == "TimeoutException The BufferServer is not ready.\nafter 0.0\n"


LISTENING = """
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import TransformException
from tf2_ros.buffer import Buffer
from tf2_ros.transform_broadcaster import TransformBroadcaster
from tf2_ros.transform_listener import TransformListener
from geometry_msgs.msg import TransformStamped

class Carrot(Node):
    '''A frame that runs away from the one it hangs on, a metre a second.'''
    def __init__(self):
        super().__init__('carrot')
        self.began = self.get_clock().now()
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.broadcaster = TransformBroadcaster(self)
        self.create_timer(0.1, self.tell)
        self.create_timer(2.0, self.ask)

    def tell(self):
        frame = TransformStamped()
        frame.header.stamp = self.get_clock().now().to_msg()
        frame.header.frame_id, frame.child_frame_id = 'turtle', 'carrot'
        frame.transform.translation.x = (self.get_clock().now() - self.began).nanoseconds * 1e-9
        self.broadcaster.sendTransform(frame)

    def ask(self):
        now = self.get_clock().now() - Duration(seconds=0.1)
        past = now - Duration(seconds=1.0)
        way = self.buffer.lookup_transform_full('carrot', now, 'carrot', past, 'turtle')
        print('moved', round(way.transform.translation.x, 1), flush=True)
        try:
            self.buffer.lookup_transform('turtle', 'carrot', past - Duration(seconds=60.0))
        except TransformException as error:
            print(type(error).__name__, flush=True)

rclpy.init()
rclpy.spin(Carrot())
"""


def test_listener_looks_up_the_past(running: System) -> None:
    carrot = running.python("-c", LISTENING)
    running.run(2.5)
    assert carrot.stdout == "moved -1.0\nExtrapolationException\n"
