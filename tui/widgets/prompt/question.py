"""The kinds of questions to the user: what is asked, and the callbacks for the answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeAlias, TypeVar

from bot_console.tui.console.model import Kind, LaunchArgument, Value
from bot_console.tui.console.topics.port import Payload, Topics

A = TypeVar("A")
Element: TypeAlias = "bool | int | float | str | bytes"
"""An element of an array."""


def _nothing(*_: object) -> None:
    """Ignore the end of a question."""


def _no_problem(*_: str) -> str:
    return ""


def _none(_: str) -> Sequence[Option]:
    return ()


@dataclass(frozen=True)
class Question(Generic[A]):
    """A question whose callbacks are bound to its subject, so that the answer needs no lookup."""

    label: str
    then: Callable[[A], object]
    """Called once with the answer."""

    gone: Callable[[], str] = _no_problem
    """Why the question has become pointless, for instance because a node has left; empty as long as it makes sense."""

    given_up: Callable[[], object] = _nothing
    """Called once instead of `then` if the question is not answered."""


@dataclass(frozen=True)
class Line(Question[str]):
    """A line of text: a value, a filter, the name of a file."""

    text: str = ""
    check: Callable[[str], str] = _no_problem
    """Returns the problem with a text; empty if there is none."""

    preview: Callable[[str], str] = _no_problem
    """The effect of a valid text, shown beside the field before it is accepted."""

    typed: Callable[[str], object] = _nothing
    """Called with each valid text while it is being typed."""

    suggestions: Sequence[str] = ()
    """Suggested texts: the first that begins with the typed text is shown dim; the right arrow key accepts it."""

    complete: Callable[[str], str] | None = None
    """Returns the completed text, which is also shown dim; empty if there is no completion."""


@dataclass(frozen=True)
class Confirmation(Question[None]):
    """A request for confirmation; the only answer is yes."""

    reasons: str = ""
    """Why confirmation is needed, as lines of text."""


@dataclass(frozen=True)
class Option:
    """One of the options to choose from."""

    title: str
    about: str = ""
    """Shown dim after the title: a folder, a key."""

    value: str = ""
    """The answer; empty if it is the title."""


def matching_options(options: Iterable[Option], typed: str) -> list[Option]:
    """The options that contain all typed words, in the title or after it."""
    words = typed.lower().split()
    return [each for each in options if all(word in f"{each.title} {each.about}".lower() for word in words)]


@dataclass(frozen=True)
class Choice(Question[str]):
    """One of several options, narrowed by typing."""

    attempt: Callable[[str], str] = _no_problem
    """Called with an answer before `then`; may act on it, or return why it cannot, so that the question stays open."""

    find: Callable[[str], Sequence[Option]] = _none
    """Returns the options for the typed text, best first."""

    hint: str = ""
    """Shown in the empty field."""

    empty: str = ""
    """Shown if there are no options."""


@dataclass(frozen=True)
class Form(Question[dict[str, str]]):
    """Named values, such as launch arguments; the answer contains those that differ from their defaults."""

    arguments: Sequence[LaunchArgument] = ()
    verb: str = "Launch"
    """What Enter does, in a word."""
    check: Callable[[dict[str, str]], str] = lambda _: ""
    """Returns why the answer is invalid; empty if it is valid."""


@dataclass(frozen=True)
class Elements(Question[Value]):
    """The elements of an array, edited one by one; the answer is the whole array."""

    values: Sequence[Element] = ()
    kind: Kind = Kind.STRING_ARRAY
    parse: Callable[[str], Element] = str
    """An element from a typed text; raises `ValueError` that says how to fix the text."""


@dataclass(frozen=True, kw_only=True)
class Fill(Question[None]):
    """A message, request or goal to fill in and send, any number of times."""

    payload: Payload
    name: str
    """The name of the topic, service or action."""
    type: str
    traffic: Topics
    """The port through which it is sent."""


class Requester(Generic[A]):
    """Shows a question, which ends exactly once: by an answer, by being cancelled, or because its subject is gone."""

    _question: Question[A] | None = None

    def close(self) -> None:
        """Remove the question from the screen."""
        raise NotImplementedError

    def report(self, why: str) -> None:
        """Notify the user why the question closes by itself."""
        raise NotImplementedError

    @property
    def is_open(self) -> bool:
        """Whether a question is open."""
        return self._question is not None

    def answer(self, answer: A) -> None:
        """Close, and pass the answer on."""
        if self.poll() and self._question is not None:
            question, self._question = self._question, None
            self.close()
            question.then(answer)

    def give_up(self) -> None:
        """Close without an answer."""
        question, self._question = self._question, None
        if question is not None:
            self.close()
            question.given_up()

    def poll(self) -> bool:
        """Whether the question still makes sense; if its subject is gone, close and notify the user."""
        why = self._question.gone() if self._question else ""
        if why:
            self.give_up()
            self.report(why)
        return not why
