"""A student: a workspace, terminals in which commands are typed, and `bot-console learn` in one more."""

from __future__ import annotations

import contextlib
import fcntl
import os
import pty
import re
import select
import shutil
import struct
import subprocess
import termios
import threading
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import polling
from bot_console.tui.learn.condition_check import with_names
from bot_console.tui.learn.course import Course, Step, read_course
from bot_console.tui.learn.lesson import CourseLesson
from helpers.emulator import Emulator
from helpers.shells import environment, make_home

TIMEOUT_S = 900.0
"""Seconds after which a test gives up; nothing is measured by it."""
SIZE = (120, 40)
LESSON_COLUMNS = slice(74, 118)
"""The inside of the lesson pane on a screen of that size."""
PROMPT = "ready> "
until = partial(polling.until, poll_s=0.05, timeout_s=TIMEOUT_S)


class Pty:
    """A program in a pseudo-terminal; its output is read all the time, so that it never has to wait."""

    def __init__(self, words: Sequence[str], folder: Path, env: Mapping[str, str], size: tuple[int, int]) -> None:
        self._master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", size[1], size[0], 0, 0))
        in_terminal = ["setsid", "--ctty", *words]
        self.process = subprocess.Popen(in_terminal, cwd=folder, env=dict(env), stdin=slave, stdout=slave, stderr=slave)
        os.close(slave)
        self._output = bytearray()
        self._lock = threading.Lock()
        self._closed = threading.Event()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        with contextlib.suppress(OSError):
            while not self._closed.is_set():
                if select.select([self._master], [], [], 0.1)[0]:
                    read = os.read(self._master, 65536)
                    with self._lock:
                        self._output += read

    def output(self, start: int = 0) -> str:
        """What was printed, from a byte on."""
        with self._lock:
            return self._output[start:].decode("utf-8", "replace")

    def size(self) -> int:
        """How many bytes were printed."""
        with self._lock:
            return len(self._output)

    def type(self, keys: str) -> None:
        """Press keys."""
        os.write(self._master, keys.encode())

    def close(self) -> None:
        """End everything in the terminal, as closing its window does."""
        self._closed.set()
        self._reader.join()
        os.close(self._master)
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(10.0)
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


class Shell:
    """A bash that has evaluated `bot-console setup`."""

    def __init__(self, folder: Path, env: Mapping[str, str]) -> None:
        self._pty = Pty([shutil.which("bash") or "bash", "--norc", "--noprofile"], folder, env, (200, 50))
        self._from = 0
        self._run('eval "$(bot-console setup bash)"')

    def _run(self, line: str) -> str:
        self.start(line)
        return self.ended()

    def start(self, line: str) -> None:
        """Type a line."""
        self._from = self._pty.size()
        self._pty.type(f"{line}\n")

    def ended(self) -> str:
        """Wait for the end of the last line, and return what it has printed."""
        until(lambda: self.printed().endswith(PROMPT), lambda: f"the prompt does not come back:\n{self.printed()}")
        return self.printed()

    def run(self, *lines: str) -> str:
        """Type lines, one after the other, each when the one before has ended; what the last one has printed."""
        return [self._run(line) for line in lines][-1]

    def printed(self) -> str:
        """What the last line has printed so far."""
        return self._pty.output(self._from)

    def shows(self, text: str) -> None:
        """Wait until the last line has printed a text."""
        until(lambda: text in self.printed(), lambda: f"no {text!r} in:\n{self.printed()}")

    def interrupt(self) -> str:
        """Press Ctrl-C and wait for the prompt."""
        self._from = self._pty.size()
        self._pty.type("\x03")
        return self.ended()

    def close(self) -> None:
        """Close the terminal."""
        self._pty.close()


def _without_blanks(text: str) -> str:
    return "".join(text.split())


class Student:
    """Works through a course; knows which of its steps should be done."""

    def __init__(self, folder: Path, course: Path, workspace: Path | None = None) -> None:
        """`workspace` is copied; without it, the student begins with an empty one."""
        home = folder / "home"
        home.mkdir()
        self.workspace = folder / "ws"
        (self.workspace / "src").mkdir(parents=True)
        if workspace is not None:
            shutil.copytree(workspace, self.workspace, dirs_exist_ok=True)
        self._env = environment(make_home(home), {"TERM": "xterm-256color", "LANG": "C.UTF-8", "PS1": PROMPT})
        self.course: Course = read_course(course)
        self._steps = {each.id: each for each in self.course.steps()}
        self.expected = self.done()
        self.shells = [Shell(self.workspace, self._env) for _ in range(3)]
        self._words = [str(home / "bin" / "bot-console"), "learn", str(course)]
        self._open()

    def _open(self) -> None:
        self.console = Pty(self._words, self.workspace, self._env, SIZE)
        self._screen, self._fed = Emulator(*SIZE), 0

    def begin(self) -> None:
        """Wait until the lesson is shown: from then on, commands are recorded."""
        self.shows(f" of {len(self._steps)} done")

    def reopen(self) -> None:
        """Quit the console, and open the course again."""
        self.console.type("q")
        until(lambda: self.console.process.poll() is not None, self._state)
        self.console.close()
        self._open()
        self.begin()

    def screen(self) -> list[str]:
        """The lines on the console's screen."""
        new = self.console.output(self._fed)
        self._fed = self.console.size()
        self._screen.feed(re.sub(r"\x1b\][^\x07\x1b]*(\x07|\x1b\\)|\x1b[P_][^\x1b]*\x1b\\|[\r\n]", "", new))
        return self._screen.lines()

    def lesson(self) -> str:
        """The text of the lesson pane without blanks: the pane breaks a line within a word that is longer than it."""
        return _without_blanks("".join(line[LESSON_COLUMNS] for line in self.screen()))

    def done(self) -> set[str]:
        """The steps that are done."""
        lesson = CourseLesson(self.course, self.workspace)
        return {each.id for each in self.course.steps() if lesson.is_done(each)}

    def does(self, *ids: str) -> None:
        """Wait until these steps are done, besides those before, and no other ones."""
        assert not self.expected & {*ids} and {*ids} <= self._steps.keys(), ids
        self.expected |= {*ids}
        until(lambda: self.expected <= self.done(), self._state)
        assert self.expected == self.done(), self._state()

    def loses(self, id: str) -> None:
        """Wait until a step is open again, and no other one."""
        self.expected -= {id}
        until(lambda: self.done() == self.expected, self._state)

    def does_by(self, id: str, act: Callable[[], None]) -> None:
        """Do something over and over until a step is done."""
        until(lambda: (act(), self.expected | {id} <= self.done())[1], self._state)
        self.does(id)

    def shows(self, text: str) -> None:
        """Wait until the console shows a text."""
        until(
            lambda: text in " ".join(" ".join(self.screen()).split()), lambda: f"no {text!r} on screen\n{self._state()}"
        )

    def _state(self) -> str:
        done = self.done()
        return "\n".join(
            [
                f"not done: {sorted(self.expected - done)}; done without its deed: {sorted(done - self.expected)}",
                *self.screen(),
                *(f"--- shell {number}\n{each.printed()[-3000:]}" for number, each in enumerate(self.shells)),
            ]
        )

    def reads(self, *texts: str) -> None:
        """Wait until the lesson shows these texts; none but the expected steps is done then."""
        until(
            lambda: all(_without_blanks(each) in self.lesson() for each in texts),
            lambda: f"no {texts} in the lesson\n{self._state()}",
        )
        assert self.done() == self.expected, self._state()

    def step(self, id: str) -> Step:
        """A step by its id."""
        return self._steps[id]

    def listing(self, id: str, number: int = 0) -> str:
        """What a step says to type or to write, with the student's names."""
        lesson = CourseLesson(self.course, self.workspace)
        return with_names(self._steps[id].snippets[number].text, lesson.progress.names)

    def lines(self, id: str, number: int = 0) -> list[str]:
        """The lines that a step says to type."""
        return self.listing(id, number).splitlines()

    def write(self, path: str, text: str) -> None:
        """Save a file of the workspace."""
        place = self.workspace / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")

    def edit(self, path: str, old: str, new: str) -> None:
        """Replace a text in a file of the workspace."""
        text = (self.workspace / path).read_text("utf-8")
        assert text.count(old) == 1, f"{old!r} is {text.count(old)} times in {path}"
        self.write(path, text.replace(old, new))

    def merge(self, path: str, fragment: str, anchor: str, *, after: bool = False) -> None:
        """Put a listing into a file: its imports at the top, the rest in place of a line of the file, or after it."""
        imports, _, rest = fragment.partition("\n\n")
        if not imports.startswith(("from ", "import ")):
            imports, rest = "", fragment
        self.edit(path, anchor, f"{anchor if after else ''}{rest.rstrip()}\n")
        self.write(path, f"{imports}\n{(self.workspace / path).read_text('utf-8')}")

    def close(self) -> None:
        """Close all terminals, and end the robot in the background."""
        with contextlib.suppress(AssertionError):
            self.shells[0].interrupt()
            self.shells[0].run("bot-console down")
        for each in (self.console, *self.shells):
            each.close()
