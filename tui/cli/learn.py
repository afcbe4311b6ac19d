"""The `learn` command: opens a course in a workspace, prints the progress, or writes the skeleton of a new course."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
from dataclasses import replace
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.runtime.rmw.zenoh.domain.folder import FolderRefusedError
from bot_console.tui.arrangement.plugin_pane import PluginEntry
from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.cli.arguments import Options
from bot_console.tui.learn.command_log import open_log
from bot_console.tui.learn.course import CourseError, find_course, names, read_course
from bot_console.tui.learn.layout import NAME
from bot_console.tui.learn.lesson import CourseLesson
from bot_console.tui.learn.skeleton import write_skeleton

DEFAULT = "week6"


def run(words: list[str]) -> int:
    """Run the command; 0 done, 1 if the course cannot be opened, 2 for wrong usage or a course with mistakes."""
    parser = argparse.ArgumentParser(
        "bot-console learn",
        description="Work through a course beside the console. A step is done when the system shows that it is.",
        epilog=f"courses: {', '.join(names())}; also the folder of a course of your own (docs/courses.md)",
    )
    parser.add_argument(
        "course", nargs="?", default=DEFAULT, metavar="COURSE", help=f"name or folder (default: {DEFAULT})"
    )
    parser.add_argument(
        "--workspace", type=Path, default=Path(), metavar="DIR", help="folder with your packages (default: this one)"
    )
    parser.add_argument(
        "--list", action="store_true", help="print all steps and which of them are done, without opening the console"
    )
    parser.add_argument("--new", type=Path, metavar="DIR", help="write the skeleton of a new course into a new folder")
    given = parser.parse_args(words)
    if given.new is not None:
        return _new(given.new)
    workspace = given.workspace.resolve()
    if not workspace.is_dir():
        print(f"there is no folder {given.workspace}: make it (`mkdir -p {given.workspace}/src`)", file=sys.stderr)
        return 1
    install()  # Checking launch files needs the installed packages.
    try:
        course = read_course(find_course(given.course))
    except CourseError as error:
        print(error, file=sys.stderr)
        return 2
    if given.list:
        print(listing(CourseLesson(course, workspace)))
        return 0
    try:
        log = open_log()
    except FolderRefusedError as refused:
        print(refused, file=sys.stderr)
        return 1
    try:
        return _show(CourseLesson(course, workspace, log), workspace)
    finally:
        with contextlib.suppress(OSError):
            os.remove(log)


def listing(lesson: CourseLesson) -> str:
    """All steps with a mark for those that are done, and what the shown one still waits for."""
    lines: list[str] = []
    for chapter in lesson.course.chapters:
        lines.append(chapter.title)
        lines += [f"  {'✓' if lesson.is_done(each) else '○'} {each.title}" for each in chapter.steps]
    view = lesson.view()
    lines += ["", f"{view.done} of {view.total} done; next: {view.title}"]
    lines += [f"  {text}" for held, text in view.waits if not held]
    return "\n".join(lines)


def _new(folder: Path) -> int:
    try:
        made = write_skeleton(folder)
    except OSError as error:
        print(f"not written: {folder}: {error.strerror}", file=sys.stderr)
        return 1
    print("\n".join(str(each) for each in made))
    print(f"`bot-console lint {folder}` checks it, `bot-console learn {folder}` opens it", file=sys.stderr)
    return 0


def _show(lesson: CourseLesson, workspace: Path) -> int:
    from bot_console.tui.cli.open_console import run as show
    from bot_console.tui.panes.lesson.pane import LessonPane

    def pane() -> type[LessonPane]:
        return LessonPane.of(lesson)

    entry = PluginEntry("lesson", "", "Lesson", "LessonPane", find=pane, source="bot-console")
    options = Options(attach=True, layout=NAME, workspace=[workspace], opening=Opening())
    return show(replace(options, extra_panes=(entry,)))
