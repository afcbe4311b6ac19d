"""Counts the functions through which a parameter edit, a velocity and a log line pass in a running console (a "walk").

python tools/walks.py [--list]

Profile functions in all threads record a walk: whenever its next point is called, the functions on the stack, down to
the event loop, the executor or the start of the thread, are added unless they are part of the walk already. So helpers
that only compute something on the way and return are not counted, nor are the functions of Textual and asyncio.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from types import CodeType, FrameType

from bot_console.runtime.importer import install

install()

from bot_console.tui import keymap
from bot_console.tui.cli.arguments import Options
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.session.live import Session
from textual.pilot import Pilot

ROOTS = (Path(keymap.__file__).parents[1], Path(keymap.__file__).resolve().parents[1])
"""The folder with `tui`, `runtime` and `nodes`, and its real path: a checkout finds some modules through a link."""
PARTS = ("tui", "runtime", "nodes")
LOOPS = (
    "/asyncio/",
    "/threading.py",
    "rclpy/executor",
    "rclpy/impl/",
    "rclpy/task.py",
    "textual/message_pump.py",
    "/tui/terminal/styling",
)
"""Parts of the paths of event loops and executors, into which a walk does not continue."""
TIMEOUT_S = 30.0
POLL_S = 0.05
WALKS: dict[str, tuple[str, ...]] = {
    "edit": (
        "textual/widget.py:_forward_event",
        "tui/console/command_gate.py:run < tui/console/parameters/",
        "tui/console/calls.py:ask < tui/console/parameters/setter.py",
    ),
    "answer": (
        "tui/console/calls.py:ask < tui/console/parameters/setter.py",
        "textual/message_pump.py:call_later < concurrent/futures/",
        "textual/widget.py:refresh < tui/panes/parameters/",
        "tui/panes/parameters/table.py:_parameter",
    ),
    "velocity": (
        "textual/widget.py:_forward_event",
        "rclpy/publisher.py:publish < tui/console/robot/",
        "nodes/safety_node.py:on_command",
        "rclpy/publisher.py:publish < nodes/safety_node.py",
        "nodes/simulation/robot.py:command",
    ),
    "log line": (
        "tui/console/logs/store.py:add < tui/console/logs/rosout.py",
        "tui/console/logs/search.py:passing",
        "textual/widget.py:refresh < tui/widgets/row_list.py",
        "tui/panes/logs/rows.py:row",
    ),
}
"""The points of each walk: from Enter after a value to the request, and from the response to the row that shows the
refusal; from a key of the steering pane to the wheels; from `/rosout` to a row of the log. `f < g` is f called by g.
"""


def is_at(frame: FrameType, point: str) -> bool:
    """Whether a frame is a call of the function that a point names."""
    function, _, caller = point.partition(" < ")
    file, _, name = function.partition(":")
    if frame.f_code.co_name != name or file not in frame.f_code.co_filename:
        return False
    return not caller or (frame.f_back is not None and caller in frame.f_back.f_code.co_filename)


def place(code: CodeType) -> str:
    """The file of a code object within this program; empty if it is a library's."""
    path = Path(code.co_filename)
    found = (path.relative_to(root) for root in ROOTS if path.is_relative_to(root))
    return next((each.as_posix() for each in found if each.parts[0] in PARTS), "")


class Walk:
    """The functions passed so far, and the number of points reached."""

    def __init__(self, points: Sequence[str]) -> None:
        self._points = points
        self._reached = 0
        self._lock = threading.Lock()
        self.functions: list[CodeType] = []

    @property
    def is_over(self) -> bool:
        """Whether the last point was reached."""
        return self._reached == len(self._points)

    def observe(self, frame: FrameType, event: str, argument: object) -> None:
        """Handle a profiling event of a thread."""
        if event != "call" or self.is_over or not is_at(frame, self._points[self._reached]):
            return
        with self._lock:
            self._reached += 1
            found = [frame.f_code]
            back = frame.f_back
            while back is not None and not any(each in back.f_code.co_filename for each in LOOPS):
                found.append(back.f_code)
                back = back.f_back
            self.functions += [each for each in reversed(found) if place(each) and each not in self.functions]

    def counts(self) -> dict[str, int]:
        """The number of functions in each part of this program."""
        parts = [place(each).partition("/")[0] for each in self.functions]
        return {each: parts.count(each) for each in PARTS if each in parts}

    def lines(self) -> list[str]:
        """The functions in order, by file, line and name."""
        return [f"{place(each)}:{each.co_firstlineno} {each.co_name}" for each in self.functions]


class Recorder:
    """Plays scenes in a console and records the walks."""

    session: Session
    pilot: Pilot[None]

    def __init__(self) -> None:
        self._now: Walk | None = None
        self.walks: dict[str, Walk] = {}

    def observe(self, frame: FrameType, event: str, argument: object) -> None:
        """Pass profiling events of all threads to the present walk."""
        if self._now is not None:
            self._now.observe(frame, event, argument)

    def begin(self, name: str) -> Walk:
        """Record a walk from now on."""
        self._now = self.walks[name] = Walk(WALKS[name])
        return self._now

    async def until(self, condition: Callable[[], object], what: str) -> None:
        """Wait until a condition holds."""
        for _ in range(int(TIMEOUT_S / POLL_S)):
            if condition():
                return
            await self.pilot.pause(POLL_S)
        print(*(strip.text for strip in self.session.app.screen._compositor.render_strips()), sep="\n", file=sys.stderr)
        raise TimeoutError(f"waited in vain for {what}: {self._now.lines() if self._now else ''}")

    async def edit(self) -> None:
        """Type a value that the node refuses, and press Enter; then wait until its row says so."""
        await self.until(lambda: self.session.app.query(ParameterRows), "the panes")
        rows = self.session.app.query_one(ParameterRows)
        await self.until(lambda: any(each.name == "max_speed" for each in rows.rows), "the parameters")
        await self.pilot.press("1", "slash", *["backspace"] * 20, "m", "a", "x", "underscore", "s", "p", "enter")
        await self.pilot.press("enter", *["backspace"] * 12, "9", "9")
        walk = self.begin("edit")
        await self.pilot.press("enter")
        await self.until(lambda: walk.is_over, "the request")
        walk = self.begin("answer")
        await self.pilot.press("enter", *["backspace"] * 12, "9", "8", "enter")
        await self.until(lambda: walk.is_over, "the refusal")

    async def velocity(self) -> None:
        """Arm the steering, and press a key that drives."""
        await self.pilot.press("6", "enter")
        await self.until(lambda: self.session.console.snapshot().drive.steered_by, "the steering")
        walk = self.begin("velocity")
        await self.pilot.press("w")
        await self.until(lambda: walk.is_over, "the wheels")

    async def log_line(self) -> None:
        """Wait for a line while the log is shown."""
        await self.pilot.press("enter", "2")
        walk = self.begin("log line")
        await self.until(lambda: walk.is_over, "a line")


async def record() -> dict[str, Walk]:
    """Start the robot and its console in this process, and record all walks."""
    with tempfile.TemporaryDirectory() as folder:
        recorder = Recorder()
        threading.setprofile(recorder.observe)
        sys.setprofile(recorder.observe)
        session = Session(Options(seed=1, workspace=[Path(folder)]))
        try:
            async with session.app.run_test(size=(120, 40)) as pilot:
                recorder.session, recorder.pilot = session, pilot
                for scene in (recorder.edit, recorder.velocity, recorder.log_line):
                    await scene()
                return recorder.walks
        finally:
            threading.setprofile(None)  # type: ignore[arg-type] -- as its documentation says
            sys.setprofile(None)
            await asyncio.to_thread(session.close)


def main() -> None:
    """Print the counts, and with `--list` the functions."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--list", action="store_true", help="the functions, too")
    given = parser.parse_args()
    walks = asyncio.run(record())
    print(json.dumps({name: walk.counts() for name, walk in walks.items()}, indent=1))
    for name, walk in walks.items() if given.list else ():
        print(f"\n{name}:", *walk.lines(), sep="\n  ")


if __name__ == "__main__":
    main()
