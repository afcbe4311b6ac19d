"""Starts the fork server of a launching program early, and watches the program's threads."""

from __future__ import annotations

import os
from collections.abc import Sequence

from bot_console.runtime.children.own_fork_server import CAN_FORK, fork_off_server, fork_server
from bot_console.runtime.children.warm_up import import_shared
from bot_console.runtime.process.current import MAIN
from bot_console.runtime.process.fork_server import has_one_thread
from bot_console.runtime.process.node.running import process_of_thread
from bot_console.runtime.process.notices import notify
from bot_console.runtime.process.watch.gil_watch import GilWatch
from bot_console.runtime.rmw.zenoh.domain.discovery_range import is_in_range

STARTS_NOTHING = {"-h", "--help", "-p", "--print", "--print-description", "-s", "--show-args", "--show-arguments"}
"""Arguments with which `launch` starts no process."""


def prefork(words: Sequence[str], *, from_here: bool = False) -> None:
    """Start the fork server early for a `launch` with these arguments, so that it warms up while the launch file is
    read.

    With `from_here`, in a program that has just started, it is forked from this process if possible. Raises
    `FileNotFoundError` if the working directory was deleted, in which no program could be started.
    """
    places = [each for each in words if not each.startswith("-") and ":=" not in each]
    names_file = len(places) > 1 or any(map(os.path.isfile, places))
    if CAN_FORK and is_in_range() and names_file and not STARTS_NOTHING.intersection(words):
        os.getcwd()
        if from_here and has_one_thread():
            import_shared()
            fork_off_server()
        else:
            fork_server()


def watch_threads() -> None:
    """Report when C code in a node that is a thread of this process blocks all other threads."""

    def report(ident: int, text: str) -> None:
        notify(process_of_thread(ident) or MAIN, text)

    GilWatch(report).begin()
