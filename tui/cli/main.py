"""The program `bot-console`: dispatches command lines to its commands."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn

from bot_console.runtime.programs.exit_messages import help_is_english, report_help_errors, run_and_report
from bot_console.tui import __version__
from bot_console.tui.cli.encoding_check import encoding_problem
from bot_console.tui.cli.verbs import ros2
from bot_console.tui.learn.command_log import record_command
from bot_console.tui.session.embedded.domain import begin_program, end_program, others_take_part
from bot_console.tui.session.embedded.reaching import report_left_router, without_connect

Words = list[str]

_COMMANDS = {
    "attach": "main:_attach",
    "bag": "verbs.bag:run",
    "check": "check.run:run",
    "colcon": "verbs.colcon:run",
    "complete": "completion:run",
    "config": "verbs.config:run",
    "doctor": "doctor:run",
    "down": "verbs.background:down",
    "export": "verbs.export:run",
    "graph": "verbs.graph:run",
    "launch": "verbs.ros2:launch",
    "learn": "learn:run",
    "launch_test": "verbs.testing:launch_test",
    "lint": "lint.run:run",
    "release": "verbs.stop:release",
    "reset": "verbs.reset:run",
    "ros2": "main:ros2_command",
    "router": "verbs.router:run",
    "run": "verbs.run:run",
    "serve": "serve.run:run",
    "setup": "verbs.setup:run",
    "status": "verbs.background:status",
    "stop": "verbs.stop:stop",
    "test": "verbs.testing:test",
    "tune": "tune.run:run",
    "up": "verbs.background:up",
}
"""The module (below this package) and the function of each command, which takes the words; imported when needed."""

_CONNECTING = ("bag", "check", "graph", "lint", "release", "reset", "status", "stop")
"""Commands that, like the verbs of `ros2`, connect to the robot named by the environment."""

_ROS2 = {
    "bag": _COMMANDS["bag"],
    "daemon": "verbs.daemon:run",
    "doctor": "doctor:run_as_ros2",
    "launch": _COMMANDS["launch"],
    "run": _COMMANDS["run"],
    "wtf": "doctor:run_as_ros2",
}
"""Commands of `ros2` that are not among `ros2.VERBS`."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command line and return its exit code: 0 done, 1 failed, 2 wrong usage."""
    words = list(sys.argv[1:] if argv is None else argv)
    if words == ["--version"]:
        print(f"bot-console {__version__}")
        return 0
    help_is_english()
    report_help_errors()
    try:
        words = _without_workspace(_without_distro(words))
    except ValueError as error:
        print(f"bot-console: {error}", file=sys.stderr)
        if words[:1] != ["stop"]:
            return 2
        os.environ.pop("BOT_CONSOLE_DISTRO", None)  # nothing in the environment may prevent a stop
    sent = not words or words[0] in ("launch", "run", *ros2.VERBS) or words[0] not in _COMMANDS
    if sent and (problem := encoding_problem(words)):
        print(f"bot-console: {problem}", file=sys.stderr)
        return 2
    verb = next(iter(words[1:] if words[:1] == ["ros2"] else words), "")
    reaches = verb in (*ros2.VERBS, *_CONNECTING) or verb.startswith("--connect")
    if reaches and (problem := without_connect(words)):
        print(f"bot-console: {problem}", file=sys.stderr)
        return 2
    if words and words[0] in ros2.VERBS:  # first, to answer these fastest
        return ros2.run_in_domain(words)
    from bot_console.tui.arrangement.rqt_command_line import is_rqt, names_system

    if is_rqt(words):
        if others_take_part() or not names_system(words):
            return _attach(words)
    elif words and words[0] in _COMMANDS:
        return _load(_COMMANDS[words[0]])(words[1:])
    from bot_console.tui.cli.arguments import parse

    os.getcwd()  # Raises if the folder was deleted, in which nodes could not start; reported on one line.
    options = parse(words, commands=[*_COMMANDS, *ros2.VERBS])
    if options.headless:
        report_left_router()
        from bot_console.tui.cli.headless.run import run

        return run(options)
    if not _has_screen():
        return 1
    from bot_console.tui.cli.interpreter import without_collector

    with without_collector():
        from bot_console.tui.cli.open_console import run as show

        return show(options)


def _without_distro(words: Words) -> Words:
    """Handle the option `--distro`, and return the other words; raises `ValueError` for an unknown distribution."""
    if not os.environ.get("BOT_CONSOLE_DISTRO") and not any(each.startswith("--distro") for each in words):
        return words
    from bot_console.tui.cli.distro_option import without_distro

    return without_distro(words, lambda word: word in ros2.VERBS or word in _COMMANDS)


def is_command(word: str) -> bool:
    """Whether a word is a command of `bot-console`, or one of `ros2`."""
    return word in _COMMANDS or word in ros2.VERBS


def _without_workspace(words: Words) -> Words:
    """Handle a command's option `--workspace`, and return the other words; raises `ValueError` for a missing folder."""
    if not any(each.partition("=")[0] == "--workspace" for each in words):
        return words
    from bot_console.tui.cli.workspace_option import without_workspace

    if words[0] == "ros2":
        return ["ros2", *without_workspace(words[1:], lambda word: word in ros2.VERBS or word in _ROS2)]
    return without_workspace(words, lambda word: word in ros2.VERBS or word in _COMMANDS)


def program() -> NoReturn:
    """Run the command line of this process, and exit."""
    with record_command(sys.argv[1:]) as ended:
        code = ended(run_and_report(_program))
    end_program(code)


def _program() -> int:
    if signal.getsignal(signal.SIGINT) is signal.SIG_DFL:  # set during the imports; from here on, Ctrl-C is handled
        signal.signal(signal.SIGINT, signal.default_int_handler)
    begin_program()
    words = sys.argv[2:] if sys.argv[1:2] == ["ros2"] else sys.argv[1:]
    if words[:1] == ["launch"]:
        from bot_console.tui.session.embedded.early_fork_server import prefork

        prefork(words[1:], from_here=True)
    return main()


def _has_screen() -> bool:
    """Whether the console can be displayed on this operating system; prints a message if not."""
    try:
        import termios  # noqa: F401  # pyright: ignore[reportUnusedImport] -- whether it is there
    except ImportError:
        system = "the console needs a Linux or macOS terminal: on Windows, start it in WSL"
        print(f"{system}, or use `bot-console --headless` and the verbs of ros2", file=sys.stderr)
        return False
    return True


def _attach(words: Words) -> int:
    if not _has_screen():
        return 1
    from bot_console.tui.cli.attach import run
    from bot_console.tui.cli.interpreter import without_collector

    with without_collector():
        return run(words)


def _load(place: str) -> Callable[[Words], int]:
    from importlib import import_module  # late, since `--version` does not need it

    module, _, function = place.partition(":")
    return getattr(import_module(f"bot_console.tui.cli.{module}"), function)


def ros2_command(words: Words) -> int:
    """Run `bot-console ros2 WORDS`, like `bot-console WORDS` except for commands of that name that ROS 2 has too."""
    if problem := encoding_problem(words):
        print(f"ros2: {problem}", file=sys.stderr)
        return 2
    if words and words[0] in _ROS2:
        return _load(_ROS2[words[0]])(words[1:])
    return ros2.run_in_domain(words) if words and words[0] in ros2.VERBS else ros2.main(words)
