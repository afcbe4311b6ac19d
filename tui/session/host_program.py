"""The process that runs launch files for consoles: it contains the launches, and those nodes that are threads.

Run as `python -m bot_console.tui.session.host_program`; its options say whom it serves, see `launch_host.child`.
"""

from __future__ import annotations

import argparse
import socket
from collections.abc import Sequence
from pathlib import Path

from bot_console.tui.console.bags.snapshot_size import SnapshotSize
from bot_console.tui.session.composition import host_launches
from bot_console.tui.session.machine.hosting import host_launches as host_launches_of_machine


def main(words: Sequence[str] | None = None) -> int:
    """Serve until everything has ended: at a console's request, by a signal, or because the owner has gone."""
    given = _parser().parse_args(words)
    owner = socket.socket(fileno=given.owner)
    if given.ros:
        host_launches_of_machine(owner)
        return 0
    kept = SnapshotSize(given.keep_seconds, given.keep_bytes) if given.keep_bytes else None
    return host_launches(owner, [Path(each) for each in given.workspace], kept)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("launch_host")
    add = parser.add_argument
    add("--owner", type=int, required=True, metavar="DESCRIPTOR", help="the socket of the console that owns it")
    add("--ros", action="store_true", help="run one launch file of this machine's ROS 2")
    add("--keep-seconds", type=float, default=0.0, help="how much recorded traffic is kept in memory")
    add("--keep-bytes", type=int, default=0)
    add("--workspace", action="append", default=[], metavar="DIR", help="folder with packages")
    return parser


if __name__ == "__main__":
    from bot_console.tui.session.embedded.domain import begin_program, end_program

    begin_program()
    end_program(main())
