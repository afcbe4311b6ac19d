"""What is in the graph at the moment when somebody starts watching it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from bot_console.runtime.rmw.zenoh.declared import TokenSeen, TokenWatch
from bot_console.runtime.rmw.zenoh.session import ATTENDANCE, Session

Known = Callable[[], "Iterable[str] | None"]
"""Gives the tokens that other watches of the session have seen and that are there; None where that is not known."""


def watch_all(session: Session, key: str, seen: TokenSeen, known: Known) -> TokenWatch:
    """Watch the tokens of a key apart from Zenoh's threads, and take in all that are there now.

    Among processes that are linked directly each has the tokens of all others, sent when a link was made: declaring the
    watch brings them before it returns, but for those that other watches of the session were told already, which a
    thread of Zenoh's tells some time later. So these are asked of the other watches. Else all is asked for once more.
    """
    watch = session.watch_tokens(key, seen, apart=True)
    watch.begin_question()
    there = known() if session.links_directly() and _all_links_carry(session) else None
    watch.found(session.collect_tokens(key, session.patience)[0] if there is None else there)
    if watch.taking is not None:
        watch.taking.take_waiting()
    watch.end_question()
    return watch


def _all_links_carry(session: Session) -> bool:
    """Whether all that are linked have answered a small question, over a link that comes after their first tokens.

    What comes over a link comes in its order, so nothing that was there when it was made is on its way any more.
    """
    linked = session.linked()
    here, answered = session.collect_tokens(f"{ATTENDANCE}*", session.patience)
    return answered and {each[:8] for each in linked} <= {each.removeprefix(ATTENDANCE) for each in here}
