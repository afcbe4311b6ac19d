"""`bot-console up`, `down` and `status`: a robot system that outlives its terminal, reached with `attach`."""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from bot_console.tui.cli.domain import domain, others_take_part, robot_there, take_part
from bot_console.tui.crash import state_folder

FOR_EVER = "1e9"
"""Seconds that a system in the background may run."""
STARTING = 60.0
"""Seconds that it may take until its nodes are seen, on a busy machine."""
ENDING = 15.0
"""Seconds that it gets to bring the robot to rest and end its nodes, before it is killed."""
KEPT_LOGS = 5
"""Log files of earlier systems that are kept."""


@dataclass(frozen=True)
class Background:
    """A system in the background: its process, what it was started with, and where its log is."""

    pid: int
    words: tuple[str, ...]
    log: str

    def runs(self) -> bool:
        """Whether it is still that program which has the process id."""
        try:
            command = Path(f"/proc/{self.pid}/cmdline").read_bytes()
        except OSError:
            with contextlib.suppress(OSError):
                os.kill(self.pid, 0)
                return not Path("/proc/self").exists()
            return False
        return b"--headless" in command

    def told(self) -> str:
        """It on one line."""
        return f"process {self.pid} ({' '.join(self.words) or 'indoor'}), log {self.log}"


def up(words: Sequence[str]) -> int:
    """Start a system in the background and wait until its robot is there."""
    from bot_console.tui.cli.arguments import parse

    options = parse(["--headless", *words])
    if options.fast:
        print("a system in the background runs in real time: leave --fast out", file=sys.stderr)
        return 2
    problem = take_part()
    if options.launch and not Path(options.launch).is_file():
        problem = f"there is no launch file {options.launch}"
    if problem:
        print(problem, file=sys.stderr)
        return 1
    there = _known()
    if there or (robot_there() and not options.launch):
        who = there.told() if there else ", ".join(robot_there())
        print(f"a robot runs already in ROS domain {domain()}: {who}; bot-console attach shows it", file=sys.stderr)
        return 1
    log = _new_log()
    line = [sys.executable, "-m", "bot_console.tui", "--headless", "--duration", FOR_EVER, *words]
    with log.open("wb") as output:
        process = subprocess.Popen(
            line, stdin=subprocess.DEVNULL, stdout=output, stderr=output, start_new_session=True, close_fds=True
        )
    started = Background(process.pid, tuple(words), str(log))
    _file().write_text(json.dumps(asdict(started)), encoding="utf-8")
    deadline = time.monotonic() + STARTING
    is_up = others_take_part if options.launch else robot_there
    while process.poll() is None and not is_up() and time.monotonic() < deadline:
        time.sleep(0.1)
    if process.poll() is not None:
        _file().unlink(missing_ok=True)
        print(f"it has ended with exit code {process.returncode}; its log is {log}", file=sys.stderr)
        return 1
    print(f"running in ROS domain {domain()}: {started.told()}")
    print("bot-console attach shows it, bot-console down ends it")
    return 0


def down(words: Sequence[str]) -> int:
    """Bring the robot to rest and end the system in the background."""
    _no_words("down", "End the system in the background.", words)
    alone = take_part()
    if alone:
        print(alone, file=sys.stderr)
        return 1
    there = _known()
    if there is None:
        print(f"nothing runs in the background of ROS domain {domain()}", file=sys.stderr)
        return 1
    for number in (signal.SIGTERM, signal.SIGKILL):
        with contextlib.suppress(ProcessLookupError):
            os.kill(there.pid, number)
        deadline = time.monotonic() + ENDING
        while there.runs() and time.monotonic() < deadline:
            time.sleep(0.05)
        if not there.runs():
            break
    _file().unlink(missing_ok=True)
    print(f"ended: {there.told()}")
    return 0


def status(words: Sequence[str]) -> int:
    """Tell what runs in the background, and which robot is in the domain; 1 where nothing is."""
    _no_words("status", "Tell what runs.", words)
    alone = take_part()
    if alone:
        print(alone, file=sys.stderr)
        return 1
    there, robot = _known(), robot_there()
    if there:
        print(f"running in ROS domain {domain()}: {there.told()}")
    if robot:
        print(f"robot in ROS domain {domain()}: {', '.join(robot)}")
    if not there and not robot:
        print(f"nothing runs in ROS domain {domain()}", file=sys.stderr)
        return 1
    return 0


def _no_words(command: str, what: str, words: Sequence[str]) -> None:
    argparse.ArgumentParser(f"bot-console {command}", description=what).parse_args(words)


def _file() -> Path:
    """Where a system in the background is written down: beside the sockets of its domain."""
    from bot_console.runtime.rmw.zenoh.domain_folder import domain_folder

    return Path(domain_folder(domain())) / "background.json"


def _known() -> Background | None:
    """The system in the background, if it still runs."""
    try:
        found = json.loads(_file().read_text(encoding="utf-8"))
        known = Background(int(found["pid"]), tuple(found["words"]), str(found["log"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return known if known.runs() else None


def _new_log() -> Path:
    """A fresh log file; those of all but the newest systems go."""
    folder = state_folder() / "systems"
    folder.mkdir(parents=True, exist_ok=True)
    old = sorted(folder.glob("*.log"), key=lambda each: each.stat().st_mtime)
    for each in old[: max(0, len(old) - KEPT_LOGS + 1)]:
        each.unlink(missing_ok=True)
    return folder / f"{time.strftime('%Y%m%d-%H%M%S')}-{os.getpid()}.log"
