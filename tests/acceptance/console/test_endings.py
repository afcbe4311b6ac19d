"""However the console ends, the robot gets a zero velocity and the terminal remains usable."""

import os
import signal
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from terminal import TIMEOUT_S, Terminal

WHEELS = """
import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException

rclpy.init()
node = rclpy.create_node("wheels")
file = open("{folder}/received", "a", buffering=1)
drive = node.create_publisher(Twist, "cmd_vel", 10)
command = Twist()
command.linear.x = 1.0
timer = node.create_timer(0.2, lambda: drive.publish(command))


def turn(message):
    file.write(f"{{message.linear.x}}\\n")
    if message.linear.x == 0.0:
        timer.cancel()


node.create_subscription(Twist, "cmd_vel", turn, 10)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""

LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([Node(executable="{folder}/wheels.py")])
"""

CRASH = """
import os
import sys
from pathlib import Path
from bot_console.tui.cli.main import main
from bot_console.tui.app import BotConsoleApp

pull = BotConsoleApp.pull

def crash(self):
    stray = Path("{folder}/stray")
    if stray.exists():
        os.write(2, b"from a library\\n")
        os.closerange(0, 3)
        stray.unlink()
    if Path("{folder}/crash").exists():
        raise ZeroDivisionError("a fault of the console")
    pull(self)

BotConsoleApp.pull = crash
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture
def console(tmp_path):
    """A console on a launch file with a driving robot."""
    (tmp_path / "wheels.py").write_text(WHEELS.format(folder=tmp_path))
    (tmp_path / "one.launch.py").write_text(LAUNCH.format(folder=tmp_path))
    (tmp_path / "program.py").write_text(CRASH.format(folder=tmp_path))
    received = tmp_path / "received"
    with Terminal(["program.py", "--launch", "one.launch.py"], tmp_path) as terminal:
        terminal.read_until(lambda: received.exists() and received.read_text().count("1.0") >= 3, "the driving robot")
        yield terminal


ENDS = {
    "q": lambda terminal: terminal.type("q"),
    "ctrl-c": lambda terminal: terminal.type("\x03"),
    "SIGTERM": lambda terminal: terminal.process.send_signal(signal.SIGTERM),
    "SIGHUP": lambda terminal: terminal.process.send_signal(signal.SIGHUP),
    "SIGINT": lambda terminal: terminal.process.send_signal(signal.SIGINT),
    "SIGQUIT": lambda terminal: terminal.process.send_signal(signal.SIGQUIT),
    "crash": lambda terminal: (terminal.folder / "crash").touch(),
}
CODES = {"q": 0, "ctrl-c": 0, "SIGTERM": 143, "SIGHUP": 129, "SIGINT": 130, "SIGQUIT": 131, "crash": 1}


OFTEN = ("crash",)
"""The cases of the default run, besides `q` and SIGHUP, which have separate tests below; each takes a console."""


def soak_unless_often(values, often):
    """All values as parameters; those not in `often` are marked for `-m soak`."""
    return [pytest.param(each, marks=() if each in often else pytest.mark.soak) for each in values]


@pytest.mark.parametrize("how", soak_unless_often(ENDS, OFTEN))
def test_robot_is_stopped_and_terminal_usable(console, how):
    before = len((console.folder / "received").read_text().splitlines())
    ENDS[how](console)
    assert console.wait() == CODES[how]
    commands = (console.folder / "received").read_text().splitlines()[before:]
    assert commands[-1] == "0.0"
    assert console.is_usable()


@pytest.mark.soak
def test_second_signal_does_not_break_the_end(console):
    console.process.send_signal(signal.SIGTERM)
    os.kill(console.process.pid, signal.SIGHUP)
    assert console.wait() in (143, 129)
    assert (console.folder / "received").read_text().splitlines()[-1] == "0.0"
    assert console.is_usable()


@pytest.mark.slow
def test_console_frozen_during_input_handles_keys_afterwards_and_ends_in_order(console):
    for _ in range(2):
        os.kill(console.process.pid, signal.SIGSTOP)
        os.waitpid(console.process.pid, os.WUNTRACED)
        os.kill(console.process.pid, signal.SIGCONT)
        console.drain(0.5)
    console.type("2")
    (console.folder / "stray").touch()
    console.read_until(
        lambda: b"from a library" in console.output, "what was written to a closed descriptor, in the log"
    )
    console.type("?")
    console.read_until(lambda: b"Help" in console.output, "the answer to a key")
    console.type("qq")
    assert console.wait() == 0
    assert (console.folder / "received").read_text().splitlines()[-1] == "0.0"
    assert console.is_usable()


@pytest.mark.slow
def test_vanished_terminal_ends_the_console(console):
    console.hang_up()
    assert console.process.wait(TIMEOUT_S) == 129
    assert (console.folder / "received").read_text().splitlines()[-1] == "0.0"


@pytest.mark.parametrize(
    "number", soak_unless_often((signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT), (signal.SIGKILL,))
)
def test_killed_console_leaves_no_process(console, number):
    console.process.send_signal(number)
    assert console.wait() == -number
    console.read_until(lambda: not console.processes(), "the end of all processes")
