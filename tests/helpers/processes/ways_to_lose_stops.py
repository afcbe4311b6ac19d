"""The ways in which a stop could get lost, for `kept_stops.held_through`."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from bot_console.tui.console.parameters.history_file import History
from emulator import last_screen, screen_of

from processes.bad_link import BadLink
from processes.kept_stops import StopScenario, drives_after_restart, wait
from processes.live_robot import TIMEOUT_S, LiveRobot
from processes.losses import WATCHED, Terminal, console, is_alive
from processes.ports import free_port

RECORDED = ("/emergency_stop/request", "/emergency_stop/arbiter", "/emergency_stop/base")
MONITOR, BASE = "safety_monitor", "simulator"
ESCAPE = "\x1b"
SEQUENCES = 150
"""How many sequences are typed at once: fewer bytes than a terminal buffers."""
PROMPT = "esc Cancel"
"""In the key bar while a line is typed."""
QUESTION = "y yes"
"""On the edge of a question."""
MOVES = "".join(f"\x1b[<35;{10 + at % 90};{5 + at % 30}M" for at in range(15_000))
FLOOD = MOVES + "\x1b[<65;60;20M" * 2000 + "12345678" * 200 + MOVES
"""Mouse moves, wheel steps and keys that change the pane."""
UNREADABLE_ROW = """
    (run, stamp, node, name, old, new, source, accepted, reason, part_of)
    VALUES (1, 1, '/robot', 'speed', '0.5', '1.0', 'edit', 1, CAST(x'ff41' AS TEXT), '')
"""
FAKETIME = Path("/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1")
NOTICED_S = 20.0
"""Seconds within which two busy locks notice that their file is gone; they check once a second."""
JUMPS = ("+7h", "-7h", "+0")
SLEEP = """
import threading
import time

time.sleep = lambda seconds: threading.Event().wait(seconds)
"""
"""Under libfaketime, `time.sleep` fails (EINVAL) because monotonic clocks are not faked."""
RESPAWNED = """
import sys
from launch import LaunchDescription
from launch.actions import ExecuteProcess

START = "import os, sys; open(sys.argv[1], 'w').write(str(os.getpid())); os.execv(sys.executable, sys.argv[2:])"


def lock(name, executable):
    line = [sys.executable, "-m", "bot_console.tui", "run", "bot_console_robot", executable]
    return ExecuteProcess(cmd=[sys.executable, "-c", START, name + ".pid", *line], respawn=True, respawn_delay=0.2)


def generate_launch_description():
    return LaunchDescription([lock("safety_monitor", "safety_node"), lock("simulator", "simulator_node")])
"""
"""Both locks, respawned by launch when they end."""


def instant(happen: Callable[[LiveRobot, Terminal], None]) -> Callable[..., contextlib.AbstractContextManager[None]]:
    """A disturbance that is over as soon as it has happened."""

    @contextlib.contextmanager
    def disturb(robot: LiveRobot, person: Terminal) -> Iterator[None]:
        happen(robot, person)
        yield

    return disturb


def kill(*processes: subprocess.Popen[bytes]) -> None:
    """Kill (-9) all processes before waiting for any of them."""
    for each in processes:
        each.kill()
    for each in processes:
        each.wait()


def monitor_killed(robot: LiveRobot, person: Terminal) -> None:
    """The safety monitor is killed (-9), and started again a second later."""
    kill(robot.monitor)
    wait(person, 1.0)
    robot.start_monitor()


def monitor_restarted(robot: LiveRobot, person: Terminal) -> None:
    """The safety monitor is killed and started at once."""
    kill(robot.monitor)
    robot.start_monitor()


def base_restarted(robot: LiveRobot, person: Terminal) -> None:
    """The base is killed and started at once."""
    kill(robot.base)
    robot.start_base()


def both_restarted(robot: LiveRobot, person: Terminal | None) -> None:
    """Both locks are killed before either of them starts."""
    kill(robot.monitor, robot.base)
    robot.start_base()
    robot.start_monitor()


def both_ended(robot: LiveRobot, person: Terminal) -> None:
    """Both locks end in order and start again."""
    for each in (robot.monitor, robot.base):
        each.send_signal(signal.SIGINT)
    for each in (robot.monitor, robot.base):
        each.wait(TIMEOUT_S)
    robot.start_base()
    robot.start_monitor()


@contextlib.contextmanager
def respawning(robot: LiveRobot) -> Iterator[Sequence[str]]:
    """The locks are processes of a launch file that starts them again."""
    kill(robot.monitor, robot.base)
    file = robot.folder / "respawned.launch.py"
    file.write_text(RESPAWNED)
    launched = robot.console("launch", str(file))
    try:
        robot.drives()
        yield robot.attach
    finally:
        launched.send_signal(signal.SIGINT)
        launched.wait(TIMEOUT_S)
        robot.start_base()
        robot.start_monitor()


def both_respawned(robot: LiveRobot, person: Terminal) -> None:
    """Both locks are killed, and their launch file starts them again."""
    with starting_again(robot, person):
        for each in (MONITOR, BASE):
            os.kill(int((robot.folder / f"{each}.pid").read_text()), signal.SIGKILL)


@contextlib.contextmanager
def starting_again(robot: LiveRobot, person: Terminal) -> Iterator[None]:
    """Raise unless both locks are restarted because of what happens in the block."""
    before = {name: len(robot.instances[name]) for name in (MONITOR, BASE)}
    yield
    deadline = time.monotonic() + TIMEOUT_S
    while any(len(robot.instances[name]) == count for name, count in before.items()):
        assert time.monotonic() < deadline, f"the locks were not started again: {person.output[-800:]!r}"
        wait(person, 0.1)


def relaunched(robot: LiveRobot, person: Terminal) -> None:
    """Another console restarts everything that was launched, from its Launch pane."""
    with (
        starting_again(robot, person),
        console(robot, [*robot.attach, "--pane", "launch"]) as other,
    ):
        shows, deadline = screen_of(other), time.monotonic() + TIMEOUT_S
        while not shows(QUESTION):
            assert time.monotonic() < deadline, f"no question:\n{last_screen(other)}"
            other.type("gr")
            wait(other, WATCHED)
        other.type("y")
        other.read_until(lambda: not shows(QUESTION), "the end of the question")
        wait(other, 3.0)


def another_world(robot: LiveRobot, person: Terminal) -> None:
    """Another console applies another profile and resets the simulator into its world."""
    before = _world(robot, person)
    name = "outdoor" if "warehouse" in before else "warehouse"
    with console(robot, [*robot.attach, "--pane", "profiles"], name) as other:
        deadline = time.monotonic() + TIMEOUT_S
        while name not in _world(robot, other):
            assert time.monotonic() < deadline, f"no other world:\n{last_screen(other)}"
            for keys in (ESCAPE, f"/{name}\r", "w", "y"):  # yes to the question whether limits may be raised
                other.type(keys)
                wait(other, 1.0)


def _world(robot: LiveRobot, meanwhile: Terminal) -> str:
    """The world of the simulator; a console's screen is read until it is known."""
    asked = robot.console("param", "get", "/simulator", "world", stdout=subprocess.PIPE)
    while asked.poll() is None:
        wait(meanwhile, 0.1)
    return asked.communicate()[0].decode()


def up_again(robot: LiveRobot, person: Terminal) -> None:
    """Somebody starts the system again while it is running, which is refused."""
    assert [robot.run_cli("up"), robot.run_cli("up", "warehouse")] == [1, 1]


def down_and_up(robot: LiveRobot, person: Terminal) -> None:
    """The system ends and starts again."""
    with starting_again(robot, person):
        assert robot.run_cli("down") == 0
        assert robot.run_cli("up", "indoor") == 0


def console_killed(robot: LiveRobot, person: Terminal) -> None:
    """The console that has stopped the robot is killed, and then both locks are."""
    kill(person.process)
    both_restarted(robot, person)


@contextlib.contextmanager
def console_frozen(robot: LiveRobot, person: Terminal) -> Iterator[None]:
    """The console that has stopped the robot is frozen while both locks restart, and continues later."""
    person.process.send_signal(signal.SIGSTOP)
    both_restarted(robot, person)
    yield
    person.process.send_signal(signal.SIGCONT)


class FarConsole:
    """A console that reaches the robot through a router and a link that can be cut."""

    def __init__(self) -> None:
        self._link: BadLink | None = None

    @contextlib.contextmanager
    def prepare(self, robot: LiveRobot) -> Iterator[Sequence[str]]:
        """Open the router and the link."""
        port = free_port()
        router = robot.console("router", "--mesh", "--listen", f"tcp/127.0.0.1:{port}")
        self._link = BadLink(port)
        try:
            yield [*robot.attach, "--connect", f"tcp/127.0.0.1:{self._link.port}"]
        finally:
            self._link.close()
            kill(router)

    @contextlib.contextmanager
    def cut(self, robot: LiveRobot, person: Terminal) -> Iterator[None]:
        """The link is cut while both locks restart, and is restored later."""
        assert self._link is not None
        self._link.cut()
        both_restarted(robot, person)
        yield
        self._link.restore()


def simulator_reset(robot: LiveRobot, person: Terminal) -> None:
    """The world is reset."""
    assert robot.run_cli("service", "call", "/reset", "std_srvs/srv/Trigger") == 0


@contextlib.contextmanager
def recording(robot: LiveRobot) -> Iterator[None]:
    """Record all messages about stops."""
    bag = robot.folder / "stops"
    shutil.rmtree(bag, ignore_errors=True)
    recorder = robot.console("bag", "record", "--output", str(bag), *RECORDED)
    robot.until((bag / "metadata.yaml").exists, "recording")
    wait(None, WATCHED)
    yield
    wait(None, 1.0)
    recorder.send_signal(signal.SIGINT)
    recorder.wait(TIMEOUT_S)


def bag_played(robot: LiveRobot, person: Terminal) -> None:
    """All recorded messages of an earlier stop and its release are sent again; the witness must see the release."""
    before = list(robot.releases)
    assert robot.run_cli("bag", "play", str(robot.folder / "stops"), "--topics", *RECORDED) == 0
    robot.until(lambda: len(robot.releases) > len(before), "release of the bag")
    assert set(robot.releases[len(before) :]) <= set(before), "a release other than the recorded one"


class Clocks:
    """A system clock that jumps, for all of the robot's processes and the console."""

    def __init__(self) -> None:
        self._file = Path()

    @contextlib.contextmanager
    def prepare(self, robot: LiveRobot) -> Iterator[Sequence[str]]:
        """Start the locks and the console with a clock that can be set; monotonic clocks are not faked.

        Shifted file times would have everything compiled again. With a current glibc, libfaketime's "fix" of monotonic
        deadlines makes timed waits end at once, so that threads that wait for the interpreter would poll.
        """
        assert FAKETIME.is_file(), f"there is no {FAKETIME}: install libfaketime"
        self._file, before = robot.folder / "clock", dict(robot.environment)
        (robot.folder / "sitecustomize.py").write_text(SLEEP)
        self._set("+0")
        robot.environment |= {
            "LD_PRELOAD": str(FAKETIME), "FAKETIME_TIMESTAMP_FILE": str(self._file), "FAKETIME_CACHE_DURATION": "1",
            "FAKETIME_DONT_FAKE_MONOTONIC": "1", "NO_FAKE_STAT": "1", "FAKETIME_FORCE_MONOTONIC_FIX": "0",
            "PYTHONPATH": str(robot.folder),
        }  # fmt: skip
        try:
            both_restarted_and_free(robot)
            yield robot.attach
        finally:
            robot.environment.clear()
            robot.environment.update(before)
            both_restarted_and_free(robot)

    def _set(self, offset: str) -> None:
        self._file.write_text(f"{offset}\n")

    def jump(self, robot: LiveRobot, person: Terminal) -> None:
        """The clock jumps by hours in both directions, and both locks restart between the jumps."""
        for each in JUMPS:
            self._set(each)
            line = [sys.executable, "-c", "import time; print(time.time())"]
            shown = float(subprocess.run(line, env=robot.environment, capture_output=True, check=True).stdout)
            assert each == "+0" or abs(shown - time.time()) > 6 * 3600, "the clock does not jump"
            wait(person, WATCHED)  # longer than libfaketime uses the last offset
            both_restarted(robot, person)
            wait(person, 1.0)


def both_restarted_and_free(robot: LiveRobot) -> None:
    """Restart both locks, and release the stops that they make because of it."""
    both_restarted(robot, None)
    drives_after_restart(robot, None)


def send(person: Terminal, text: str) -> None:
    """Type a long text, reading the screen meanwhile.

    The console reads only whole sequences as long as it keeps up: the first byte of one that arrives late and alone is
    the
    key Esc.
    """
    begin, *sequences = text.split(ESCAPE)
    person.type(begin)
    for at in range(0, len(sequences), SEQUENCES):
        person.type("".join(ESCAPE + each for each in sequences[at : at + SEQUENCES]))
        person.drain(0.001)
        while person.unread() and is_alive(person.process.pid):
            person.drain(0.001)


def press_behind_flood(robot: LiveRobot, person: Terminal) -> None:
    """Press the stop key behind thousands of mouse moves, wheel steps and keys."""
    send(person, FLOOD + "!")


def flood(robot: LiveRobot, person: Terminal) -> None:
    """Thousands of mouse moves, wheel steps and keys."""
    send(person, FLOOD)


def press_on_help(robot: LiveRobot, person: Terminal) -> None:
    """Press the stop key while another screen covers the panes."""
    person.type("?")
    wait(person, 1.0)
    person.type("!")


def typed_in_prompt(robot: LiveRobot, person: Terminal) -> None:
    """The stop key is typed as a character into a line, alone and behind other input."""
    shows = screen_of(person)
    person.type(ESCAPE)
    wait(person, WATCHED)  # or the two keys would be read as one with Alt
    person.type(":")
    person.read_until(lambda: shows(PROMPT), "the prompt")
    person.type("!")
    wait(person, 0.5)
    send(person, MOVES + "echo !!! !")
    wait(person, 1.0)
    person.type(ESCAPE)
    wait(person, 0.5)


@contextlib.contextmanager
def unreadable_stores(robot: LiveRobot) -> Iterator[Sequence[str]]:
    """The console's own files contain something else."""
    folder = robot.folder / "bot-console"
    History(folder / "history.sqlite", 1).close()
    with contextlib.closing(sqlite3.connect(folder / "history.sqlite")) as link, link:
        link.execute(f"INSERT INTO changes {UNREADABLE_ROW}")
    for each in folder.glob("*.*"):
        if each.suffix in (".json", ".yaml"):
            each.write_bytes(b"\xff{")
    yield robot.attach


def stop_with_undecodable_text(robot: LiveRobot, person: Terminal) -> None:
    """Stop from a shell for a reason, and as a user, that are not UTF-8."""
    environment = {name: "\udcff" for name in ("LOGNAME", "USER")}
    robot.run_cli("stop", b"\xff too close", environment=environment)


def damaged_stop_file(robot: LiveRobot, person: Terminal) -> None:
    """The file in which stops are kept is damaged, and both locks restart."""
    (robot.folder / "bot-console" / "stops" / f"domain-{robot.environment['ROS_DOMAIN_ID']}.json").write_bytes(b"\xff{")
    both_restarted(robot, person)


def lost_stop_file(robot: LiveRobot, person: Terminal) -> None:
    """The folder with the stop file is deleted; once the locks have had time to notice, everything else ends, too."""
    folder = robot.folder / "bot-console" / "stops"
    shutil.rmtree(folder)
    deadline = time.monotonic() + NOTICED_S
    while not list(folder.glob("*.json")) and time.monotonic() < deadline:
        wait(person, 0.1)
    console_killed(robot, person)


@contextlib.contextmanager
def monitor_frozen(robot: LiveRobot, person: Terminal) -> Iterator[None]:
    """The safety monitor is frozen, and continues later."""
    robot.monitor.send_signal(signal.SIGSTOP)
    yield
    robot.monitor.send_signal(signal.SIGCONT)


_far, _clocks = FarConsole(), Clocks()
SCENARIOS: tuple[StopScenario, ...] = (
    StopScenario(name="monitor killed", disturb=instant(monitor_killed)),
    StopScenario(name="monitor restarted", disturb=instant(monitor_restarted)),
    StopScenario(name="base restarted", disturb=instant(base_restarted)),
    StopScenario(name="both restarted", disturb=instant(both_restarted)),
    StopScenario(name="both ended", disturb=instant(both_ended)),
    StopScenario(name="both respawned", disturb=instant(both_respawned), prepare=respawning),
    StopScenario(name="console killed", disturb=instant(console_killed)),
    StopScenario(name="console frozen", disturb=console_frozen, releases_within=True),
    StopScenario(name="link cut", disturb=_far.cut, prepare=_far.prepare, releases_within=True),
    StopScenario(name="simulator reset", disturb=instant(simulator_reset)),
    StopScenario(name="bag played", disturb=instant(bag_played), beside_earlier_stop=recording),
    StopScenario(name="clock jump", disturb=instant(_clocks.jump), prepare=_clocks.prepare),
    StopScenario(name="mouse flood", disturb=instant(flood), stop=press_behind_flood),
    StopScenario(name="key in a prompt", disturb=instant(typed_in_prompt), stop=press_on_help),
    StopScenario(name="unreadable store", disturb=instant(both_restarted), prepare=unreadable_stores),
    StopScenario(name="unreadable stop file", disturb=instant(damaged_stop_file)),
    StopScenario(name="stop file lost", disturb=instant(lost_stop_file)),
    StopScenario(name="monitor frozen", disturb=monitor_frozen, releases_within=True),
    StopScenario(name="undecodable text", disturb=instant(both_restarted), stop=stop_with_undecodable_text),
    StopScenario(name="relaunched", disturb=instant(relaunched), in_background=True),
    StopScenario(name="another world", disturb=instant(another_world), in_background=True),
    StopScenario(name="up again", disturb=instant(up_again), in_background=True),
    StopScenario(name="down and up", disturb=instant(down_and_up), in_background=True),
)
