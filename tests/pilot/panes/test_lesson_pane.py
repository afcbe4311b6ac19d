"""The lesson pane shows the step and what it waits for, and moves on when the step is done."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.arrangement.plugin_pane import PluginEntry
from bot_console.tui.console.model import Change, ChangeSource
from bot_console.tui.layout.current_layout import Arrangement, MemoryLayoutStore
from bot_console.tui.learn.course import read_course
from bot_console.tui.learn.layout import NAME, LessonLayoutStore
from bot_console.tui.learn.lesson import CourseLesson
from bot_console.tui.learn.lesson_view import LessonView
from bot_console.tui.panes.lesson.pane import LessonPane, step_lines, step_text, wrapped
from bot_console.tui.settings.appearance import Appearance
from fakes.command_line import FakeCommandLine
from piloting import Session
from rest import at_rest
from samples import live

CHAPTER = """# One

## Set the speed

Why it [matters].

```console
ros2 param set /robot speed 2.0
```

```step
saw-set speed 2.0
```

## Look at the plot

```step
saw-pane plot
```
"""


class Clock:
    """Time that advances with each reading."""

    now = 0.0

    def __call__(self) -> float:
        self.now += 10.0
        return self.now


def run(
    folder: Path, play: Callable[[Session], Awaitable[None]], size: tuple[int, int], chapter: str = CHAPTER
) -> None:
    (folder / "course.md").write_text("# C\n", encoding="utf-8")
    (folder / "1.md").write_text(chapter, encoding="utf-8")
    lesson = CourseLesson(read_course(folder), folder, "", Clock())
    entry = PluginEntry("lesson", "", "Lesson", "", find=lambda: LessonPane.of(lesson), source="a test")

    async def main() -> None:
        console, launcher = live()
        app = BotConsoleApp(
            console,
            FakeCommandLine(console.asked),
            refresh_hz=0,
            appearance=replace(Appearance(), arrangement=Arrangement(LessonLayoutStore(MemoryLayoutStore()), NAME)),
            plugins=lambda: [entry],
        )
        with at_rest(is_scripted=True):
            async with app.run_test(size=size, notifications=True) as pilot:
                session = Session(app, pilot, console, launcher)
                await session.settle()
                await session.settle()
                await play(session)
                assert app.controls.faults.seen == []

    asyncio.run(main())


async def check_lesson(session: Session) -> None:
    """Let the lesson check what has happened."""
    for _ in range(5):
        session.pane(LessonPane).tick()
    await session.settle()


@pytest.mark.parametrize("size", [(80, 24), pytest.param((120, 40), marks=pytest.mark.slow)])
def test_step_is_shown_and_the_next_one_once_it_is_done(size: tuple[int, int], tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        assert "1/2 Set the speed" in session.text()
        assert "waiting for: speed to be set to 2.0" in session.text()
        assert "ros2 param set /robot speed 2.0" in session.text()
        session.console.journal.append(Change(5, 0, "/robot", "speed", 1.0, 2.0, ChangeSource.OTHER))
        await check_lesson(session)
        assert "2/2 Look at the plot" in session.text()
        assert "1 of 2 done" in session.text()
        await session.press("4", "0")  # The visit is over when the lesson checks.
        await check_lesson(session)
        assert "2 of 2 done" in session.text()

    run(tmp_path, play, size)


def test_keys_show_other_steps_copy_and_open_the_whole_step(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        pane = session.pane(LessonPane)
        pane.focus_target()
        await session.press("n")
        assert "2/2 Look at the plot" in session.text()
        await session.press("p", "y")
        assert session.app.clipboard == "ros2 param set /robot speed 2.0"
        await session.press("enter")
        assert "One, step 1 of 2" in session.text()
        assert "Why it [matters]." in session.text()
        await session.press("escape", "n", "o")
        assert "1/2 Set the speed" in session.text()

    run(tmp_path, play, (120, 40))


def test_enter_does_not_make_a_step_done(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        session.pane(LessonPane).focus_target()
        await session.press("enter", "escape", "n", "n", "p")
        await check_lesson(session)
        assert "0 of 2 done" in session.text()

    run(tmp_path, play, (120, 40))


def test_listing_leaves_room_for_what_follows_and_long_lines_are_marked() -> None:
    line = '        self.create_service(AddTwoInts, "add", self.add)'
    body = "\n".join([line, *(f"line {number}" for number in range(30))])
    view = LessonView("C", "S", 1, 1, 0, snippets=(("a.py", body), ("", "bot-console run a.py")))
    text = step_text(view, 47, 30).plain
    assert "  " + "\n  ".join(wrapped(line, 45)) in text
    assert wrapped(line, 45) == ["        self.create_service(AddTwoInts, …", '            "add", self.add)']
    assert "… 21 more lines: enter shows them, y copies all" in text
    assert text.endswith("In a terminal:\n  bot-console run a.py\n\n")
    assert body.replace("\n", "\n  ") in step_text(view).plain


@pytest.mark.parametrize(
    ("waiting", "lines"),
    [
        ("waiting for: a node", ["1/2 Set the speed  waiting for: a node", "a.py · ls · pwd"]),
        (
            "waiting for: a node with sped; mean speed?",
            ["1/2  waiting for: a node with sped; mean speed?", "a.py · ls · pwd"],
        ),
        (
            "speed has no range: give its descriptor a floating_point_range",
            ["1/2  speed has no range: give its descriptor a", "floating_point_range"],
        ),
        (
            "waiting for: speed to be refused as an invalid type, not: it is too fast; take the last return away",
            [
                "1/2  waiting for: speed to be refused as an",
                "invalid type, not: it is too fast; take the last return away",  # The pane marks where it ends.
            ],
        ),
    ],
)
def test_two_line_lesson_shows_first_what_the_step_waits_for(waiting: str, lines: list[str]) -> None:
    view = LessonView(
        "C", "Set the speed", 1, 2, 0, snippets=(("a.py", "x"), ("", "ls\npwd")), waits=((False, waiting),)
    )
    assert step_lines(view, 48).plain.splitlines() == lines


@pytest.mark.slow
def test_each_press_of_y_copies_the_next_listing(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        session.pane(LessonPane).focus_target()
        await session.press("y")
        assert session.app.clipboard == "x = 1"
        await session.press("y")
        assert session.app.clipboard == "ros2 param list"
        await session.press("y")
        assert session.app.clipboard == "x = 1"

    chapter = "# One\n## A\n```python a.py\nx = 1\n```\n```console\nros2 param list\n```\n```step\nsaw-steering\n```\n"
    run(tmp_path, play, (120, 40), chapter)


def test_steering_counts_once_a_key_moves_the_robot_and_not_when_it_is_armed(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "0")
        await check_lesson(session)
        assert "0 of 1 done" in session.text()
        await session.press("6", "enter", "w")
        session.pane(LessonPane).tick()
        await session.press("space", "0")
        await check_lesson(session)
        assert "1 of 1 done" in session.text()

    chapter = "# One\n## Drive\n```step\nsaw-steering\n```\n"
    run(tmp_path, play, (120, 40), chapter)
