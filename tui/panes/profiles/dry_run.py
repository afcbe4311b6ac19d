"""Asks nodes what they think of a profile before it is applied: all that can be asked, without setting anything."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import partial

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import ConsoleSnapshot, ParameterTree, ProfileDifference, Value
from bot_console.tui.console.parameters.dry_run import SERVICE, TYPE, can_be_asked, question
from bot_console.tui.console.protocol import Console
from bot_console.tui.panes.pane import answer_of

Asked = tuple[ParameterTree, Mapping[str, Value]]
"""What a node was asked: how it was then, and the values."""


@dataclass
class Asking:
    """Asks the nodes whose values a profile would change, once for each question.

    `later` runs something in the thread of the panes, `heard` is called there when an answer has come.
    """

    console: Console
    later: Callable[..., object]
    heard: Callable[[], object]
    unasked: frozenset[str] = frozenset()
    """The nodes that can't check in advance."""
    answers: dict[str, Answer | None] = field(default_factory=dict[str, "Answer | None"])
    """What each node said that was asked; None until it has said something."""
    _asked: dict[str, Asked] = field(default_factory=dict[str, "Asked"])

    def ask(self, differences: Sequence[ProfileDifference], snapshot: ConsoleSnapshot) -> None:
        """Ask for these changes; a node that is to change and is as it was when it was asked is not asked again.

        A console that changes nothing asks nothing: its own refusal is not the node's.
        """
        wanted: dict[str, dict[str, Value]] = {}
        for each in differences:
            if not each.unknown and not snapshot.capabilities.change:
                wanted.setdefault(each.node, {})[each.name] = each.then
        refused = {each.node for each in differences if each.refusal and not each.unknown}
        open_to_it = can_be_asked(snapshot.graph)
        self.unasked = frozenset(wanted) - open_to_it
        # What the descriptor refuses needs no further word, and the node's rules were not made for it.
        now = {node: wanted[node] for node in wanted if node in open_to_it and node not in refused}
        for node in [each for each in self._asked if each not in now]:
            del self._asked[node], self.answers[node]
        for node, values in now.items():
            tree, before = snapshot.parameters[node], self._asked.get(node)
            if before is None or before[0] is not tree or before[1] != values:
                self._asked[node], self.answers[node] = (tree, values), None
                self._put(node, tree, values)

    def _put(self, node: str, tree: ParameterTree, values: Mapping[str, Value]) -> None:
        kinds = {each.name: each.kind for each in tree.parameters}
        asked = question({name: (kinds[name], value) for name, value in values.items()})
        done = self.console.call(f"{node}/{SERVICE}", TYPE, asked)
        done.add_done_callback(partial(self._answered, node, self._asked[node]))

    def _answered(self, node: str, asked: Asked, done: Future[Answer]) -> None:
        self.later(self._take, node, asked, answer_of(done))

    def _take(self, node: str, asked: Asked, answer: Answer) -> None:
        if self._asked.get(node) is asked:  # else it was asked something else meanwhile
            self.answers[node] = answer
            self.heard()

    def refusals(self) -> Mapping[str, str]:
        """The nodes that would refuse, or did not answer, each with its words."""
        return {
            node: answer.text or "no reason was given"
            for node, answer in self.answers.items()
            if answer is not None and not answer.ok
        }

    def words(self, node: str) -> tuple[str, str]:
        """What is to be said beside a node's name, and in which style; empty where nothing is to be changed."""
        if node in self.unasked:
            return "can't check in advance", "dim"
        if node not in self.answers:
            return "", "dim"
        answer = self.answers[node]
        if answer is None:
            return "checking ...", "dim"
        return ("checked: will accept", "good") if answer.ok else ("✗ checked:", "error")
