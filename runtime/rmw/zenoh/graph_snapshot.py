"""The contents of the graph at the moment when a watch of it begins."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from bot_console.runtime.rmw.zenoh.declarations import TokenCallback, TokenWatch
from bot_console.runtime.rmw.zenoh.session import ROLL_CALL_KEY, Session

Known = Callable[[], "Iterable[str] | None"]
"""Returns the existing tokens that other watches of the session have seen; None if they are not known."""


def watch_all(session: Session, key: str, seen: TokenCallback, known: Known) -> TokenWatch:
    """Watch the tokens of a key in a separate thread, and add all that exist now.

    Directly linked processes have each other's tokens, sent when the link was made: declaring the watch delivers them
    before it returns, except those already reported to other watches of the session, which a Zenoh thread delivers some
    time later. These are taken from the other watches. If that is not possible, all tokens are queried once more.
    """
    watch = session.watch_tokens(key, seen, apart=True)
    watch.begin_query()
    timeout_s = session.answer_timeout_s()
    there = known() if session.links_directly() and _all_links_carry(session, timeout_s) else None
    watch.add_existing(session.collect_tokens(key, timeout_s)[0] if there is None else there)
    if watch.taking is not None:
        watch.taking.take_waiting()
    watch.end_query()
    return watch


def _all_links_carry(session: Session, timeout_s: float) -> bool:
    """Whether all linked processes have answered a small query, before which their links deliver their first tokens.

    A link delivers in order, so no token that existed when the link was made is still in transit.
    """
    linked = session.linked()
    here, answered = session.collect_tokens(f"{ROLL_CALL_KEY}*", timeout_s)
    return answered and {each[:8] for each in linked} <= {each.removeprefix(ROLL_CALL_KEY) for each in here}
