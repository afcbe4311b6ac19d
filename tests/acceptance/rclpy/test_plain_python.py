"""Programs print the same under `python3` in a shell that was set up, and under `bot-console run`."""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from helpers.recorded.programs import names, outcome
from helpers.shells import PYTHON, environment, make_home, set_up

if os.name != "posix":
    pytest.skip("needs a shell", allow_module_level=True)

PROGRAMS = Path(__file__).parent / "programs"
COURSE = Path(os.environ.get("BOT_CONSOLE_COURSE", "/nowhere")) / "nodes"
OUTPUT_TIMEOUT_S = 240.0


SETS_SPEED = """
import contextlib
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient

rclpy.init()
client = AsyncParameterClient(rclpy.create_node("sets_speed"), "robot")
with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
    client.wait_for_services()
    while rclpy.ok():  # again and again: nobody knows when the robot knows the watcher
        future = client.set_parameters([Parameter("speed", value=2.5)])
        rclpy.spin_until_future_complete(client.node, future)
        if future.done():
            print(future.result().results[0].successful)
"""
ASKS = """
import sys
import rclpy
from rclpy.parameter_client import AsyncParameterClient

rclpy.init()
node = rclpy.create_node("asks")
client = AsyncParameterClient(node, sys.argv[1])
client.wait_for_services()
future = client.list_parameters(prefixes=[])
rclpy.spin_until_future_complete(node, future)
print(sorted(future.result().result.names))
"""
"""A node whose answer shows that a program spins: a signal then interrupts it there, and not while it logs."""
OTHERS_END = "others end"
IN_ANY_ORDER = (
    "fibonacci", "single_goal", "lifecycle", "callback_groups two", "callback_groups reentrant", "spins_in_threads",
)  # fmt: skip
"""Programs with lines whose order depends on timing.

An action's first feedback may arrive before its response, messages come from two topics, and callbacks run in several
threads.
"""


class CommandLine(NamedTuple):
    """The arguments after `run` or `python3`, and when to interrupt the program.

    That is a pattern in its output, or the end of all other programs; with an empty pattern it ends by itself.
    """

    words: str
    until: str = ""


def demo(module: str, function: str) -> str:
    """The command line of a program of the tutorials."""
    return f"-c 'from bot_console_demos.demo_nodes.{module} import {function}; {function}()'"


def soak_after_first(values: Sequence[Any], *marks: pytest.MarkDecorator) -> list[Any]:
    """The values as parameters: the first with these marks, the others for the soak run."""
    return [pytest.param(each, marks=pytest.mark.soak if n else marks) for n, each in enumerate(values)]


COMMAND_GROUPS = [
    [CommandLine("listener", "I heard"), CommandLine("talker", "Publishing")],
    [CommandLine("add_server", "Incoming"), CommandLine("add_client async 2 3")],
    [CommandLine("add_server", "Incoming"), CommandLine("client_in_callback")],
    [CommandLine("fibonacci_server", "goal of order"), CommandLine("fibonacci_client 5 10.0")],
    [
        CommandLine("latched listener reliable transient_local", "map"),
        CommandLine("latched talker reliable transient_local", OTHERS_END),
    ],
    [
        CommandLine("lifecycle_listener", "finalized"),
        CommandLine("lifecycle_talker", "on_shutdown"),
        CommandLine("lifecycle_client"),
    ],
    [CommandLine("waits_for_message"), CommandLine("talker", "Publishing")],
    [CommandLine("sim_clock 10.0", OTHERS_END), CommandLine("talker --ros-args -p use_sim_time:=true", "Publishing")],
    [
        CommandLine("tunable", OTHERS_END),
        CommandLine("parameter_watcher", "remote parameter"),
        CommandLine(f"-c {shlex.quote(SETS_SPEED)}", "True"),
    ],
    [CommandLine("callback_groups one", "b ends")],
    [CommandLine("callback_groups two", "b ends")],
    [CommandLine("callback_groups reentrant", "b ends")],
    [CommandLine("single_goal_server", OTHERS_END), CommandLine("fibonacci_client 3 0")],
    [CommandLine("composed", "I heard")],
    [CommandLine("guarded")],
    [CommandLine("rates")],
    [CommandLine("spins_in_threads")],
]
COURSE_NODES = [
    [CommandLine("simple_robot_step1.py", OTHERS_END), CommandLine(f"-c {shlex.quote(ASKS)} simple_robot")],
    [CommandLine("simple_robot_step2.py", OTHERS_END), CommandLine(f"-c {shlex.quote(ASKS)} simple_robot")],
    [CommandLine("simple_robot_step3.py", "Speed"), CommandLine(f"-c {shlex.quote(ASKS)} simple_robot")],
    [CommandLine("configurable_robot.py", OTHERS_END), CommandLine(f"-c {shlex.quote(ASKS)} configurable_robot")],
    [CommandLine("data_publisher.py", OTHERS_END), CommandLine(f"-c {shlex.quote(ASKS)} data_publisher")],
    [CommandLine("intelligent_robot/robot_node.py", r"SAFE.*Speed")],
]
DEMOS = [
    [CommandLine(demo("talker", "main_py"), "Publishing"), CommandLine(demo("listener", "main"), "heard")],
    [CommandLine(demo("talker", "main_minimal"), "Publishing"), CommandLine(demo("listener", "main_minimal"), "heard")],
    [CommandLine(demo("add_two_ints", "serve"), "Incoming"), CommandLine(demo("add_two_ints", "ask"))],
]


class RunningProgram:
    """A program, and what it has printed so far."""

    def __init__(self, line: Sequence[str], env: Mapping[str, str], cwd: Path, until: str) -> None:
        self._until = re.compile(until)
        self.output = {"stdout": "", "stderr": ""}
        self._reached = threading.Event()
        pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        self._process = subprocess.Popen(line, env=dict(env), cwd=cwd, text=True, **pipes)
        self._readers = [threading.Thread(target=self._read, args=(name,)) for name in self.output]
        for each in self._readers:
            each.start()

    def _read(self, name: str) -> None:
        for line in getattr(self._process, name):
            self.output[name] += line
            if self._until.search(line):
                self._reached.set()

    def await_text(self) -> None:
        assert self._reached.wait(OUTPUT_TIMEOUT_S), self.output

    def end(self, *, interrupted: bool) -> None:
        if interrupted:
            self._process.send_signal(signal.SIGINT)
        try:
            self.exit_code = self._process.wait(OUTPUT_TIMEOUT_S)
        finally:
            self._process.kill()
        for each in self._readers:
            each.join()

    def shown(self, in_order: bool) -> dict[str, object]:
        """What a person sees, without numbers and the frames of tracebacks, and each line only once.

        How often a line appears depends on when the program is interrupted.
        """
        lines = {name: re.sub(r"\d+", "#", text).splitlines() for name, text in self.output.items()}
        once = {name: list(dict.fromkeys(each for each in lines[name] if each[:2] != "  ")) for name in lines}
        shown = once if in_order else {name: sorted(each) for name, each in once.items()}
        return {**shown, "exit": self.exit_code if self.exit_code >= 0 else 128 - self.exit_code}


def play(
    commands: Sequence[CommandLine], start: Sequence[str], env: Mapping[str, str], cwd: Path
) -> list[dict[str, object]]:
    """Run the commands together."""
    running: list[RunningProgram] = []
    try:
        for each in commands:
            words = shlex.split(each.words)
            files = [path for path in (PROGRAMS / f"{words[0]}.py", COURSE / words[0]) if path.is_file()]
            file = [str(files[0])] if files else [words[0]]
            running.append(RunningProgram([*start, *file, *words[1:]], env, cwd, each.until or OTHERS_END))
        for program, each in zip(running, commands, strict=True):
            if each.until not in ("", OTHERS_END):
                program.await_text()
        for interrupted in (False, True):
            for program, each in zip(running, commands, strict=True):
                if bool(each.until) is interrupted:
                    program.end(interrupted=interrupted)
    finally:
        for each in running:
            each._process.kill()
    in_order = not any(each.words.startswith(IN_ANY_ORDER) for each in commands)
    return [each.shown(in_order) for each in running]


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_home(tmp_path_factory.mktemp("home"))


@pytest.mark.slow
def test_uncaught_exception_is_shown_alike(home: Path, tmp_path: Path) -> None:
    text = "import rclpy\nrclpy.init()\nnode = rclpy.create_node('n')\nnode.create_timer(0.1, lambda: 1 / 0)\n"
    (tmp_path / "raises.py").write_text(f"{text}rclpy.spin(node)\n")
    (tmp_path / "lacks.py").write_text("import rclpy\nimport rospy\nrclpy.init()\n")
    for file in ("raises.py", "lacks.py"):
        run = subprocess.run(
            ["env", "bot-console", "run", file], cwd=tmp_path, env=environment(home), capture_output=True, check=False
        )
        plain = subprocess.run([str(PYTHON), file], cwd=tmp_path, env=set_up(home), capture_output=True, check=False)
        assert (plain.stderr, plain.returncode) == (run.stderr, run.returncode)


def compare(commands: Sequence[CommandLine], home: Path, tmp_path: Path) -> None:
    (tmp_path / "a").mkdir(mode=0o700)
    (tmp_path / "b").mkdir(mode=0o700)
    ours = {**environment(home), "BOT_CONSOLE_SOCKET_DIR": str(tmp_path / "a"), "ROS_DOMAIN_ID": "0"}
    plain = {**set_up(home), "BOT_CONSOLE_SOCKET_DIR": str(tmp_path / "b"), "ROS_DOMAIN_ID": "0"}
    # Otherwise Python buffers what is printed to a pipe until the program ends, and nobody sees when to interrupt it.
    ours["PYTHONUNBUFFERED"] = plain["PYTHONUNBUFFERED"] = "1"
    shown = play(commands, ["env", "bot-console", "run"], ours, tmp_path)
    assert play(commands, [str(PYTHON)], plain, tmp_path) == shown
    assert any(each["stdout"] or each["stderr"] for each in shown)


@pytest.mark.parametrize(
    "commands",
    soak_after_first(COMMAND_GROUPS),
    ids=lambda commands: commands[0].words.split()[0],
)
def test_programs_print_the_same_under_plain_python(commands: list[CommandLine], home: Path, tmp_path: Path) -> None:
    compare(commands, home, tmp_path)


@pytest.mark.skipif(not COURSE.is_dir(), reason="BOT_CONSOLE_COURSE names no course")
@pytest.mark.parametrize(
    "commands", soak_after_first(COURSE_NODES, pytest.mark.slow), ids=lambda commands: commands[0].words
)
def test_listings_of_the_course_print_the_same_under_plain_python(
    commands: list[CommandLine], home: Path, tmp_path: Path
) -> None:
    """The other two, `dynamic_robot.py` and `parameter_client.py`, start nothing, and `bot-console run` says so."""
    compare(commands, home, tmp_path)


@pytest.mark.soak
@pytest.mark.parametrize("commands", DEMOS, ids=["demo_nodes", "minimal", "services"])
def test_demo_nodes_print_the_same_under_plain_python(commands: list[CommandLine], home: Path, tmp_path: Path) -> None:
    compare(commands, home, tmp_path)


@pytest.mark.soak
@pytest.mark.parametrize("name", names())
def test_public_programs_print_the_same_under_plain_python(
    name: str, home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", str(tmp_path))
    plain = ["env", f"PYTHONPATH={set_up(home)['PYTHONPATH']}", str(PYTHON)]
    ours = ["env", f"PATH={home / 'bin'}:{os.defpath}", "bot-console", "run"]
    by_plain, by_run = outcome(plain, name, 0), outcome(ours, name, 1)
    if by_plain.code is not None and by_plain.code < 0:  # a shell shows 130 for both, if a signal has ended Python
        by_plain = by_plain._replace(code=128 - by_plain.code)
    assert by_plain == by_run
