"""How a verb reaches its system: in the domain, or through named routers."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from bot_console.tui.session.embedded.domain import CONNECT_VARIABLE, domain, join_domain

if TYPE_CHECKING:
    from bot_console.runtime.rmw.bus import Bus


def named_routers() -> list[str]:
    """The endpoints of the robot's router that the environment names; empty if it names none."""
    return os.environ.get(CONNECT_VARIABLE, "").split()


def why_router_is_unused() -> str:
    """That nodes are started on this machine although the environment names a robot's router; empty if it does not."""
    endpoints = " ".join(named_routers())
    if not endpoints:
        return ""
    return (
        f"{CONNECT_VARIABLE} names {endpoints}, but what is started here runs in ROS domain {domain()} of this "
        "machine; `bot-console run` without options runs one node behind that router"
    )


def report_unused_router() -> None:
    """Print that, for programs that start nodes."""
    if why := why_router_is_unused():
        print(f"[WARN] [bot-console]: {why}", file=sys.stderr)


def reach_system() -> str:
    """Join the domain of this machine, or become a client of the robot's router named by the environment."""
    endpoints = named_routers()
    if not endpoints:
        return join_domain()
    from bot_console.tui.session.embedded.connecting import connect_to

    return connect_to(endpoints)


def reach_ros() -> str:
    """Like `reach_system`, for a program that imports ROS names itself."""
    from bot_console.runtime.importer import install

    problem = reach_system()
    install()
    return problem


def reach_when_asked() -> None:
    """Connect with the first context, for verbs that rarely make one; if that fails, the verb runs isolated."""
    from bot_console.runtime.rmw.local import local_bus
    from bot_console.runtime.rmw.middleware import bus_of, choose_middleware

    def reach(domain: int) -> Bus:
        if reach_system():
            choose_middleware(local_bus)
        return bus_of(domain)

    choose_middleware(reach)
