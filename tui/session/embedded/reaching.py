"""How a verb reaches its system: through the domain, or through routers that are named."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from bot_console.tui.session.embedded.domain import CONNECT_VARIABLE, domain, join_domain

if TYPE_CHECKING:
    from bot_console.runtime.rmw.bus import Bus


def named_routers() -> list[str]:
    """The endpoints of the robot's router that the environment names; empty if it names none."""
    return os.environ.get(CONNECT_VARIABLE, "").split()


def without_connect(words: Sequence[str]) -> str:
    """How to write a command line without `--connect`, which only `attach` and `doctor` take; empty if it has none."""
    from shlex import join

    place = next((at for at, each in enumerate(words) if each.partition("=")[0] == "--connect"), None)
    if place is None:
        return ""
    _, given, endpoint = words[place].partition("=")
    rest = [*words[:place], *words[place + 1 :]]
    if not given and place < len(rest) and rest[place].find("/") > 0:  # neither a node nor a topic
        endpoint = rest.pop(place)
    endpoint = endpoint or "tcp/robot:7447"
    if place == 0:
        return f"--connect follows a command; write `bot-console attach --connect {endpoint}`"
    line = f"{CONNECT_VARIABLE}={endpoint} bot-console {join(rest)}"
    return f"only attach and doctor take --connect; write `{line}`"


def leave_router() -> str:
    """Forget the robot's router that the environment names, for this program and all programs that it starts.

    Returns a warning that nodes are started on this machine all the same; empty if no router was named.
    """
    endpoints = " ".join(named_routers())
    os.environ.pop(CONNECT_VARIABLE, None)
    if not endpoints:
        return ""
    return (
        f"{CONNECT_VARIABLE} names {endpoints}, but what is started here runs in ROS domain {domain()} of this "
        "machine; `bot-console run` without options runs one node behind that router"
    )


def report_left_router() -> None:
    """Forget the robot's router in a program that starts nodes, and print the warning."""
    if why := leave_router():
        print(f"[WARN] [bot-console]: {why}", file=sys.stderr)


def reach_system() -> str:
    """Join this machine's domain, or connect to the router in the environment; returns why that fails, if it does."""
    endpoints = named_routers()
    if not endpoints:
        return join_domain()
    from bot_console.tui.session.embedded.connecting import connect_to

    return connect_to(endpoints)


def reach_ros() -> str:
    """Do as `reach_system`, for a program that imports ROS names itself."""
    from bot_console.runtime.importer import install

    problem = reach_system()
    install()
    return problem


def reach_when_asked() -> None:
    """Connect with the first context, for verbs that rarely create one; if that fails, the verb runs isolated."""
    from bot_console.runtime.rmw.local import local_bus
    from bot_console.runtime.rmw.middleware import bus_of, choose_middleware

    def reach(domain: int) -> Bus:
        if reach_system():
            choose_middleware(local_bus)
        return bus_of(domain)

    choose_middleware(reach)
