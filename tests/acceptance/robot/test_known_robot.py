"""The simulated robot offers what programs written for other robots expect: frames, signals, goals, names."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import pytest
from systems import Program, System, system

PACKAGE = "bot_console_robot"
NAV = "nav2_msgs/action"


@pytest.fixture
def running() -> Iterator[System]:
    with system() as found:
        yield found


def robot(running: System, *words: str) -> Program:
    """Start the simulator and let it run for a while."""
    program = running.executable(PACKAGE, "simulator_node", "--ros-args", *words)
    running.run(0.5)
    return program


def navigator(running: System) -> Program:
    program = running.executable(PACKAGE, "navigation_node")
    running.run(1.0)
    return program


def once(running: System, topic: str, *words: str) -> str:
    return running.ask("topic", "echo", "--once", topic, *words).stdout


def place(running: System) -> tuple[float, float]:
    return position(once(running, "/ground_truth"))


def position(text: str) -> tuple[float, float]:
    """The first position in a message."""
    x, y = (float(re.findall(rf"position:\n(?:.*\n)*?\s+{axis}: ([-\d.e]+)", text)[0]) for axis in "xy")
    return x, y


def heading(running: System) -> float:
    turn = once(running, "/ground_truth").partition("orientation:")[2]
    z, w = (float(re.findall(rf"\s{axis}: ([-\d.e]+)", turn)[0]) for axis in "zw")
    return 2.0 * math.atan2(z, w)


def goal(running: System, name: str, kind: str, fields: str, *words: str) -> str:
    return running.ask("action", "send_goal", f"/{name}", f"{NAV}/{kind}", fields, *words).stdout


def test_frames_lead_from_map_to_every_sensor(running: System) -> None:
    robot(running)
    echo = running.executable("tf2_ros", "tf2_echo", "map", "base_scan")
    wheel = running.executable("tf2_ros", "tf2_echo", "odom", "wheel_left_link")
    running.run(2.5)
    x, y = place(running)
    found = re.findall(r"Translation: \[([-\d.]+), ([-\d.]+), ([-\d.]+)\]", echo.stdout)[-1]
    assert tuple(map(float, found)) == pytest.approx((x, y, 0.18), abs=0.01)
    assert "- Translation:" in wheel.stdout


def test_odometry_names_the_frame_that_tf_moves(running: System) -> None:
    robot(running)
    moved = once(running, "/tf")
    assert "child_frame_id: base_footprint\n" in once(running, "/odom")
    assert "frame_id: odom\n  child_frame_id: base_footprint\n" in moved


def test_map_to_odom_corrects_drifted_odometry(running: System) -> None:
    robot(running, "-p", "odometry.heading_noise:=0.3", "-p", "odometry.distance_noise:=0.3")
    echo = running.executable("tf2_ros", "tf2_echo", "map", "base_footprint")
    running.ask(
        "topic",
        "pub",
        "-r",
        "10",
        "-t",
        "30",
        "/cmd_vel",
        "geometry_msgs/msg/Twist",
        "{linear: {x: 0.4}, angular: {z: 0.5}}",
    )
    running.run(3.0)
    reported = once(running, "/odom")
    x, y = place(running)
    found = re.findall(r"Translation: \[([-\d.]+), ([-\d.]+), ", echo.stdout)[-1]
    assert tuple(map(float, found)) == pytest.approx((x, y), abs=0.002)
    turn = float(re.findall(r"RPY \(radian\) \[[-\d.]+, [-\d.]+, ([-\d.]+)\]", echo.stdout)[-1])
    assert turn == pytest.approx(heading(running), abs=0.002)
    assert f"{x:.3f}" not in reported


def test_joint_states_imu_and_battery_are_published(running: System) -> None:
    robot(running)
    running.ros2("topic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/msg/Twist", "{linear: {x: 0.33}}")
    running.run(3.0)
    joints = once(running, "/joint_states")
    assert "- wheel_left_joint\n- wheel_right_joint\n" in joints
    speeds = re.findall(r"velocity:\n- ([-\d.]+)\n- ([-\d.]+)", joints)[0]
    assert tuple(map(float, speeds)) == pytest.approx((10.0, 10.0), abs=0.1)
    assert "frame_id: imu_link" in once(running, "/imu")
    battery = once(running, "/battery_state")
    assert 0.99 < float(re.findall(r"percentage: ([\d.]+)", battery)[0]) < 1.0


def test_right_wheel_is_faster_in_a_left_turn(running: System) -> None:
    robot(running)
    twist = "{linear: {x: 0.2}, angular: {z: 1.0}}"
    running.ros2("topic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/msg/Twist", twist)
    running.run(3.0)
    left, right = re.findall(r"velocity:\n- ([-\d.]+)\n- ([-\d.]+)", once(running, "/joint_states"))[0]
    assert float(right) - float(left) > 1.0
    assert float(re.findall(r"angular_velocity:\n(?:.*\n){2}\s+z: ([-\d.]+)", once(running, "/imu"))[0]) > 0.9


@pytest.mark.slow
def test_map_and_odometry_start_at_the_robot(running: System) -> None:
    robot(running, "-p", "origin:=start", "-p", "odometry.distance_noise:=0.0")
    navigator(running)
    assert place(running) == (0.0, 0.0)
    assert math.hypot(*position(once(running, "/odom"))) == 0.0
    assert position(once(running, "/map", "--no-arr")) == (-2.4, -2.4)
    assert position(once(running, "/route")) == pytest.approx((6.5 - 2.4, 3.45 - 2.4))
    echo = running.executable("tf2_ros", "tf2_echo", "map", "base_footprint")
    assert "SUCCEEDED" in goal(
        running, "navigate_to_pose", "NavigateToPose", "{pose: {pose: {position: {x: 1.0, y: -1.0}}}}"
    )
    assert place(running) == pytest.approx((1.0, -1.0), abs=0.2)
    running.run(1.5)
    found = re.findall(r"Translation: \[([-\d.]+), ([-\d.]+), ", echo.stdout)[-1]
    assert tuple(map(float, found)) == pytest.approx(place(running), abs=0.002)
    pose = "{pose: {pose: {position: {x: 0.5, y: 0.25}}}}"
    running.ask("topic", "pub", "--once", "/initialpose", "geometry_msgs/msg/PoseWithCovarianceStamped", pose)
    assert place(running) == (0.5, 0.25)


def test_unknown_origin_is_refused(running: System) -> None:
    refused = running.finish(running.executable(PACKAGE, "simulator_node", "--ros-args", "-p", "origin:=middle"))
    assert refused.exit == 1
    assert "origin must be one of corner, start, not 'middle'" in refused.stderr


def test_signals_are_listed_and_reach_late_subscribers(running: System) -> None:
    robot(running)
    running.run(1.0)
    listed = running.ask("topic", "list").stdout.split()
    assert {"/tf", "/tf_static", "/joint_states", "/imu", "/battery_state"} <= set(listed)
    text = (
        "import rclpy; rclpy.init(); node = rclpy.create_node('late'); got = []\n"
        "from sensor_msgs.msg import Imu\n"
        "from rclpy.qos import QoSProfile, DurabilityPolicy\n"
        "node.create_subscription(Imu, 'imu', got.append, 10)\n"
        "rclpy.spin_once(node, timeout_sec=1.0); print(len(got))"
    )
    assert running.finish(running.python("-c", text)).stdout == "1\n"


@pytest.mark.slow
def test_first_beam_of_turtlebot_3_points_forward(running: System) -> None:
    robot(running, "-p", "model:=turtlebot3", "-p", "lidar.field_of_view:=6.265732014659643", "-p", "lidar.noise:=0.0")
    scan = once(running, "/scan")
    assert "angle_min: 0.0\n" in scan
    ahead = float(scan.partition("ranges:\n- ")[2].split()[0])
    plain = robot(running, "-p", "lidar.noise:=0.0", "-p", "lidar.beams:=359", "-r", "__ns:=/plain")
    assert plain.exit is None
    ranges = once(running, "/plain/scan", "--full-length").partition("ranges:\n- ")[2].partition("intensities")[0]
    assert float(ranges.split("\n- ")[179]) == pytest.approx(ahead, abs=0.02)


@pytest.mark.parametrize(("model", "frame"), [("turtlebot3", "base_scan"), ("turtlebot4", "rplidar_link")])
def test_names_of_other_models_are_used(running: System, model: str, frame: str) -> None:
    robot(running, "-p", f"model:={model}")
    assert f"frame_id: {frame}\n" in once(running, "/scan")


def test_unknown_model_is_refused(running: System) -> None:
    refused = running.finish(running.executable(PACKAGE, "simulator_node", "--ros-args", "-p", "model:=tank"))
    assert refused.exit == 1
    assert "model must be one of plain, turtlebot3, turtlebot4, not 'tank'" in refused.stderr


def test_stamped_velocities_are_obeyed_if_enabled(running: System) -> None:
    robot(running, "-p", "enable_stamped_cmd_vel:=true")
    before = place(running)
    words = ("/cmd_vel", "geometry_msgs/msg/TwistStamped", "{twist: {linear: {x: 0.5}}}")
    running.ask("topic", "pub", "-r", "10", "-t", "20", *words)
    assert math.dist(before, place(running)) > 0.5


def test_robot_drives_to_a_goal(running: System) -> None:
    robot(running)
    navigator(running)
    x, y = place(running)
    fields = f"{{pose: {{header: {{frame_id: map}}, pose: {{position: {{x: {x + 1.5}, y: {y + 0.8}}}}}}}}}"
    done = goal(running, "navigate_to_pose", "NavigateToPose", fields, "--feedback")
    assert "Goal finished with status: SUCCEEDED" in done
    left = [float(each) for each in re.findall(r"distance_remaining: ([\d.]+)", done)]
    assert left[0] > 1.0 > left[-1]
    assert place(running) == pytest.approx((x + 1.5, y + 0.8), abs=0.2)
    assert "collisions': 0" in running.ask("service", "call", "/report", "std_srvs/srv/Trigger").stdout.replace(
        '"', "'"
    )


def test_goal_in_a_wall_is_aborted_with_the_reason(running: System) -> None:
    robot(running)
    nav = running.executable(PACKAGE, "navigation_node")
    running.run(1.0)
    done = goal(running, "navigate_to_pose", "NavigateToPose", "{pose: {pose: {position: {x: -5.0, y: -5.0}}}}")
    assert "ABORTED" in done and "error_code: 208" in done
    assert "Goal failed: the goal is inside a wall or outside the map" in nav.stderr


@pytest.mark.slow
def test_spin_back_up_and_wait_succeed(running: System) -> None:
    robot(running)
    navigator(running)
    assert "SUCCEEDED" in goal(running, "spin", "Spin", "{target_yaw: 1.57}")
    before = place(running)
    assert "SUCCEEDED" in goal(running, "backup", "BackUp", "{target: {x: 0.3}, speed: 0.2}")
    assert math.dist(before, place(running)) == pytest.approx(0.3, abs=0.12)
    assert "SUCCEEDED" in goal(running, "wait", "Wait", "{time: {sec: 2}}")


def test_newer_goal_replaces_the_older(running: System) -> None:
    robot(running)
    navigator(running)
    x, y = place(running)
    far = f"{{pose: {{pose: {{position: {{x: {x + 1.5}, y: {y}}}}}}}}}"
    first = running.ros2("action", "send_goal", "/navigate_to_pose", f"{NAV}/NavigateToPose", far)
    running.run(1.5)
    assert "SUCCEEDED" in goal(running, "spin", "Spin", "{target_yaw: 0.5}")
    running.finish(first)
    assert "ABORTED" in first.stdout


@pytest.mark.slow
def test_waypoints_are_followed_and_missed_ones_reported(running: System) -> None:
    robot(running)
    navigator(running)
    x, y = place(running)
    poses = [(x + 0.8, y), (-9.0, -9.0), (x, y)]
    listed = ", ".join(f"{{pose: {{position: {{x: {each[0]}, y: {each[1]}}}}}}}" for each in poses)
    done = goal(running, "follow_waypoints", "FollowWaypoints", f"{{poses: [{listed}]}}")
    assert "SUCCEEDED" in done
    assert re.findall(r"- index: (\d+)", done) == ["1"]


def test_waiting_for_nav2_returns_at_once(running: System) -> None:
    robot(running)
    navigator(running)
    for name in ("amcl", "bt_navigator"):
        state = running.ask("service", "call", f"/{name}/get_state", "lifecycle_msgs/srv/GetState").stdout
        assert "label='active'" in state
    assert "frame_id: map" in once(running, "/amcl_pose")


@pytest.mark.slow
def test_goal_topic_needs_no_action_client(running: System) -> None:
    robot(running)
    program = navigator(running)
    x, y = place(running)
    words = ("/goal_pose", "geometry_msgs/msg/PoseStamped", f"{{pose: {{position: {{x: {x + 1.0}, y: {y}}}}}}}")
    running.ask("topic", "pub", "--once", *words)
    running.run(15.0)
    assert place(running) == pytest.approx((x + 1.0, y), abs=0.2)
    assert program.stderr.count("Begin navigating") == program.stderr.count("Goal succeeded") == 1


COMMANDER = """
import rclpy
from geometry_msgs.msg import PoseStamped
from nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult

rclpy.init()
navigator = BasicNavigator()
start = PoseStamped()
start.header.frame_id = 'map'
start.pose.position.x, start.pose.position.y, start.pose.orientation.w = {x}, {y}, 1.0
navigator.setInitialPose(start)
navigator.waitUntilNav2Active()
goal = PoseStamped(header=start.header)
goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.w = {x} + 1.2, {y}, 1.0
path = navigator.getPath(start, goal)
print(len(path.poses), path.poses[-1].pose.position.x)
print(navigator.goToPose(goal))
while not navigator.isTaskComplete():
    feedback = navigator.getFeedback()
print(navigator.getResult(), round(feedback.distance_remaining, 0))
navigator.spin(0.8)
navigator.cancelTask()
while not navigator.isTaskComplete():
    pass
print(navigator.getResult())
navigator.backup(0.2, 0.1)
while not navigator.isTaskComplete():
    pass
print(navigator.getResult())
goal.pose.position.x = -99.0
print(navigator.getPath(start, goal))
navigator.lifecycleShutdown()
"""


@pytest.mark.slow
def test_nav2_simple_commander_drives_the_robot(running: System) -> None:
    robot(running)
    navigator(running)
    x, y = place(running)
    commander = running.finish(running.python("-c", COMMANDER.format(x=x, y=y)))
    assert commander.stdout.splitlines() == [
        f"2 {x + 1.2}",
        "True",
        "TaskResult.SUCCEEDED 0.0",
        "TaskResult.CANCELED",
        "TaskResult.SUCCEEDED",
        "None",
    ]
    assert "Nav2 is ready for use!" in commander.stderr
    assert "Getting path failed with status code: 6" in commander.stderr
