"""The interface between a lesson and its pane: plain data, and the operations of the pane's keys. Pure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol

from bot_console.tui.console.model import Change, ConsoleSnapshot


@dataclass(frozen=True)
class LessonView:
    """The step that is shown: its place in the course, its text, its snippets, and its conditions."""

    chapter: str
    title: str
    number: int
    """The number of the step among `total` steps, from 1."""
    total: int
    done: int
    """The number of steps that are done."""
    text: str = ""
    snippets: tuple[tuple[str, str], ...] = ()
    """Each as a file and a text; the file is empty for a text to type into the shell."""
    waits: tuple[tuple[bool, str], ...] = ()
    """Each condition of the step: whether it holds, and what then is true or what is missing."""
    problem: str = ""
    """Why the progress cannot be saved; empty if it can."""

    @property
    def is_done(self) -> bool:
        """Whether all conditions hold."""
        return all(held for held, _ in self.waits)


@dataclass(frozen=True)
class OnScreen:
    """What a person has done in the console that no snapshot shows."""

    panes: frozenset[str] = frozenset()
    """The panes that were opened."""
    curves: frozenset[str] = frozenset()
    layouts: frozenset[str] = frozenset()
    steers: bool = False


class Lesson(Protocol):
    """A course in progress."""

    def observe(self, snapshot: ConsoleSnapshot, changes: Iterable[Change], screen: OnScreen) -> Sequence[str]:
        """Record what has happened, and return the titles of the steps that this has completed."""
        ...

    def view(self) -> LessonView:
        """Return the step to show now."""
        ...

    def go(self, by: int) -> None:
        """Show the step `by` steps further on, done or not; with 0, the next open one."""
        ...
