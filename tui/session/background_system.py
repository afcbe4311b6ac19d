"""The process of a background system: a launch host without a console.

`python -m bot_console.tui.session.background_system LOG WORDS...`; the words are those of `bot-console up`.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.tui.cli.arguments import Options, parse

SWITCH = "bot_console.tui.session.background_system"
ROBOT_SEARCH_TIMEOUT_S = 5.0
"""Seconds that the search for a robot may take to end."""


def main(words: Sequence[str] | None = None) -> int:
    """Run the system until it is asked to end; 1 if it could not be launched, which the log explains."""
    log, *rest = sys.argv[1:] if words is None else words
    options = parse(["--headless", *rest])
    install()
    from bot_console.tui.session.embedded.domain import take_part
    from bot_console.tui.session.embedded.own_processes import isolate, watch_threads
    from bot_console.tui.session.embedded.workspaces import choose
    from bot_console.tui.session.named_launch import with_launch_file

    choose(options.workspace)
    options, problem = with_launch_file(options)
    if problem := problem or take_part():
        print(problem, file=sys.stderr)
        return 1
    isolate()
    watch_threads()
    return _run(options, Path(log))


def _run(options: Options, file: Path) -> int:
    from bot_console.tui.console.launch.launcher import RosLauncher
    from bot_console.tui.console.launch.process_output import Add
    from bot_console.tui.console.model import Severity
    from bot_console.tui.session import robot_starter
    from bot_console.tui.session.embedded.domain import nodes_there
    from bot_console.tui.session.embedded.process_reports import log_process_reports
    from bot_console.tui.session.embedded.rotating_file import rotate_launch_files
    from bot_console.tui.session.embedded.workspaces import SYSTEM_LAUNCH
    from bot_console.tui.session.host_program import serve
    from bot_console.tui.session.launch_host.host import LaunchHost
    from bot_console.tui.session.launchers import launcher_here
    from bot_console.tui.session.system_log import SystemLog

    log = SystemLog(file)
    rotate_launch_files()
    made: list[RosLauncher] = []

    def make(record: Add, printed: Callable[[int, str, str], None]) -> RosLauncher:
        made.append(launcher_here(record, printed, every=log.logged))
        return made[0]

    host = LaunchHost(make, log.printed)
    forget = log_process_reports(host.noticed, host.learn)  # Before the nodes start, which report their declarations.
    [launcher] = made
    arguments = dict(options.launch_arguments)
    if not options.launch:
        arguments = {**options.profile_arguments, **robot_starter.arguments(options), **arguments}

    def report(text: str) -> None:
        host.printed(Severity.INFO, "bot-console", text)

    def start_robot(arguments: Mapping[str, str]) -> None:
        launcher.launch(robot_starter.LAUNCH_FILE, arguments)

    others = len(nodes_there())
    answer = launcher.launch(options.launch or SYSTEM_LAUNCH, arguments).result()
    if not answer.ok:
        print(answer.text, file=sys.stderr)
        host.close()
        return 1
    system = robot_starter.System(lambda: robot_starter.processes(launcher.info()), report, start_robot, others)
    watching = robot_starter.begin(options, system)
    serve(host, options.duration, forget)
    if watching is not None:
        watching.stop(ROBOT_SEARCH_TIMEOUT_S)
    log.close()
    return 0


if __name__ == "__main__":
    from bot_console.tui.session.embedded.domain import end_program

    end_program(main())
