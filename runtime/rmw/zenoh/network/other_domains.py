"""Find the ROS domains in which a router has nodes: a console in the wrong domain sees none, without any error."""

from __future__ import annotations

from collections.abc import Iterable

from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from bot_console.runtime.rmw.zenoh.wire.tokens import NODES_OF_ALL_DOMAINS, parse_token

MAX_NAMED = 4
"""How many domains are named one by one."""


def other_domains(session: Session) -> str:
    """Return which domains have nodes if the session's domain has none, and how to join them; otherwise empty.

    Tools and consoles, whose names begin with an underscore, do not count. Only the names of nodes are queried, few
    enough for a slow link.
    """
    tokens, _ = session.collect_tokens(NODES_OF_ALL_DOMAINS, session.answer_timeout_s())
    domains = _domains(tokens)
    if not domains or session.domain in domains:
        return ""
    named = ", ".join(map(str, domains[:MAX_NAMED])) + (" and more" if len(domains) > MAX_NAMED else "")
    return f"no node in domain {session.domain}: set ROS_DOMAIN_ID={domains[0]}; nodes are in {named}"


def _domains(tokens: Iterable[str]) -> list[int]:
    found: set[int] = set()
    for each in tokens:
        try:
            token = parse_token(each)
        except FormatError:
            continue
        if not token.node.name.startswith("_"):
            found.add(int(each.split("/", 2)[1]))
    return sorted(found)
