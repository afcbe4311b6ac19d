"""A launch file whose nodes need a robot gets the simulated one beside it; no other launch file does."""

import sys
from pathlib import Path

import pytest
from processes.command_line import run_cli

sys.path.insert(0, str(Path(__file__).parent))
from headless import headless

NODES = {
    "driver": "node.create_publisher(Twist, 'cmd_vel', 10), "
    "node.create_subscription(LaserScan, 'scan', lambda scan: made[0].publish(twist), 10)",
    "watcher": "node.create_subscription(Odometry, 'odom', lambda odometry: None, 10),",
    "lidar": "node.create_publisher(LaserScan, 'scan', 10),",
    "blind": "node.create_publisher(Twist, 'velocity', 10),",
}
NODE = """import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan

twist = Twist()
twist.linear.x = 0.2
twist.angular.z = 0.3
rclpy.init()
node = rclpy.create_node({name!r})
made = ({endpoints})
rclpy.spin(node)
"""
LAUNCH = """from launch import LaunchDescription
from launch.actions import GroupAction, OpaqueFunction, Shutdown, TimerAction
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription({entities})
"""
BESIDE = "the simulated robot runs beside it"


def write(folder, *entities):
    """Write a launch file of nodes; `driver` stands for the node of that name, other entities are used as they are."""
    for name, endpoints in NODES.items():
        (folder / f"{name}.py").write_text(NODE.format(name=name, endpoints=endpoints))
    actions = [f"Node(executable={str(folder / each)!r} + '.py')" if each in NODES else each for each in entities]
    (folder / "mine.launch.py").write_text(LAUNCH.format(entities=f"[{', '.join(actions)}]"))


def run(folder, *words, seconds="6"):
    words = ("--headless", "--fast", "--duration", seconds, "--launch", "mine.launch.py", *words)
    return run_cli(*words, cwd=folder)


@pytest.mark.slow
def test_nodes_that_need_a_robot_drive_the_simulated_one_reproducibly(tmp_path):
    write(tmp_path, "driver", "watcher")
    words = ("--duration", "8", "--seed", "3", "--world", "warehouse", "--launch", "mine.launch.py")
    first, second = (headless(tmp_path, *words) for _ in range(2))
    assert f"{BESIDE}, since nobody publishes /scan for /driver, nobody publishes /odom for /watcher" in first["log"]
    assert first["log"].count(BESIDE) == 1
    assert "nobody subscribes to /cmd_vel of /driver" in first["log"]
    assert (first["world"], first["seed"]) == ("warehouse", 3)
    assert first["distance"] > 0.5
    assert first["deterministic"] and second["deterministic"]
    assert (first["digest"], first["duration"]) == (second["digest"], second["duration"])


def test_node_with_stamped_velocities_moves_the_robot(tmp_path):
    write(tmp_path, "driver")
    file = tmp_path / "driver.py"
    text = file.read_text().replace("import Twist\n", "import Twist, TwistStamped\n")
    text = text.replace("create_publisher(Twist,", "create_publisher(TwistStamped,")
    file.write_text(text.replace("publish(twist)", "publish(TwistStamped(twist=twist))"))
    assert headless(tmp_path, "--duration", "8", "--launch", "mine.launch.py")["distance"] > 0.5


@pytest.mark.slow
def test_late_node_is_noticed(tmp_path):
    write(tmp_path, "TimerAction(period=5.0, actions=[Node(executable='driver.py')])")
    report = headless(tmp_path, "--duration", "12", "--launch", "mine.launch.py")
    assert report["distance"] > 0.2


def timer_action(period, *actions):
    return f"TimerAction(period={period}, actions=[{', '.join(actions)}])"


BRINGING = "Node(package='bot_console_robot', executable='simulator_node', name='simulator')"
WAITS = "waiting at most 30 s for what the launch file starts later, before a simulated robot is started"


@pytest.mark.parametrize(
    "bringing",
    [
        pytest.param(timer_action(5.0, BRINGING), marks=pytest.mark.soak),
        pytest.param(
            f"OpaqueFunction(function=lambda context: [{timer_action(5.0, BRINGING)}])", marks=pytest.mark.soak
        ),
        timer_action(2.0, timer_action(3.0, f"GroupAction([{BRINGING}])")),
    ],
    ids=["timer", "timer of a function", "timer of a timer"],
)
def test_launch_that_starts_a_robot_later_gets_no_second_one(tmp_path, bringing):
    write(tmp_path, "driver", bringing)
    log = headless(tmp_path, "--duration", "9", "--launch", "mine.launch.py")["log"]
    assert BESIDE not in log
    assert log.count(WAITS) == 1


@pytest.mark.soak
def test_delayed_start_without_a_robot_delays_the_simulated_robot_only_until_then(tmp_path):
    write(tmp_path, "driver", timer_action(4.0, "Node(executable='blind.py')"), timer_action(900.0, "Shutdown()"))
    report = headless(tmp_path, "--duration", "10", "--launch", "mine.launch.py")
    assert report["log"].count(WAITS) == report["log"].count(BESIDE) == 1


def test_long_delayed_start_is_not_waited_for(tmp_path):
    write(tmp_path, "driver", timer_action(900.0, "Node(executable='blind.py')"))
    report = headless(tmp_path, "--duration", "35", "--launch", "mine.launch.py")
    assert report["log"].count(WAITS) == report["log"].count(BESIDE) == 1


@pytest.mark.parametrize(
    "entities",
    [
        pytest.param(("driver", "lidar"), marks=pytest.mark.soak),
        pytest.param(("blind",), marks=pytest.mark.soak),
        pytest.param(("Node(executable='driver.py', namespace='other')",), marks=pytest.mark.soak),
        ("Node(executable='driver.py', remappings=[('scan', 'laser'), ('cmd_vel', 'velocity')])",),
    ],
    ids=["somebody gives it", "nobody wants it", "in a namespace", "remapped"],
)
def test_no_robot_is_started_if_none_is_needed(tmp_path, entities):
    write(tmp_path, *entities)
    done = run(tmp_path)
    assert done.returncode == 1
    assert BESIDE not in done.stderr
    assert "no simulator was started beside it, --simulator starts one" in done.stderr


def test_no_simulator_option_is_respected(tmp_path):
    write(tmp_path, "driver")
    done = run(tmp_path, "--no-simulator")
    assert (done.returncode, BESIDE in done.stderr) == (1, False)


def test_simulator_option_starts_one(tmp_path):
    write(tmp_path, "blind")
    report = headless(tmp_path, "--duration", "2", "--launch", "mine.launch.py", "--simulator")
    assert report["duration"] == 2.0


def test_launch_that_starts_a_robot_gets_no_second_one(tmp_path):
    write(tmp_path, "driver", BRINGING)
    assert BESIDE not in headless(tmp_path, "--duration", "4", "--launch", "mine.launch.py")["log"]


ASKS = """import rclpy
from sensor_msgs.msg import LaserScan

rclpy.init()
node = rclpy.create_node("asker")
node.create_subscription(LaserScan, "scan", lambda scan: None, 10)
looks = []
node.create_timer(0.1, lambda: looks.append(len(node.get_publishers_info_by_topic("/scan"))))
while len(looks) < MAX_LOOKS and not any(looks):
    rclpy.spin_once(node)
print("given by", looks[-1], flush=True)
"""


@pytest.mark.parametrize(
    ("words", "givers"),
    [
        (("run", "asks.py"), 0),
        pytest.param(("launch", "asks.launch.py"), 0, marks=pytest.mark.soak),
        pytest.param(("run", "--headless", "--duration", "600", "asks.py"), 1, marks=pytest.mark.slow),
    ],
    ids=["run", "launch", "run --headless"],
)
def test_run_and_launch_verbs_start_no_robot(tmp_path, monkeypatch, words, givers):
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    max_looks = 10**6 if givers else 30  # a delayed start may take its time
    (tmp_path / "asks.py").write_text(ASKS.replace("MAX_LOOKS", str(max_looks)))
    node = "Node(executable='./asks.py', output='screen')"
    (tmp_path / "asks.launch.py").write_text(LAUNCH.format(entities=f"[{node}]"))
    done = run_cli(*words, cwd=tmp_path)
    assert f"given by {givers}" in done.stdout + done.stderr, done.stderr
