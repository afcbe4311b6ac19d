"""The exported package on a foreign rclpy: its nodes run with each profile, and a stop outlives its locks."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.runtime.workspace.exporting import NAME, export
from domains import unused_domain
from rigs import is_embedded_rclpy

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(600),
    pytest.mark.skipif(is_embedded_rclpy(), reason="needs rclpy on a machine without `ros2`: .ci/on_rclpy"),
]
PROFILES = ("competition", "indoor", "outdoor", "warehouse")
DRIVEN = """
import importlib, json, sys, types
import rclpy
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_srvs.srv import Trigger

class AnyMessage(type(TransformStamped)):
    def __instancecheck__(cls, message):
        return isinstance(message, TransformStamped)

class TFMessage(TransformStamped, metaclass=AnyMessage):
    def __new__(cls, transforms):
        return transforms[0]

type(TransformStamped).__import_type_support__()
try:
    import tf2_msgs.msg
except ModuleNotFoundError:  # PyPI has no tf2_msgs: only the first transform of each message is sent
    sys.modules["tf2_msgs"] = package = types.ModuleType("tf2_msgs")
    sys.modules["tf2_msgs.msg"] = package.msg = types.SimpleNamespace(TFMessage=TFMessage)

config, program, *names = sys.argv[1:]
remaps = ["motion_controller:cmd_vel:=cmd_vel_nav", "robot_navigator:cmd_vel:=cmd_vel_desired"]
rclpy.init(args=[program, "--ros-args", "--params-file", config, *(word for each in remaps for word in ("-r", each))])
executor = SingleThreadedExecutor()
nodes = {}

def start(name):
    module = importlib.import_module(f"bot_console_robot.{name}")
    kind, = (each for each in vars(module).values()
             if isinstance(each, type) and issubclass(each, Node) and each.__module__ == module.__name__)
    nodes[name] = kind()
    executor.add_node(nodes[name])

def restart(*names):
    for each in names:
        executor.remove_node(nodes[each])
        nodes[each].destroy_node()
    locked.clear()
    for each in names:
        start(each)

for each in names:
    start(each)
person = rclpy.create_node("person")
executor.add_node(person)
speeds, locked = [], {}

def moved(message):
    twist = message.twist.twist
    speeds.append(max(abs(twist.linear.x), abs(twist.angular.z)))

def reported(message):
    locked[message.hardware_id] = {each.key: each.value for each in message.values}["locked"]

latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
person.create_subscription(Odometry, "ground_truth", moved, 10)
for each in ("arbiter", "base"):
    person.create_subscription(DiagnosticStatus, f"emergency_stop/{each}", reported, latched)

def until(condition):
    while not condition():
        executor.spin_once(timeout_sec=1.0)

def drives():
    speeds.clear()
    until(lambda: max(speeds, default=0.0) > 0.1)

def stands():
    speeds.clear()
    until(lambda: len(speeds) > 50)
    assert max(speeds) < 0.02, f"it moves: {max(speeds)} m/s"

def call(name):
    client = person.create_client(Trigger, name)
    until(client.service_is_ready)
    future = client.call_async(Trigger.Request())
    until(future.done)
    return future.result()

drives()
call("safety_monitor/stop")
until(lambda: list(locked.values()) == ["true", "true"])
until(lambda: len(speeds) > 50 and max(speeds[-50:]) < 0.02)
call("reset")
stands()
for each in (["safety_node"], ["simulator_node"], ["safety_node", "simulator_node"]):
    restart(*each)
    stands()
assert call("safety_monitor/release_all").success
drives()
restart("simulator_node", "safety_node")
until(lambda: len(locked) == 2)
call("safety_monitor/release")  # what a node has stopped because of the restart, and no person's stop
drives()
print(json.dumps(sorted(each.get_name() for each in nodes.values())))
"""
WITHOUT_PYPI = "navigation_node"
"""It needs nav2_msgs, which PyPI does not have."""


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The prefix in which colcon would install the exported package."""
    prefix = tmp_path_factory.mktemp("install")
    place = export(tmp_path_factory.mktemp("src"))
    shutil.copytree(place / NAME, prefix / "lib" / NAME)
    for each in ("config", "launch", "worlds"):
        shutil.copytree(place / each, prefix / "share" / NAME / each)
    marker = prefix / "share/ament_index/resource_index/packages" / NAME
    marker.parent.mkdir(parents=True)
    marker.touch()
    return prefix


@pytest.mark.parametrize("profile", PROFILES)
def test_each_node_runs_with_the_profile_and_a_stop_holds_until_it_is_released(
    installed: Path, profile: str, tmp_path: Path
) -> None:
    nodes = sorted(each.stem for each in (installed / "lib" / NAME).glob("*_node.py") if each.stem != WITHOUT_PYPI)
    prefixes = os.pathsep.join(filter(None, (str(installed), os.environ.get("AMENT_PREFIX_PATH", ""))))
    config = installed / "share" / NAME / "config" / f"{profile}_config.yaml"
    done = subprocess.run(
        [sys.executable, "-c", DRIVEN, str(config), "robot", *nodes],
        env={**os.environ, "PYTHONPATH": str(installed / "lib"), "AMENT_PREFIX_PATH": prefixes,
             "BOT_CONSOLE_STOP_FILE": str(tmp_path / "stops.json"), "ROS_LOG_DIR": str(tmp_path),
             "ROS_DOMAIN_ID": str(unused_domain())},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    assert len(nodes) == 8 and done.stdout.count('"') == 2 * len(nodes), done.stdout
    assert "Traceback" not in done.stderr
