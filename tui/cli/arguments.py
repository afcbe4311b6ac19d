"""The options of `bot-console` itself."""

from __future__ import annotations

import argparse
import os
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bot_console.tui import __version__
from bot_console.tui.arrangement.rqt_command_line import Opening, is_rqt, parse_rqt_command
from bot_console.tui.cli.numbers import positive, seed
from bot_console.tui.pane_table import PANES, PaneEntry
from bot_console.tui.session.embedded.named_profile import (
    NamedProfile,
    NoProfileError,
    bundled_names,
    named_profile,
    profile_names,
)
from bot_console.tui.settings.names import THEME_NAMES

LEAST_SIMILARITY = 0.8
"""The minimum similarity, from 0 to 1, of a mistyped word to the one that is suggested."""
EXAMPLES = """\
examples:
  bot-console                              a robot in an office, with its parameters, log and map
  bot-console outdoor                      the same robot outdoors
  bot-console --launch my.launch.py a:=1   any ROS 2 launch file; also --launch my_package my.launch.py
  bot-console run my_node.py               your own node, alone in this terminal
  bot-console run --watch my_node.py       the same, with the console open on it
  bot-console launch my_package x.launch.py
  bot-console attach                       the console on a running system, without starting a robot
  bot-console attach --connect tcp/robot:7447
  bot-console doctor                       what is wrong with terminal, machine, link and graph, and how to fix it
  bot-console --headless --fast --profile warehouse --duration 600 --seed 7

commands: attach, bag, check, config, doctor, down, export, graph, launch, launch_test, learn, lint, release, reset,
router, run, serve, setup, status, stop, test, tune, up; also the verbs of ros2, such as
bot-console interface show std_msgs/msg/String; `bot-console COMMAND --help` explains each

exit codes: 0 success, 1 failure (one line says why), 2 wrong usage
"""


@dataclass
class Options:
    """The options given."""

    profile: str = "indoor"
    profile_file: str = ""
    """The absolute path of the profile's file; empty if it comes with the robot."""
    launch: str = ""
    """The path of a launch file; with `launch_file`, the package that contains it."""
    launch_file: str = ""
    """The name of a launch file in that package."""
    launch_arguments: dict[str, str] = field(default_factory=dict[str, str])
    opening: Opening = field(default_factory=Opening)
    workspace: list[Path] = field(default_factory=list[Path])
    headless: bool = False
    fast: bool = False
    duration: float | None = None
    seed: int | None = None
    world: str = ""
    profile_folders: list[Path] = field(default_factory=list[Path])
    """Further folders in which to look for profiles."""
    simulator: bool | None = None
    """Whether to run the simulated robot beside a launch file; None: if its nodes need a robot and there is none."""
    layout: str = ""
    """The layout to start with; empty: the one in the settings."""
    theme: str = ""
    plain: bool | None = None
    """Whether to draw with ASCII characters instead of lines and braille; None: as the settings or the locale say."""
    attach: bool = False
    """Whether the console shows what is already running in the domain and starts nothing."""
    reached_by: str = ""
    """With `attach`: the endpoints of a robot on the network; empty: this machine."""
    read_only: bool = False
    """Whether the console may not change anything."""
    extra_panes: Sequence[PaneEntry] = ()
    """Further panes of a command, shown like those of plug-ins."""

    @property
    def profile_arguments(self) -> dict[str, str]:
        """The arguments of the robot's launch file that choose the profile."""
        return {"config_file": self.profile_file} if self.profile_file else {"profile": self.profile}


def attach_parser() -> argparse.ArgumentParser:
    """Return the parser of the options that all ways of attaching have in common."""
    parser = argparse.ArgumentParser(
        "bot-console attach",
        description="Open the console on a running system, without starting a robot. The names of rqt's tools do "
        "the same, and open the matching pane.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--pane", default="overview", help="pane to open first (default: overview)")
    parser.add_argument(
        "--workspace", action="append", type=Path, metavar="DIR", help="folder with packages; may be repeated"
    )
    add_profile_folders(parser)
    _add_appearance(parser)
    return parser


def parse_attach(words: Sequence[str], parser: argparse.ArgumentParser) -> tuple[Options, argparse.Namespace]:
    """Parse the words after `attach`; ends the program with exit code 2 for wrong usage."""
    opening, words = parse_rqt_command(words) if is_rqt(words) else (None, words)
    given = parser.parse_args(words)
    _require_pane(parser, given.pane)
    opening = _with_perspective(opening or Opening(given.pane), given)
    options = Options(
        opening=opening,
        workspace=given.workspace or [],
        profile_folders=given.profiles or [],
        attach=True,
        read_only=given.read_only,
        **_appearance(given),
    )
    return options, given


def _add_appearance(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--read-only", action="store_true", help="only watch and stop the robot: set, drive, start and end nothing")
    add(
        "--layout", default="", metavar="NAME", help="layout to start with, such as overview, the default of a new user"
    )
    add("--perspective-file", default="", metavar="FILE", help="layout file or rqt perspective to start with")
    add(
        "--theme",
        default="",
        choices=THEME_NAMES,
        help="colour theme (default: the one in the settings, see `bot-console config`)",
    )
    add(
        "--plain", action=argparse.BooleanOptionalAction, help="draw with ASCII characters instead of lines and braille"
    )


def _appearance(given: argparse.Namespace) -> dict[str, Any]:
    return {"layout": given.layout, "theme": given.theme, "plain": given.plain}


def _with_perspective(opening: Opening, given: argparse.Namespace) -> Opening:
    return opening._replace(perspective=given.perspective_file) if given.perspective_file else opening


def parse(words: Sequence[str], commands: Collection[str] = ()) -> Options:
    """Parse a command line; ends the program with exit code 2 for wrong usage.

    If a word is mistyped, a similar one of `commands` is suggested.
    """
    parser = option_parser()
    opening, words = parse_rqt_command(words) if is_rqt(words) else (None, words)
    given = parser.parse_args(words)
    _require_pane(parser, given.pane)
    profile, name, pairs = _parse_words(parser, given, commands)
    if profile.launch:
        given.launch, pairs = profile.launch, {**profile.arguments, **pairs}
    if given.simulator is not None and not given.launch:
        parser.error("--simulator and --no-simulator need --launch: the robot system has its own robot")
    if given.launch is not None and not given.launch.strip():
        parser.error("--launch: give the name of a launch file")
    if given.allow_missing:
        if not given.launch:
            parser.error("--allow-missing needs --launch: the robot system has no missing executables")
        pairs["allow_missing"] = "true"
    if given.fast and not given.headless:
        parser.error("--fast needs --headless: a screen shows real time")
    return Options(
        profile=profile.name,
        profile_file=profile.path,
        launch=given.launch or "",
        launch_file=name,
        launch_arguments=pairs,
        opening=_with_perspective(opening or Opening(given.pane), given),
        workspace=given.workspace or [],
        headless=given.headless,
        fast=given.fast,
        duration=given.duration,
        seed=given.seed,
        world=given.world or "",
        profile_folders=given.profiles or [],
        simulator=given.simulator,
        read_only=given.read_only,
        **_appearance(given),
    )


def _require_pane(parser: argparse.ArgumentParser, pane: str) -> None:
    named = {each.id for each in PANES} | {"overview"}
    if pane not in named:
        parser.error(f"there is no pane '{pane}'; panes: {', '.join(sorted(named))}")


def _parse_words(
    parser: argparse.ArgumentParser, given: argparse.Namespace, commands: Collection[str]
) -> tuple[NamedProfile, str, dict[str, str]]:
    """The profile, the name of a package's launch file, and the arguments NAME:=VALUE."""
    pairs: dict[str, str] = {}
    profiles: list[str] = [] if given.profile is None else [given.profile]
    for word in given.words:
        name, assigned, value = word.partition(":=")
        if assigned and name:
            pairs[name] = value
        else:
            profiles.append(word)
    if given.launch:
        return NamedProfile("indoor"), _launch_file(parser, profiles, given), pairs
    if len(profiles) > 1 and (similar := _similar(profiles[0], commands)):
        parser.error(similar)
    if len(profiles) == 2 and not {*profiles} & {*profile_names(given.profiles or ())}:
        how = "--headless" if given.headless else "--watch"
        parser.error(f"a node of a package runs with `bot-console run {how} {' '.join(profiles)}`")
    if len(profiles) > 1:
        parser.error(f"one profile at a time, not {', '.join(profiles)}")
    try:
        profile = named_profile(
            profiles[0] if profiles else "indoor",
            given.profiles or (),
            given.workspace or (),
            expected="profile and no command",
        )
    except NoProfileError as error:
        similar = _similar(profiles[0], [*commands, *profile_names(given.profiles or ())]) if profiles else ""
        parser.error(similar or str(error))
    return profile, "", pairs


def _similar(word: str, known: Collection[str]) -> str:
    """A message that suggests a known word for a mistyped one; empty if none is similar."""
    from bot_console.runtime.programs.hints import did_you_mean

    meant = "" if word in known else did_you_mean(word, known, "'", LEAST_SIMILARITY)
    return f"there is no profile and no command '{word}'{meant}" if meant else ""


def _launch_file(parser: argparse.ArgumentParser, words: Sequence[str], given: argparse.Namespace) -> str:
    """The name of a launch file given after a package; empty after a path, which nothing else may follow."""
    if given.profile is not None or (words and words[0] in bundled_names()):
        parser.error("a launch file brings its own settings: give either a profile or --launch")
    left = [*words] if os.path.isfile(given.launch) else words[1:]  # `Path` raises if the name is too long
    if left:
        parser.error(f"malformed launch argument '{left[0]}', expected format '<name>:=<value>'")
    return words[0] if words else ""


def add_profile_folders(parser: argparse.ArgumentParser) -> None:
    """Add the option for folders with more profiles."""
    parser.add_argument(
        "--profiles",
        action="append",
        type=Path,
        metavar="DIR",
        help="folder with more profiles, for the Profiles pane and by name; may be repeated",
    )


SIMULATOR_HELP = "run the simulated robot alongside, or not (default: only if its nodes need a robot and there is none)"


def option_parser() -> argparse.ArgumentParser:
    """Return the parser of `bot-console` without a command."""
    parser = argparse.ArgumentParser(
        "bot-console",
        description="rqt for the terminal, with the robot included.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_system(parser)
    add = parser.add_argument
    add("--pane", default="overview", help="pane to open first (default: overview)")
    add("--headless", action="store_true", help="no console: logs on stderr, a JSON report on stdout at the end")
    add("--fast", action="store_true", help="with --headless: in simulated time, as fast as possible, reproducibly")
    add("--duration", type=positive, metavar="S", help="with --headless: seconds to run")
    _add_appearance(parser)
    add("--version", action="version", version=f"bot-console {__version__}")
    return parser


def add_background_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that describe a system, for the help of a command that starts it without a screen."""
    _add_system(parser)
    parser.add_argument("--duration", type=positive, metavar="S", help="seconds to run (default: until `down`)")


def _add_system(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add(
        "words",
        nargs="*",
        metavar="PROFILE | NAME:=VALUE",
        help=f"a profile: {', '.join(bundled_names())}, one of yours by name, or a parameter file",
    )
    add("--launch", metavar="FILE", help="start this launch file instead of the robot; also: --launch PACKAGE FILE")
    add("--workspace", action="append", type=Path, metavar="DIR", help="folder with packages; may be repeated")
    add("--distro", metavar="NAME", help="ROS 2 distribution to behave like: jazzy or kilted (default: jazzy)")
    add_profile_folders(parser)
    add("--profile", metavar="PROFILE", help="the same as the argument PROFILE")
    add("--seed", type=seed, metavar="N", help="seed of the simulated world")
    add("--world", metavar="NAME", help="world of the simulated robot")
    add("--simulator", action=argparse.BooleanOptionalAction, help=SIMULATOR_HELP)
    add(
        "--allow-missing",
        action="store_true",
        help="with --launch: continue without nodes whose executables are missing",
    )
