"""Runs `ros2` verbs from a shell, on the system in the domain."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from bot_console.tui.cli.machine_limits import no_node_here
from bot_console.tui.session.embedded.domain import take_part
from bot_console.tui.session.embedded.reaching import reach_system, reach_when_asked, report_left_router

VERBS = ("action", "component", "interface", "lifecycle", "node", "param", "pkg", "service", "topic")
ALONE = ("interface", "pkg")
"""Verbs that answer from files, and query a running system only for definitions that are in none."""


def main(words: Sequence[str]) -> int:
    """Run a `ros2` command line in this process, which must do nothing else."""
    import gc

    from bot_console.runtime.importer import install

    gc.disable()  # Imported objects stay alive; traversing them repeatedly takes a tenth of a short verb's time.
    install()
    from ros2cli.command_line import load
    from ros2cli.command_line import main as run

    load(words[0] if words else "")
    gc.freeze()
    gc.enable()
    return run(words)


def run_in_domain(words: Sequence[str]) -> int:
    """Run a command line in the domain that the environment names; verbs that only read files do not join it."""
    problem = ""
    if words[0] in ALONE:
        reach_when_asked()
    else:
        problem = reach_system()
    if problem:
        print(problem, file=sys.stderr)
        return 1
    return main(words)


def launch(words: Sequence[str]) -> int:
    """Run a launch file in the domain that the environment names; a user's nodes get their own processes."""
    if problem := no_node_here():
        print(problem, file=sys.stderr)
        return 1
    from bot_console.tui.session.embedded.early_fork_server import prefork

    prefork(words)
    from bot_console.tui.session.embedded.workspaces import report_workspace

    report_workspace(next((each for each in words if not each.startswith("-")), ""))
    report_left_router()
    problem = take_part()
    if problem:
        print(problem, file=sys.stderr)
        return 1
    from bot_console.runtime.importer import install
    from bot_console.tui.session.embedded.early_fork_server import watch_threads

    install()
    watch_threads()
    return main(["launch", *words])
