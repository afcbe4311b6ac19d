"""What may come next on the command line: verbs, and the names of what there is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from itertools import takewhile

from bot_console.tui.console.model import ConsoleSnapshot

Place = Callable[[Sequence[str]], Sequence[str]]
"""Gives what may stand at a place, from the words before it."""


def split(text: str) -> tuple[list[str], str]:
    """The words that are complete, and the one that was begun."""
    words = text.split()
    return (words, "") if not words or text[-1:].isspace() else (words[:-1], words[-1])


def fitting(offered: Sequence[str], begun: str) -> list[str]:
    """Those that begin as the word does; where there are none those that have it."""
    first = [each for each in offered if each.startswith(begun)]
    return first or [each for each in offered if begun.lower() in each.lower()]


def extended(found: Sequence[str], begun: str) -> str:
    """The word as far as all agree on it."""
    first, last = min(found, default=""), max(found, default="")
    # Of sorted words the first and the last differ soonest.
    same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(first, last, strict=False)))
    return first[:same] if first[:same].startswith(begun) else begun


def live_names(snapshot: ConsoleSnapshot, words: Sequence[str]) -> list[str] | None:
    """What `ros2 node list` and the like would print, from what the console knows; None for other lines."""
    graph = snapshot.graph
    if [*words[:2]] == ["param", "list"] and len(words) == 3:
        tree = snapshot.parameters.get(words[2])
        return [each.name for each in tree.parameters] if tree else []
    lists = {
        ("node", "list"): [each.name for each in graph.nodes if not each.hidden],
        ("topic", "list"): [each.name for each in graph.topics if "/_" not in each.name],
        ("service", "list"): [each.name for each in graph.services],
        ("action", "list"): sorted({one.name for each in graph.nodes for one in each.action_servers}),
    }
    return lists.get((*words,)) if len(words) == 2 else None  # pyright: ignore[reportArgumentType] -- two words


class Completion:
    """Finds what may stand at the end of a line; asked once for each place, narrowed while the word is typed."""

    def __init__(self, ask: Callable[[Sequence[str]], Future[Sequence[str]]]) -> None:
        """`ask` is given the words before the one that was begun, which is empty or begins an option."""
        self._ask = ask
        self._asked: tuple[str, ...] = ()
        self._answer: Future[Sequence[str]] | None = None

    def found(self, text: str) -> list[str]:
        """What the last word may become, as far as it is known by now."""
        before, begun = split(text)
        place = (*before, "-" if begun.startswith("-") else "")
        if self._answer is None or place != self._asked:
            self._asked, self._answer = place, self._ask(place)
        if not self._answer.done() or self._answer.exception() is not None:
            return []
        return fitting(sorted(self._answer.result()), begun)

    def forget(self) -> None:
        """The line was closed: what there is may have changed."""
        self._answer = None

    @property
    def waits(self) -> bool:
        """Whether the answer is still to come."""
        return self._answer is not None and not self._answer.done()
