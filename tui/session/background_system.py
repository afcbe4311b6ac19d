"""The process of a background system: a launch host without a console.

Run as `python -m bot_console.tui.session.background_system LOG WORDS...`, with the words of `bot-console up`.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from bot_console.tui.cli.arguments import Options, parse
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.model import Severity
from bot_console.tui.session import robot_starter
from bot_console.tui.session.composition import become_host, launcher_here, node_process, serve
from bot_console.tui.session.embedded.domain import begin_program, end_program, nodes_there
from bot_console.tui.session.embedded.named_launch import with_launch_file
from bot_console.tui.session.embedded.process_report_lines import log_process_reports
from bot_console.tui.session.embedded.workspaces import SIMULATOR_LAUNCH, SYSTEM_LAUNCH
from bot_console.tui.session.launch_host.host import LaunchHost
from bot_console.tui.session.protocol import ClosableLauncher
from bot_console.tui.session.system_log import SystemLog

ROBOT_SEARCH_TIMEOUT_S = 5.0
"""Seconds that the search for a robot may take to stop."""


def main(words: Sequence[str] | None = None) -> int:
    """Run the system until it is asked to end; returns 1 if it could not be launched; the log says why."""
    log, *rest = sys.argv[1:] if words is None else words
    options = parse(["--headless", *rest])
    problem = become_host(options.workspace)
    options, no_file = with_launch_file(options)
    if problem := no_file or problem:
        print(problem, file=sys.stderr)
        return 1
    return _run(options, Path(log))


def _run(options: Options, file: Path) -> int:
    log = SystemLog(file)
    made: list[ClosableLauncher] = []

    def make(record: Add, printed: Callable[[int, str, str], None]) -> ClosableLauncher:
        made.append(launcher_here(record, printed, every=log.logged))
        return made[0]

    host = LaunchHost(make, log.printed)
    forget = log_process_reports(host.noticed, host.learn)  # before the nodes start: they report their declarations
    [launcher] = made
    arguments = dict(options.launch_arguments)
    if not options.launch:
        arguments = {**options.profile_arguments, **robot_starter.arguments(options), **arguments}

    def report(text: str) -> None:
        host.printed(Severity.INFO, "bot-console", text)

    def start_robot(arguments: Mapping[str, str]) -> None:
        launcher.launch(SIMULATOR_LAUNCH, arguments)

    others = len(nodes_there())
    answer = launcher.launch(options.launch or SYSTEM_LAUNCH, arguments).result()
    if not answer.ok:
        print(answer.text, file=sys.stderr)
        host.close()
        return 1
    system = robot_starter.System(lambda: robot_starter.processes(launcher.info()), report, start_robot, others)
    watching = robot_starter.begin(options, system, node_process)
    serve(host, options.duration, forget)
    if watching is not None:
        watching.stop(ROBOT_SEARCH_TIMEOUT_S)
    log.close()
    return 0


if __name__ == "__main__":
    begin_program()
    end_program(main())
