"""Completes command lines for shells.

Names come from the output of the verbs that a person would use, so that the verbs accept every completion.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import Protocol

from bot_console.runtime.importer import install
from bot_console.tui.files.folders import expanded_path
from bot_console.tui.session.embedded.domain import others_take_part, take_part
from bot_console.tui.session.embedded.named_profile import profile_names


class NameSource(Protocol):
    """The source of names."""

    def lines_of(self, *words: str) -> list[str]:
        """The lines that a `ros2` verb prints; none if it fails."""
        ...

    def live_lines_of(self, *words: str) -> list[str]:
        """The same for verbs that query the running system."""
        ...


Source = Callable[[NameSource, Sequence[str]], Iterable[str]]
"""Returns the candidates for a place, given the words before it."""


def run(words: Sequence[str]) -> int:
    """Print the candidates for the last word, one per line; the first word is the program."""
    for each in candidates(words[1:]):
        print(each)
    return 0


def candidates(words: Sequence[str], names: NameSource | None = None) -> list[str]:
    """The candidates for the last word; the words before it are complete."""
    *before, begun = words or [""]
    if before and before[0] == "ros2":
        before = before[1:]
    found = {each for each in _candidates(names or ShellNames(), before, begun) if each.startswith(begun)}
    return sorted(each for each in found if each != begun or not each.endswith(":="))  # the value comes after `:=`


def _candidates(names: NameSource, before: list[str], begun: str) -> Iterable[str]:
    install()
    from ros2cli.command_line import COMMANDS, load

    if before[-1:] == ["--profile"]:
        return _profiles(before)
    if not before:
        return [*COMMANDS, *_OURS, *_profiles(before)]
    command = load(before[0])
    if command is None:
        return _OUR_SOURCES[before[0]](names, before[1:]) if before[0] in _OUR_SOURCES else _OURS.get(before[0], ())
    verb = next((each for each in command.verbs if len(before) > 1 and each.name == before[1]), None)
    if command.verbs and verb is None:
        return [each.name for each in command.verbs] if len(before) == 1 else ()
    if begun.startswith("-"):
        return _options(verb.arguments if verb else command.arguments)
    key = (before[0], verb.name if verb else "")
    given = [word for word in before[2 if verb else 1 :] if not word.startswith("-")]
    places = _PLACES.get(key) or _PLACES.get((before[0], "*"), ())
    return places[len(given)](names, given) if len(given) < len(places) else ()


def _options(arguments: Callable[[argparse.ArgumentParser], None]) -> list[str]:
    parser = argparse.ArgumentParser()
    arguments(parser)
    return [option for action in parser._actions for option in action.option_strings]  # pyright: ignore[reportPrivateUsage] -- argparse offers no other way


class ShellNames:
    """The names for a shell; they come from verbs run in this process, whose output is captured."""

    def lines_of(self, *words: str) -> list[str]:
        """The lines that a verb prints; none if it fails."""
        from ros2cli.command_line import main

        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(io.StringIO()):
            failed = main(words)
        return [] if failed else [line.strip() for line in printed.getvalue().splitlines()]

    def live_lines_of(self, *words: str) -> list[str]:
        """The same for verbs that query the running system; returns nothing, at once, if the domain is empty."""
        return self.lines_of(*words) if others_take_part() and not take_part() else []


def _names(*words: str) -> Source:
    return lambda names, given: names.lines_of(*words)


def _running(*words: str) -> Source:
    return lambda names, given: names.live_lines_of(*words)


def _profiles(before: Sequence[str]) -> Iterable[str]:
    """The profiles that can be named, including those in the folders after `--profiles`."""
    given = pairwise(before)
    return profile_names([expanded_path(folder) for option, folder in given if option == "--profiles"])


def _parameters(names: NameSource, given: Sequence[str]) -> Iterable[str]:
    return names.live_lines_of("param", "list", given[0])


def _executables(names: NameSource, given: Sequence[str]) -> Iterable[str]:
    return (line.partition(" ")[2] for line in names.lines_of("pkg", "executables", given[0]))


def _files(names: NameSource, given: Sequence[str]) -> Iterable[str]:
    return (name for name in os.listdir(".") if name.endswith((".py", ".xml", ".yaml", ".yml")))


def _packages_and_files(names: NameSource, given: Sequence[str]) -> Iterable[str]:
    return [*names.lines_of("pkg", "list"), *_files(names, given)]


def _launch_files(names: NameSource, given: Sequence[str]) -> Iterable[str]:
    from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

    try:
        share = get_package_share_directory(given[0])
    except (PackageNotFoundError, ValueError):
        return []
    endings = ("launch.py", "launch.xml", "launch.yaml", "launch.yml")
    return [name for _, _, names in os.walk(share) for name in names if name.endswith(endings)]


def _type_of(command: str) -> Source:
    """The types of the topic, service or action named before; all interface types if none was named."""
    return lambda names, given: names.live_lines_of(command, "type", given[0]) or names.lines_of("interface", "list")


def _launch_arguments(names: NameSource, given: Sequence[str]) -> Iterable[str]:
    """The arguments of a package's launch file, up to `:=`."""
    reported = names.lines_of("launch", given[0], given[1], "--show-args")
    return [f"{line[1:-2]}:=" for line in reported if line.startswith("'") and line.endswith("':")]


_NODE = _running("node", "list")
_TOPIC = _running("topic", "list")
_SERVICE = _running("service", "list")
_ACTION = _running("action", "list")
_PACKAGE = _names("pkg", "list")
_TYPE = _names("interface", "list")

_OURS: dict[str, Sequence[str]] = {
    "attach": (),
    "bag": ("burst", "convert", "info", "list", "open", "play", "record", "reindex", "snapshot"),
    "check": ("--course", "--json", "--junit", "--seed", "--start"),
    "config": (),
    "daemon": ("start", "status", "stop"),
    "doctor": ("--capture", "--connect", "--json", "--range", "--ros", "--seconds"),
    "down": (),
    "export": (),
    "graph": ("--check", "--findings", "--rates"),
    "learn": ("--list", "--new", "--workspace"),
    "lint": (),
    "release": (),
    "reset": ("--dry-run",),
    "ros2": (),
    "router": (),
    "serve": ("--control", "--host", "--port", "--sessions", "attach"),
    "setup": ("bash", "editor", "fish", "venv", "zsh"),
    "status": (),
    "stop": (),
    "test": (),
    "tune": (),
    "up": (),
    "rqt": (),
    "rqt_console": (),
    "rqt_graph": (),
    "rqt_plot": (),
    "rqt_reconfigure": (),
    "rqt_robot_steering": (),
}
"""The commands that `ros2` does not have, and the words that may follow each."""

_OUR_SOURCES: dict[str, Source] = {
    "rqt_plot": _TOPIC,
    "rqt_reconfigure": _NODE,
    "up": lambda names, given: _profiles(given),
}
"""Of these commands, those after which names of topics, nodes or profiles are completed."""

_PLACES: dict[tuple[str, str], Sequence[Source]] = {
    ("action", "send_goal"): (_ACTION, _type_of("action")),
    ("action", "*"): (_ACTION,),
    ("component", "*"): (_running("component", "list", "--containers-only"), _PACKAGE),
    ("component", "types"): (_PACKAGE,),
    ("interface", "package"): (_names("interface", "packages"),),
    ("interface", "*"): (_TYPE,),
    ("interface", "list"): (),
    ("launch", ""): (_packages_and_files, _launch_files, _launch_arguments),
    ("lifecycle", "*"): (_running("lifecycle", "nodes"),),
    ("node", "info"): (_NODE,),
    ("param", "dump"): (_NODE,),
    ("param", "list"): (_NODE,),
    ("param", "load"): (_NODE, _files),
    ("param", "*"): (_NODE, _parameters),
    ("pkg", "executables"): (_PACKAGE,),
    ("pkg", "prefix"): (_PACKAGE,),
    ("pkg", "xml"): (_PACKAGE,),
    ("run", ""): (_PACKAGE, _executables),
    ("service", "find"): (_TYPE,),
    ("service", "call"): (_SERVICE, _type_of("service")),
    ("service", "*"): (_SERVICE,),
    ("topic", "find"): (_TYPE,),
    ("topic", "pub"): (_TOPIC, _type_of("topic")),
    ("topic", "*"): (_TOPIC,),
}
"""The candidates at each position after a verb; `*` stands for all verbs without an entry."""
