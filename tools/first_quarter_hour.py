"""Goes from a clone to a tuned robot by typing keys in a tmux session, and prints the seconds that each step takes.

python tools/first_quarter_hour.py [URL or folder of the repository]

The time does not include reading and thinking. The clone, the environment, the home folder and the ROS domain are new,
and are deleted at the end; `git`, `python3` and `tmux` have to be installed.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

LIMIT_S = 15 * 60
"""Seconds that all steps may take together."""
STEP_TIMEOUT_S = 600.0
POLL_S = 0.1
SIZE = (120, 40)
SESSION = "first-quarter-hour"


class Step(NamedTuple):
    """An action of a person, and what the screen has to show then (a regular expression)."""

    title: str
    keys: Sequence[str]
    shows: str


def steps(repository: str) -> list[Step]:
    """The steps of the README, then a first tuning of the robot."""
    clone = f"git clone -q {shlex.quote(repository)} bot-console && cd bot-console && echo clon''ed\r"
    install = "python3 -m venv .venv && .venv/bin/pip install -q . && echo instal''led\r"
    erase = ["\x7f"] * 5  # Backspace, for the value in the editor.
    return [
        Step("clone", [clone], "cloned"),
        Step("install", [install], "installed"),
        Step("start a robot", ["clear; .venv/bin/bot-console\r"], "DRIVING"),
        Step("find the greatest speed", ["1", "/", "max_speed", "\r"], r"max_speed +1\.0 m/s"),
        Step("ask for too much of it", ["\r", *erase, "10.0", "\r"], r"10\.0.*0\.1"),
        Step("read the reason, and dismiss it", ["\x1b"], r"max_speed +1\.0 m/s"),
        Step("drive slower", ["\r", *erase, "0.6", "\r"], r"robot +0\.6 m/s"),
        Step("see the speed over time", ["4"], r"linear\.x"),
        Step("write a faster value beside it", ["1", "m", "\r", *erase, "1.4", "\r"], "1 marked"),
        Step("drive with the other set", ["A", "y"], r"max_speed +1\.4 m/s"),
        Step("see what was changed", ["H"], r"0\.6.*1\.4"),
        Step("take it back", ["1", "u"], r"max_speed +0\.6 m/s"),
        Step("quit", ["q", "y"], r"[$#] ?$"),
    ]


class Tmux:
    """A separate tmux server with one window."""

    def __init__(self, folder: Path) -> None:
        self._call = ["tmux", "-S", str(folder / "tmux")]
        kept = {name: os.environ[name] for name in ("PATH", "LANG") if name in os.environ}
        environment = {
            "LANG": "C.UTF-8",
            **kept,
            "HOME": str(folder),
            "TERM": "xterm-256color",
            "PS1": "$ ",
            "BOT_CONSOLE_SOCKET_DIR": str(folder / "s"),
        }
        size = ("-x", str(SIZE[0]), "-y", str(SIZE[1]))
        words = [*self._call, "-f", "/dev/null", "new-session", "-d", "-s", SESSION, *size, "bash --norc --noprofile"]
        subprocess.run(words, check=True, env=environment, cwd=folder)

    def type(self, keys: str) -> None:
        """Press keys."""
        subprocess.run([*self._call, "send-keys", "-t", SESSION, "-l", keys], check=True)

    def screen(self) -> str:
        """The text on the screen."""
        words = [*self._call, "capture-pane", "-p", "-t", SESSION]
        return subprocess.run(words, check=True, capture_output=True, text=True).stdout.rstrip()

    def close(self) -> None:
        """End the server and all programs in it."""
        subprocess.run([*self._call, "kill-server"], check=False)


def walk(tmux: Tmux, repository: str) -> float:
    """Do all steps; returns their total time (s), raises `TimeoutError` with the screen if one does not succeed."""
    total = 0.0
    for step in steps(repository):
        start = time.monotonic()
        for each in step.keys:
            tmux.type(each)
            time.sleep(POLL_S)
        while not re.search(step.shows, tmux.screen()):
            if time.monotonic() - start > STEP_TIMEOUT_S:
                raise TimeoutError(f"{step.title}: no {step.shows!r} on the screen\n{tmux.screen()}")
            time.sleep(POLL_S)
        seconds = time.monotonic() - start
        total += seconds
        print(f"{seconds:7.1f} s  {step.title}", flush=True)
    return total


def main() -> int:
    """Do all steps, and print how long they took."""
    repository = sys.argv[1] if len(sys.argv) > 1 else str(Path(__file__).resolve().parents[1])
    with tempfile.TemporaryDirectory(prefix="bc-", ignore_cleanup_errors=True) as folder:
        tmux = Tmux(Path(folder))
        try:
            total = walk(tmux, repository)
        except TimeoutError as error:
            print(error, file=sys.stderr)
            return 1
        finally:
            tmux.close()
    print(f"{total:7.1f} s  in all, of {LIMIT_S} s")
    return 0 if total < LIMIT_S else 1


if __name__ == "__main__":
    sys.exit(main())
