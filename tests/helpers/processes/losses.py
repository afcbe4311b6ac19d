"""Ways in which a robot loses the person who drives it or has stopped it, each checked by the witness.

Each function makes a driving robot come to rest, watches it stand, hands it back, and sees it drive again. It returns
how long (s) the robot kept moving. The other steps may take any time.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from emulator import screen_of

from processes.live_robot import BLIND, MOVING, TIMEOUT_S, LiveRobot

sys.path.insert(0, str(Path(__file__).parents[2] / "acceptance" / "console"))
from terminal import Terminal

SILENCE = 1.0
"""Seconds of silence after which a robot considers a steering console to be gone."""
DEAD_MAN = 2.0
"""Seconds without a key after which the steering pane stops the robot."""
BRAKING = 2.0
"""Seconds that locking and braking may take on a busy machine."""
WATCHED = 2.0
"""Seconds for which the robot at rest is watched."""

SSH = """
import os, pty, sys
pid, master = pty.fork()
if pid == 0:
    os.execv(sys.executable, [sys.executable, *sys.argv[1:]])
import fcntl, struct, termios
fcntl.ioctl(master, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 120, 0, 0))
import select, tty
tty.setraw(0)
print(f"pid={pid}.", flush=True)
while True:
    ready, _, _ = select.select([0, master], [], [])
    if 0 in ready:
        os.write(master, os.read(0, 65536))
    if master in ready:
        os.write(1, os.read(master, 65536))
"""
"""Acts as sshd does for a console: it holds the other end of its terminal."""


@contextlib.contextmanager
def console(robot: LiveRobot, words: Sequence[str] = (), wanted: str = "robot_navigator") -> Iterator[Terminal]:
    """A console attached to the robot, or started with other arguments of Python; its screen shows the wanted text."""
    with _environment(robot.environment):
        terminal = Terminal(words or robot.attach, robot.folder)
    try:
        shows = screen_of(terminal)
        terminal.read_until(lambda: shows(wanted), f"text {wanted!r}")
        yield terminal
    finally:
        if terminal.process.poll() is None:
            terminal.process.send_signal(signal.SIGCONT)
        terminal.close()


@contextlib.contextmanager
def _environment(wanted: dict[str, str]) -> Iterator[None]:
    before = dict(os.environ)
    os.environ.update(wanted)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


def steer(robot: LiveRobot, terminal: Terminal) -> None:
    """Arm steering and turn on the spot until the witness sees it."""
    terminal.type("6")
    terminal.read_until(lambda: b"disarmed" in terminal.output, "the steering pane")
    terminal.read_until(lambda: b"cmd_vel" in terminal.output, "the topic that is steered by")
    terminal.type("\r")
    terminal.read_until(lambda: b"ARMED" in terminal.output, "the armed steering")
    robot.until(
        lambda: not [each for each in robot.speeds(time.monotonic() - 0.3) if each[1] > MOVING], "robot at rest"
    )
    began = time.monotonic()
    while not any(speed > MOVING for _, speed in robot.speeds(began)):
        assert time.monotonic() < began + TIMEOUT_S, "the robot does not follow the keys"
        terminal.type("a")
        terminal.drain(0.1)


def dead_man(robot: LiveRobot) -> float:
    """No key is pressed."""
    with console(robot) as terminal:
        steer(robot, terminal)
        lost = time.monotonic()
        went_on = rests(robot, lost, DEAD_MAN, terminal)
        hand_back(robot, terminal)
    return went_on


def frozen_console(robot: LiveRobot) -> float:
    """The console's process is stopped (SIGSTOP), then continued."""
    with console(robot) as terminal:
        steer(robot, terminal)
        lost = time.monotonic()
        terminal.process.send_signal(signal.SIGSTOP)
        went_on = rests(robot, lost, SILENCE)
        terminal.process.send_signal(signal.SIGCONT)
        rests(robot, time.monotonic(), 0.0, terminal)
        hand_back(robot, terminal)
    return went_on


def killed_console(robot: LiveRobot) -> float:
    """The console is killed (-9)."""
    with console(robot) as terminal:
        steer(robot, terminal)
        lost = time.monotonic()
        terminal.process.kill()
        went_on = rests(robot, lost, SILENCE)
    release_all(robot)
    return went_on


def closed_terminal(robot: LiveRobot) -> float:
    """The window of the console is closed."""
    with console(robot) as terminal:
        steer(robot, terminal)
        lost = time.monotonic()
        terminal.hang_up()
        went_on = rests(robot, lost, SILENCE)
        assert terminal.process.wait(TIMEOUT_S) == 129
    release_all(robot)
    return went_on


def lost_connection(robot: LiveRobot) -> float:
    """The process that holds the console's terminal, as sshd does, is killed (-9)."""
    with console(robot, ["-c", SSH, *robot.attach]) as terminal:
        steer(robot, terminal)
        child = int(terminal.output.partition(b"pid=")[2].partition(b".")[0])
        lost = time.monotonic()
        terminal.process.kill()
        terminal.process.wait()
        went_on = rests(robot, lost, SILENCE)
        robot.until(lambda: not is_alive(child), "end of the console")
    release_all(robot)
    return went_on


def second_driver(robot: LiveRobot) -> float:
    """Another program publishes on the base's own topic, a hundred times a second; ALL STOP comes from a shell."""
    driver = robot.second_driver()
    robot.drives()
    robot.until(lambda: len(robot.speeds(time.monotonic() - 1.0)) > 0, "odometry")
    assert robot.run_cli("stop", "the arm swings") == 0
    went_on = rests(robot, time.monotonic(), 0.0)
    assert robot.run_cli("release") == 0
    robot.drives()
    driver.kill()
    return went_on


def stopped_then_killed(robot: LiveRobot) -> float:
    """ALL STOP from a console that is killed (-9) at once."""
    return _stopped_then(robot, signal.SIGKILL)


def stopped_then_frozen(robot: LiveRobot) -> float:
    """ALL STOP from a console whose process is stopped at once."""
    return _stopped_then(robot, signal.SIGSTOP)


def _stopped_then(robot: LiveRobot, number: signal.Signals) -> float:
    driver = robot.second_driver()
    with console(robot) as terminal:
        terminal.type("!")
        terminal.read_until(lambda: b"held" in terminal.output, "the acknowledged stop")
        held = time.monotonic()
        terminal.process.send_signal(number)
        went_on = rests(robot, held, 0.0)
    assert robot.run_cli("release", "--all") == 0
    robot.drives()
    driver.kill()
    return went_on


def killed_monitor(robot: LiveRobot) -> float:
    """The safety monitor is killed (-9) while another program drives, and restarted."""
    driver = robot.second_driver()
    robot.drives()
    lost = time.monotonic()
    robot.monitor.kill()
    robot.monitor.wait()
    went_on = rests(robot, lost, SILENCE)
    began = time.monotonic()
    robot.start_monitor()
    rests(robot, began, 0.0)
    assert robot.run_cli("release") == 0
    robot.drives()
    driver.kill()
    return went_on


def blind_scans(robot: LiveRobot) -> float:
    """Scans and commands of NaN, a hundred times a second: nothing is known about obstacles, yet the monitor keeps
    running."""
    robot.drives()
    blind = robot.program(BLIND)
    time.sleep(WATCHED)
    blind.kill()
    blind.wait()
    robot.drives()
    assert robot.monitor.poll() is None, "the safety monitor has ended"
    return 0.0


STOPS = (second_driver, stopped_then_killed, stopped_then_frozen)
PERSONS = (dead_man, frozen_console, killed_console, closed_terminal, lost_connection)
MONITORS = (killed_monitor, blind_scans)
GROUPS: dict[str, tuple[Callable[[LiveRobot], float], ...]] = {"stop": STOPS, "person": PERSONS, "monitor": MONITORS}


def rests(robot: LiveRobot, since: float, after: float, terminal: Terminal | None = None) -> float:
    """Watch the robot stand; a console's screen is read meanwhile, since its terminal would block otherwise."""
    while terminal is not None and time.monotonic() < since + after + BRAKING + WATCHED:
        terminal.drain(0.1)
    return robot.rests(since, after + BRAKING, WATCHED)


def hand_back(robot: LiveRobot, terminal: Terminal) -> None:
    """Press one key, after which the robot's own program drives."""
    terminal.type("!")
    began = time.monotonic()
    while not any(speed > MOVING for _, speed in robot.speeds(began)):
        assert time.monotonic() < began + TIMEOUT_S, f"it is not handed back: {terminal.output[-800:]!r}"
        terminal.drain(0.1)


def release_all(robot: LiveRobot) -> None:
    """Release by command line, since no console is left that could hand the robot back."""
    assert robot.run_cli("release") == 1, "a plain release must not release another person's stop"
    assert robot.run_cli("release", "--all") == 0
    robot.drives()


def is_alive(pid: int) -> bool:
    """Whether a process runs."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"
