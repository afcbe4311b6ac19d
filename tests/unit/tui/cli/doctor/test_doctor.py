"""Each finding of the doctor reports a state and how to fix it; only failures make the exit code 1."""

import json
import os
import subprocess
import sys

import pytest
from bot_console.tui.cli import doctor
from bot_console.tui.cli.doctor.command_timeout import base_finding
from bot_console.tui.cli.doctor.finding import DoctorFinding, Level, exit_code
from bot_console.tui.cli.doctor.graph_checks import pair_findings, type_findings
from bot_console.tui.cli.doctor.machine import domain_finding, python_finding, rclpy_finding, sockets_findings
from bot_console.tui.cli.doctor.system import link_finding
from bot_console.tui.cli.doctor.terminal import characters_finding, colours_finding, size_finding
from bot_console.tui.cli.doctor.terminal import terminal_link_finding as terminal_link
from bot_console.tui.cli.shell_python import ShellPython
from domains import unused_domain
from example_interfaces.action import Fibonacci
from fakes.ros_installation import make_standin
from geometry_msgs.msg import Twist
from processes.command_line import run_cli
from rclpy.action import ActionServer
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String


@pytest.fixture
def node(monkeypatch):
    monkeypatch.setattr("bot_console.tui.cli.doctor.command_timeout.spin_for", lambda *a, **k: None)
    context = Context()
    context.init([], domain_id=unused_domain())
    made = Node("base", context=context)
    yield made
    made.destroy_node()
    context.try_shutdown()


@pytest.mark.parametrize(
    ("finding", "level"),
    [
        (size_finding(120, 40), Level.OK),
        (size_finding(50, 20), Level.FAIL),
        (characters_finding("UTF-8"), Level.OK),
        (characters_finding("ANSI_X3.4-1968"), Level.WARN),
        (colours_finding({"TERM": "xterm-256color"}), Level.OK),
        (colours_finding({"TERM": "vt100"}), Level.WARN),
        (colours_finding({}), Level.WARN),
        (terminal_link(0.02, 1e6), Level.OK),
        (terminal_link(0.5, 1e6), Level.WARN),
        (terminal_link(0.02, 1e3), Level.WARN),
        (terminal_link(None, None), Level.NOTE),
        (python_finding((3, 11)), Level.OK),
        (python_finding((3, 9)), Level.WARN),
        (domain_finding(""), Level.OK),
        (domain_finding("7"), Level.OK),
        (domain_finding("seven"), Level.FAIL),
        (domain_finding("200"), Level.WARN),
        (rclpy_finding(ShellPython("/bin/python3", sys.version_info[:2], True, "")), Level.OK),
        (rclpy_finding(ShellPython("/bin/python3", (3, 9), True, "")), Level.WARN),
        (rclpy_finding(ShellPython("/bin/python3", (3, 9), True, "/opt/ros/rclpy/__init__.py")), Level.OK),
        (link_finding("tcp/robot:7447", 0.01), Level.OK),
        (link_finding("tcp/robot:7447", 0.5), Level.WARN),
        (link_finding("tcp/robot:7447", None), Level.FAIL),
    ],
)
def test_faults_have_a_hint(finding: DoctorFinding, level: Level) -> None:
    assert finding.level is level
    assert bool(finding.hint) == (level in (Level.WARN, Level.FAIL))
    assert exit_code([finding]) == (level is Level.FAIL)


def test_terminal_speed_beyond_measurable_rate_is_reported_as_a_lower_bound() -> None:
    assert terminal_link(0.02, 1.5e6).text == "answers after 20 ms, takes 1,500 kB/s"
    assert terminal_link(0.02, 1.6e8).text == "answers after 20 ms, takes more than 3,000 kB/s"


def test_leftover_sockets_are_counted(socket_folder: str) -> None:
    assert [each.level for each in sockets_findings()] == [Level.OK]
    for name in ("99999999.0123abcd", "99999999.0123abcd.lock"):
        open(os.path.join(socket_folder, "0", name), "w").close()
    assert any("1 left over from programs that were killed" in each.text for each in sockets_findings())
    os.chmod(socket_folder, 0o755)
    (refused,) = sockets_findings()
    assert refused.level is Level.FAIL and "chmod 700" in refused.hint


def test_base_without_time_out_is_a_warning(node) -> None:
    assert base_finding(node).level is Level.NOTE
    node.create_subscription(Twist, "/cmd_vel", lambda message: None, 10)
    found = base_finding(node)
    assert found.level is Level.WARN and "/base" in found.text and "cmd_vel_timeout" in found.hint


@pytest.mark.parametrize(
    ("name", "value", "level", "reported"),
    [
        ("cmd_vel_timeout", 0.5, Level.OK, "/base cmd_vel_timeout 0.5: make sure that it is short"),
        ("command_timeout", 1, Level.OK, "/base command_timeout 1: make sure that it is short"),
        ("cmd_vel_timeout", 0.0, Level.WARN, "/base cmd_vel_timeout 0: it is switched off"),
        ("cmd_vel_timeout", True, Level.WARN, "none was found in /base"),
        ("topics.key.timeout", 0.5, Level.WARN, "none was found in /base"),
        ("bond_timeout", 4.0, Level.WARN, "none was found in /base"),
    ],
)
def test_names_of_time_outs_are_recognised_and_values_reported(node, monkeypatch, name, value, level, reported) -> None:
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)

    def serve(node, seconds, until):
        while not until():
            executor.spin_once(timeout_sec=0)

    monkeypatch.setattr("bot_console.tui.cli.doctor.command_timeout.spin_for", serve)
    node.create_subscription(Twist, "/cmd_vel", lambda message: None, 10)
    node.declare_parameter(name, value)
    found = base_finding(node)
    assert found.level is level and found.text.startswith(reported)


def test_mismatched_pairs_and_unknown_types_are_reported(node) -> None:
    assert [each.level for each in pair_findings(node)] == [Level.OK]
    weak = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    node.create_publisher(String, "/words", weak)
    node.create_subscription(String, "/words", lambda message: None, 10)
    (found,) = pair_findings(node)
    assert found.level is Level.WARN and found.text.startswith("/words: /base receives nothing from /base")
    assert found.hint == "change the QoS of one of them"
    assert [each.level for each in type_findings(node)] == [Level.OK]


def test_feedback_of_an_action_is_of_a_known_type(node) -> None:
    server = ActionServer(node, Fibonacci, "/count", lambda goal: Fibonacci.Result())
    assert [each.text for each in type_findings(node)] == ["all are known here"]
    server.destroy()


def test_types_that_nodes_describe_are_learned_and_others_unknown(node, monkeypatch) -> None:
    monkeypatch.setattr("bot_console.tui.cli.doctor.graph_checks.own_hash", lambda type_name: None)
    node.create_publisher(String, "/words", 1)
    found = type_findings(node, lambda type_name: type_name.startswith("std_msgs/"))
    levels = {each.level: each.text for each in found}
    assert levels[Level.OK] == "learned from their nodes on use: std_msgs/msg/String"
    assert levels[Level.NOTE] == "unknown here: rcl_interfaces/msg/Log, rcl_interfaces/msg/ParameterEvent"


def test_topic_with_two_types_is_reported_as_such(node) -> None:
    node.create_publisher(String, "/words", 1)
    node.create_subscription(Twist, "/words", lambda message: None, 1)
    (found,) = pair_findings(node)
    assert found.text == "/words: /base publishes std_msgs/msg/String, /base expects geometry_msgs/msg/Twist"
    assert [each.level for each in type_findings(node)] == [Level.OK]


def run(*words: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "bot_console.tui", "doctor", *words]  # this chooses another rclpy while it starts
    return subprocess.run(line, capture_output=True, text=True, timeout=240, check=False)


def test_ros_that_does_not_start_is_reported(tmp_path, monkeypatch) -> None:
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / "__init__.py").write_text("raise ImportError('librcl.so: cannot open shared object file')")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    done = run("--ros")
    assert done.returncode == 1 and not done.stderr
    assert "does not start: librcl.so" in done.stdout and "ros2 node list" in done.stdout


@pytest.fixture
def range_off(tmp_path_factory, monkeypatch) -> None:
    """An installed ROS 2 whose range finds no other node."""
    for name, value in make_standin(tmp_path_factory.mktemp("opt")).items():
        monkeypatch.setenv(name, value)
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")


@pytest.mark.slow
@pytest.mark.usefixtures("range_off")
def test_without_other_nodes_doctor_says_which_range_to_try() -> None:
    done = run("--ros", "--seconds", "0.2")
    assert "range OFF, which finds no other node" in done.stdout
    assert "no other node was found\n    → search the network: bot-console doctor --ros --range SUBNET" in done.stdout


def test_finding_names_both_ranges(monkeypatch) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    found = doctor._change_range("LOCALHOST")
    assert found.text.startswith("searching with LOCALHOST instead of OFF: domain 0, range LOCALHOST, this machine")
    assert os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"


@pytest.mark.slow
@pytest.mark.usefixtures("range_off")
def test_doctor_says_first_that_it_searches_another_range() -> None:
    first, *rest = run("--ros", "--seconds", "0.2", "--range", "LOCALHOST").stdout.splitlines()
    assert (
        first
        == "· range      searching with LOCALHOST instead of OFF: domain 0, range LOCALHOST, this machine only (lo)"
    )
    assert any(each.endswith("domain 0, range LOCALHOST, this machine only (lo)") for each in rest)
    assert run("--range", "SUBNET").returncode == 2


def test_findings_are_printed_as_json() -> None:
    done = run_cli("doctor", "--json")
    found = json.loads(done.stdout)
    assert done.returncode == 0 and not done.stderr
    assert {"terminal", "python", "ros", "rclpy", "domain", "sockets", "graph"} == {each["about"] for each in found}
    assert set(found[0]) == {"level", "about", "text", "hint", "mend"}


def test_unreachable_robot_fails_with_the_reason() -> None:
    done = run_cli("doctor", "--connect", "tcp/127.0.0.1:1")
    assert done.returncode == 1
    assert "✗ link       FAIL: tcp/127.0.0.1:1: the host is there, but no router listens on port 1" in done.stdout


def test_wrong_usage_exits_with_2() -> None:
    assert run_cli("doctor", "--connect", "robot").returncode == 2
    assert run_cli("doctor", "--connect", "tcp/a:1", "--ros").returncode == 2


def test_closed_pipe_is_not_blamed_on_the_capture(monkeypatch, capsys):
    monkeypatch.setattr("bot_console.tui.session.embedded.domain.others_take_part", lambda: True)
    monkeypatch.setattr(
        "bot_console.tui.cli.doctor.system.examine", lambda *words: [DoctorFinding(Level.OK, "link", "is")]
    )

    def report(found):
        raise BrokenPipeError

    with pytest.raises(BrokenPipeError):
        doctor._zenoh(None, 0.0, None, report)
    assert capsys.readouterr().err == ""
