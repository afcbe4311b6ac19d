"""The start of a process forked for a stepped run: it joins the run and uses the run's middleware."""

from __future__ import annotations

import socket
from collections.abc import Callable, Sequence

from bot_console.runtime.process.fork_server import function_named
from bot_console.runtime.process.lockstep.member import Member
from bot_console.runtime.rmw.lockstep.bus import LockstepBuses
from bot_console.runtime.rmw.lockstep.session import Link
from bot_console.runtime.rmw.middleware import choose_middleware


def member_program(process: int, function: str, arguments: Sequence[object], channel: int) -> Callable[[], object]:
    """Join the run as process number `process`, and return the program to run, which the named function returns.

    `channel` is the descriptor of the connection to the coordinator.
    """
    member = Member(socket.socket(fileno=channel))
    link = Link(member.send, process)
    buses = LockstepBuses(link)
    choose_middleware(buses.of)
    member.join(link.take, buses.news)
    return function_named(function)(*arguments)
