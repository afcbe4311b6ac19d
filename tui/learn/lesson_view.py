"""The interface of a lesson that the lesson pane needs: plain data, and the few things that its keys do. Pure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol

from bot_console.tui.console.model import Change, ConsoleSnapshot


@dataclass(frozen=True)
class LessonView:
    """The step that is shown: where it stands, its text, what to type or to write, and what it waits for."""

    chapter: str
    title: str
    number: int
    """Counted from 1, among `total` steps."""
    total: int
    done: int
    """How many of all steps are done."""
    text: str = ""
    snippets: tuple[tuple[str, str], ...] = ()
    """File (empty: for the shell) and text of each."""
    waits: tuple[tuple[bool, str], ...] = ()
    """Each condition of the step: whether it holds, and what it asks for or what is missing."""
    problem: str = ""
    """Why the progress is not kept; empty if it is."""

    @property
    def is_done(self) -> bool:
        """Whether all conditions hold."""
        return all(held for held, _ in self.waits)


@dataclass(frozen=True)
class OnScreen:
    """The deeds of a person in the console, as far as no snapshot shows them."""

    panes: frozenset[str] = frozenset()
    """The panes that were opened."""
    curves: frozenset[str] = frozenset()
    layouts: frozenset[str] = frozenset()
    steers: bool = False


class Lesson(Protocol):
    """A course that is being worked through."""

    def observe(self, snapshot: ConsoleSnapshot, changes: Iterable[Change], screen: OnScreen) -> Sequence[str]:
        """Take in what has happened; the titles of steps that are done since."""
        ...

    def view(self) -> LessonView:
        """The step to show now."""
        ...

    def go(self, by: int) -> None:
        """Show the step so many further on, done or not; 0: the first that is open."""
        ...
