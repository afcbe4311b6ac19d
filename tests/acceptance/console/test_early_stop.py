"""The thread that reads the terminal notices a stop key, whatever comes before it and even if the screen hangs.

A console on a scripted robot, in a separate process and pseudo-terminal. The drawing thread hangs from the first frame
on, so that only another thread can hold the robot.
"""

from __future__ import annotations

import fcntl
import os
import struct
import sys
import termios
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from terminal import Terminal

HELPERS = Path(__file__).resolve().parents[2] / "helpers"
PROGRAM = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from bot_console.runtime.importer import install
install()
from bot_console.tui.app import BotConsoleApp
from fakes.command_line import FakeCommandLine
from samples import live

console, launcher = live()

def note(text):
    with open("notes", "a") as file:
        print(text, file=file)

def noting(name):
    call = getattr(console.drive, name)
    def noted(*given, **named):
        call(*given, **named)
        note(f"{name} {given} {named}")
    setattr(console.drive, name, noted)

def hang():
    note("hangs")
    Path("resume").read_text()  # a pipe, into which nobody has written yet

for each in ("stop", "hold_early", "settle_early", "release"):
    noting(each)
BotConsoleApp(console, FakeCommandLine(console.asked), on_first_frame=hang).run()
"""
MOVES = "".join(f"\x1b[<35;{10 + at % 90};{5 + at % 30}M" for at in range(3000))
BEFORE = {
    "nothing": "",
    "mouse moves": MOVES,
    "wheel steps": "\x1b[<65;60;20M" * 1000,
    "clicks": "\x1b[<0;60;20M\x1b[<0;60;20m" * 300,
    "keys": "12345678?gG" * 20,
    "a paste with the key in it": "\x1b[200~" + "text with a ! in it, " * 1500 + "\x1b[201~",
    "answers of a terminal": "\x1b]11;rgb:!/!/!\x1b\\\x1bP>|term(!)\x1b\\\x1b[M!!!\x1b[?62;22c",
    "half of a sequence": "\x1b[<35;10;",
}

OFTEN = {"mouse moves": (), "nothing": pytest.mark.slow}
"""The inputs tried before a change lands, in the default run or among the slow tests; each takes a console."""


class Console:
    """The console in its terminal, and the requests that the robot received."""

    def __init__(self, folder: Path) -> None:
        (folder / "program.py").write_text(PROGRAM)
        os.mkfifo(folder / "resume")
        self.folder = folder
        self.terminal = Terminal([str(folder / "program.py"), str(HELPERS)], folder)

    def notes(self) -> list[str]:
        """The notes written so far."""
        path = self.folder / "notes"
        return path.read_text().splitlines() if path.exists() else []

    def until(self, note: str) -> None:
        """Wait for a note."""
        self.terminal.read_until(lambda: any(each.startswith(note) for each in self.notes()), note)


@pytest.fixture
def console(tmp_path: Path) -> Iterator[Console]:
    console = Console(tmp_path)
    try:
        console.until("hangs")
        yield console
    finally:
        console.terminal.close()


@pytest.mark.parametrize(
    "before",
    [pytest.param(each, marks=OFTEN.get(each, pytest.mark.soak)) for each in BEFORE],
)
def test_robot_is_held_while_the_screen_hangs_and_the_handled_key_keeps_the_stop(console: Console, before: str) -> None:
    console.terminal.type(BEFORE[before])
    for width in range(100, 130):
        fcntl.ioctl(console.terminal.master, termios.TIOCSWINSZ, struct.pack("HHHH", 40, width, 0, 0))
    console.terminal.type("!")
    console.until("hold_early")
    assert console.notes() == ["hangs", "hold_early ('1',) {}"]
    (console.folder / "resume").write_text("go on")
    console.until("stop")
    assert console.notes()[2:] == ["settle_early ('1',) {'keep': True}", "stop (True,) {}"]
