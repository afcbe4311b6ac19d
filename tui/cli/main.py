"""The program `bot-console`: its commands, and what is done with the words after them."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn

from bot_console.tui import __version__
from bot_console.tui.cli.system.domain import end_program, others_take_part
from bot_console.tui.cli.verbs import ros2

Words = list[str]


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command line and give its exit code: 0 done, 1 failed, 2 wrong usage."""
    words = list(sys.argv[1:] if argv is None else argv)
    if words == ["--version"]:
        print(f"bot-console {__version__}")
        return 0
    from bot_console.runtime.terse import help_tells_faults
    from bot_console.tui.opening import is_rqt

    help_tells_faults()
    if is_rqt(words):
        if others_take_part():
            return _attach(words)
    else:
        command = _COMMANDS.get(words[0]) if words else None
        if command:
            return command(words[1:])
        if words and words[0] in ros2.VERBS:
            return ros2.taking_part(words)
    from bot_console.tui.cli.arguments import parse

    os.getcwd()  # raises where the folder was deleted, which is said in one line; nodes could not be started in it
    options = parse(words)
    if options.headless:
        from bot_console.tui.cli.headless.run import run

        return run(options)
    if not _has_screen():
        return 1
    from bot_console.tui.cli.interpreter import without_collector

    with without_collector():
        from bot_console.tui.cli.show import run as show

        return show(options)


def program() -> NoReturn:
    """The command as a process."""
    from bot_console.runtime.terse import told

    end_program(told(main))


def _has_screen() -> bool:
    """Whether this system's terminals are such that the console can show itself; it is told where they are not."""
    try:
        import termios  # noqa: F401  # pyright: ignore[reportUnusedImport]
    except ImportError:
        system = "the console needs a terminal of Linux or macOS: on Windows start it in WSL"
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


def _run(words: Words) -> int:
    from bot_console.tui.cli.verbs.run import run

    return run(words)


def _launch(words: Words) -> int:
    from bot_console.tui.cli.system.own_processes import foresee

    foresee(words)
    from bot_console.tui.cli.system.workspaces import tell_whose

    tell_whose(next((each for each in words if not each.startswith("-")), ""))
    return ros2.taking_part(["launch", *words])


def _ros2(words: Words) -> int:
    if words and words[0] in _ROS2:
        return _ROS2[words[0]](words[1:])
    return ros2.taking_part(words) if words and words[0] in ros2.VERBS else ros2.main(words)


def _export(words: Words) -> int:
    from bot_console.tui.cli.verbs.export import run

    return run(words)


def _bag(words: Words) -> int:
    from bot_console.tui.cli.verbs.bag import run

    return run(words)


def _config(words: Words) -> int:
    from bot_console.tui.cli.verbs.config import run

    return run(words)


def _setup(words: Words) -> int:
    from bot_console.tui.cli.verbs.setup import run

    return run(words)


def _complete(words: Words) -> int:
    from bot_console.tui.cli.completion import run

    return run(words)


def _up(words: Words) -> int:
    from bot_console.tui.cli.verbs.background import up

    return up(words)


def _down(words: Words) -> int:
    from bot_console.tui.cli.verbs.background import down

    return down(words)


def _status(words: Words) -> int:
    from bot_console.tui.cli.verbs.background import status

    return status(words)


def _doctor(words: Words) -> int:
    from bot_console.tui.cli.doctor import run

    return run(words)


def _ros2_doctor(words: Words) -> int:
    report = ("--report", "-r", "--include-warnings", "-iw")  # ours is always a report, and with its warnings
    return _doctor([each for each in words if each not in report])


def _daemon(words: Words) -> int:
    from bot_console.tui.cli.verbs.daemon import run

    return run(words)


def _router(words: Words) -> int:
    from bot_console.tui.cli.verbs.router import run

    return run(words)


def _stop(words: Words) -> int:
    from bot_console.tui.cli.verbs.stop import run

    return run("stop", words)


def _release(words: Words) -> int:
    from bot_console.tui.cli.verbs.stop import run

    return run("release", words)


def _reset(words: Words) -> int:
    from bot_console.tui.cli.verbs.reset import run

    return run(words)


def _check(words: Words) -> int:
    from bot_console.tui.cli.check.run import run

    return run(words)


def _graph(words: Words) -> int:
    from bot_console.tui.cli.verbs.graph import run

    return run(words)


def _test(words: Words) -> int:
    from bot_console.tui.cli.verbs.testing import test

    return test(words)


def _launch_test(words: Words) -> int:
    from bot_console.tui.cli.verbs.testing import launch_test

    return launch_test(words)


def _colcon(words: Words) -> int:
    from bot_console.runtime.importer import install
    from bot_console.tui.cli.verbs.colcon import run

    install()
    return run(words)


def _lint(words: Words) -> int:
    from bot_console.tui.cli.lint.run import run

    return run(words)


def _tune(words: Words) -> int:
    from bot_console.tui.cli.tune.run import run

    return run(words)


_COMMANDS: dict[str, Callable[[Words], int]] = {
    "run": _run,
    "launch": _launch,
    "ros2": _ros2,
    "attach": _attach,
    "export": _export,
    "bag": _bag,
    "config": _config,
    "setup": _setup,
    "complete": _complete,
    "up": _up,
    "down": _down,
    "status": _status,
    "lint": _lint,
    "tune": _tune,
    "doctor": _doctor,
    "router": _router,
    "stop": _stop,
    "release": _release,
    "graph": _graph,
    "check": _check,
    "reset": _reset,
    "test": _test,
    "launch_test": _launch_test,
    "colcon": _colcon,
}

_ROS2: dict[str, Callable[[Words], int]] = {
    "run": _run,
    "launch": _launch,
    "bag": _bag,
    "doctor": _ros2_doctor,
    "wtf": _ros2_doctor,
    "daemon": _daemon,
}
"""What `ros2` has that is not among the recorded verbs, or does more than they do."""
