"""`colcon build`: there is nothing to build here; reports unknown and broken packages. Other verbs are refused."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.runtime.workspace.available_names import package_names
from bot_console.runtime.workspace.discover import workspace
from bot_console.tui.cli.lint.packaging import obstacles
from bot_console.tui.cli.verbs.sourced import write_setup_files
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize

NOTHING_TO_DO = "Nothing has to be built or sourced: packages of the workspace are read from their sources."
GOOD_FOR = "makes the ros2 command and these packages available in any folder of a shell that sources it."
ONLY_BUILD = (
    "bot-console answers colcon build alone: bot-console test FOLDER runs the tests of a package, "
    "and ros2 pkg list lists the packages."
)
SELECTING = ("--packages-select", "--packages-up-to")


def run(words: Sequence[str]) -> int:
    """Answer `colcon WORDS`; returns 1 if a package cannot be used as it is."""
    install()
    *warnings, answer = answers(words)
    for each in warnings:
        print(each, file=sys.stderr)
    print(answer)
    if answer == NOTHING_TO_DO and words[:1] == ["build"]:
        _report_setup_files()
    return 0 if answer == NOTHING_TO_DO else 1


def _report_setup_files() -> None:
    """Write the file that people source after a build, and print what it is good for."""
    here = Path.cwd()
    try:
        files = write_setup_files(here, workspace())
    except OSError as error:
        print(f"install/setup.bash was not written: {error}", file=sys.stderr)
        return
    if files:
        print(f"{files[0].relative_to(here)} {GOOD_FOR}")


def answers(words: Sequence[str]) -> list[str]:
    """The lines of the answer: a warning for each unknown package, the faults of packages, and the summary."""
    if words and words[0] != "build" and not words[0].startswith("-"):
        return [ONLY_BUILD]  # else `colcon test` would seem to have passed
    warnings = [f"ignoring unknown package '{name}' in {option}" for option, name in _unknown(words)]
    broken = _broken(words)
    failed = [f"Failed   <<< {name}: {problem}" for name, problem in broken.items()]
    failed += _obstacles(words) if words[:1] == ["build"] else []
    last = f"{counted(len(broken), 'package')} failed: {' '.join(broken)}" if broken else NOTHING_TO_DO
    return [*warnings, *failed, last]


def _obstacles(words: Sequence[str]) -> Iterator[str]:
    """The faults with which packages work here but not on ROS 2; only of selected packages, if any are selected."""
    selected = {word for _, word in _selected(words)}
    for name, package in sorted(workspace().packages.items()):
        if name in selected or not selected:
            yield from (f"Would not work on ROS 2 <<< {name}: {sanitize(str(each))}" for each in obstacles(package))


def _broken(words: Sequence[str]) -> dict[str, str]:
    """Why packages of the workspace cannot be used, by name; only selected packages, if any are selected."""
    selected = {word for _, word in _selected(words)}
    found = ((name, package.problem) for name, package in sorted(workspace().packages.items()))
    return {name: problem for name, problem in found if problem and (name in selected or not selected)}


def _unknown(words: Sequence[str]) -> Iterator[tuple[str, str]]:
    known = frozenset(package_names())
    return ((option, word) for option, word in _selected(words) if word not in known)


def _selected(words: Sequence[str]) -> Iterator[tuple[str, str]]:
    option = ""
    for word in words:
        if word.startswith("-"):
            option = word
        elif option in SELECTING:
            yield option, word
