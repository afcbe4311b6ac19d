"""A robot whose safety monitor is killed comes to rest by itself, without any observer."""

from __future__ import annotations

from pathlib import Path

import pytest
from systems import System, kill_composed, system

ROOT = Path(__file__).resolve().parents[3]

NOISE = 0.02
"""Speed (m/s) that odometry may show at rest."""

SPEEDS = """
import rclpy
from nav_msgs.msg import Odometry

rclpy.init()
node = rclpy.create_node("speeds")


def told(message):
    stamp = message.header.stamp
    print(stamp.sec + stamp.nanosec / 1e9, message.twist.twist.linear.x)


node.create_subscription(Odometry, "odom", told, 10)
rclpy.spin(node)
"""


def speeds(text: str) -> list[tuple[float, float]]:
    """The (time (s), speed (m/s)) pairs printed so far."""
    return [(float(at), float(speed)) for at, speed in map(str.split, text.splitlines())]


@pytest.mark.parametrize("seconds", [2.53, *(pytest.param(each, marks=pytest.mark.soak) for each in (2.0, 6.0, 7.17))])
def test_robot_stands_half_a_second_after_monitor_is_killed(seconds: float) -> None:
    with system() as running:
        launch = running.ros2("launch", str(ROOT / "launch" / "robot_system.launch.py"))
        watch = running.python("-c", SPEEDS)
        running.run(seconds)
        killed_at, speed = speeds(watch.stdout)[-1]
        assert speed > 0.4
        kill_composed(launch, "safety_node")
        running.run(2.0)
        after = [(at - killed_at, speed) for at, speed in speeds(watch.stdout) if at > killed_at]
        assert after[-1][0] > 1.5
        assert not [each for each in after if each[0] > 0.5 and abs(each[1]) > NOISE]


def test_monitor_follows_simulation_time_once_a_scan_is_late() -> None:
    def listeners(running: System) -> str:
        reported = running.finish(running.ros2("topic", "info", "/clock")).stdout
        return reported.partition("Subscription count: ")[2].strip()

    with system() as running:
        running.ros2("launch", str(ROOT / "launch" / "robot_system.launch.py"))
        running.run(3.0)
        assert listeners(running) == "0", "scans arrive in time, so nobody needs to be woken a hundred times a second"
        running.finish(running.ros2("param", "set", "/simulator", "scan_rate", "5.0"))
        running.run(1.0)
        assert listeners(running) == "1"
