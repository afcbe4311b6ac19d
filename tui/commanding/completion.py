"""Completion of the command line: verbs, and the names of what exists."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from itertools import takewhile

from bot_console.tui.console.model import ConsoleSnapshot

Place = Callable[[Sequence[str]], Sequence[str]]
"""Returns the candidates for a position, given the words before it."""


def split(text: str) -> tuple[list[str], str]:
    """The complete words, and the one being typed."""
    words = text.split()
    return (words, "") if not words or text[-1:].isspace() else (words[:-1], words[-1])


def matching_candidates(offered: Sequence[str], begun: str) -> list[str]:
    """The candidates that begin with the word; if there are none, those that contain it."""
    first = [each for each in offered if each.startswith(begun)]
    return first or [each for each in offered if begun.lower() in each.lower()]


def common_extension(found: Sequence[str], begun: str) -> str:
    """The word, extended to the longest common prefix of the candidates."""
    first, last = min(found, default=""), max(found, default="")
    # The common prefix of the first and the last candidate in sorted order is that of all candidates.
    same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(first, last, strict=False)))
    return first[:same] if first[:same].startswith(begun) else begun


def live_names(snapshot: ConsoleSnapshot, words: Sequence[str]) -> list[str] | None:
    """The output of `ros2 node list` and similar lines, from what the console knows; None for other lines."""
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
    """Finds candidates for the end of a line: asks once per position, then narrows while the word is typed."""

    def __init__(self, ask: Callable[[Sequence[str]], Future[Sequence[str]]]) -> None:
        """`ask` receives the words before the one being typed, then an empty word, or `-` if that begins an option."""
        self._ask = ask
        self._asked: tuple[str, ...] = ()
        self._answer: Future[Sequence[str]] | None = None

    def found(self, text: str) -> list[str]:
        """The candidates for the last word that are known so far."""
        before, begun = split(text)
        place = (*before, "-" if begun.startswith("-") else "")
        if self._answer is None or place != self._asked:
            self._asked, self._answer = place, self._ask(place)
        if not self._answer.done() or self._answer.exception() is not None:
            return []
        return matching_candidates(sorted(self._answer.result()), begun)

    def forget(self) -> None:
        """Forget the candidates when the line is closed, since they may change until the next one."""
        self._answer = None

    @property
    def waits(self) -> bool:
        """Whether the answer is still pending."""
        return self._answer is not None and not self._answer.done()
