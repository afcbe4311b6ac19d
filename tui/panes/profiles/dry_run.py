"""Checks a profile with the nodes before it is applied, without setting anything."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import partial

from bot_console.tui.console.answer import Answer, answer_of
from bot_console.tui.console.model import ConsoleSnapshot, ParameterTree, ProfileDifference, Value
from bot_console.tui.console.parameters.dry_run import SERVICE, TYPE, can_be_asked, question
from bot_console.tui.console.protocol import Console
from bot_console.tui.text.counted import counted

Asked = tuple[ParameterTree, Mapping[str, Value]]
"""A question to a node: its parameters at that time, and the new values."""


@dataclass
class DryRun:
    """Asks each node whose values a profile would change, once per set of values.

    `later` runs a call in the panes' thread; `on_answer` is called there when an answer has arrived.
    """

    console: Console
    later: Callable[..., object]
    on_answer: Callable[[], object]
    unasked: frozenset[str] = frozenset()
    """The nodes that cannot check values in advance."""
    concerned: int = 0
    """The number of nodes whose values would change."""
    answers: dict[str, Answer | None] = field(default_factory=dict[str, "Answer | None"])
    """The answer of each node asked; None until it has answered."""
    _asked: dict[str, Asked] = field(default_factory=dict[str, "Asked"])

    def ask(self, differences: Sequence[ProfileDifference], snapshot: ConsoleSnapshot) -> None:
        """Have these changes checked; a node is asked again only if its parameters or the values have changed.

        A read-only console asks nothing: its own refusal is not the node's.
        """
        wanted: dict[str, dict[str, Value]] = {}
        for each in differences:
            if not each.unknown and not snapshot.capabilities.change:
                wanted.setdefault(each.node, {})[each.name] = each.then
        refused = {each.node for each in differences if each.refusal and not each.unknown}
        open_to_it = can_be_asked(snapshot.graph)
        self.concerned, self.unasked = len(wanted), frozenset(wanted) - open_to_it
        # A node is not asked about a value that its descriptor refuses: the refusal is certain, and the node's own
        # checks may not expect such values. A node in the graph may have no known parameters yet, or no longer.
        asked = open_to_it & snapshot.parameters.keys() - refused
        now = {node: values for node, values in wanted.items() if node in asked}
        for node in [each for each in self._asked if each not in now]:
            del self._asked[node], self.answers[node]
        for node, values in now.items():
            tree, before = snapshot.parameters[node], self._asked.get(node)
            if before is None or before[0] is not tree or before[1] != values:
                self._asked[node], self.answers[node] = (tree, values), None
                self._put(node, tree, values)

    def _put(self, node: str, tree: ParameterTree, values: Mapping[str, Value]) -> None:
        kinds = {each.name: each.kind for each in tree.parameters}
        asked = question({name: (kinds[name], value) for name, value in values.items() if name in kinds})
        done = self.console.topics.call_service(f"{node}/{SERVICE}", TYPE, asked)
        done.add_done_callback(partial(self._answered, node, self._asked[node]))

    def _answered(self, node: str, asked: Asked, done: Future[Answer]) -> None:
        self.later(self._take, node, asked, answer_of(done))

    def _take(self, node: str, asked: Asked, answer: Answer) -> None:
        if self._asked.get(node) is asked:  # else a newer question replaced this one
            self.answers[node] = answer
            self.on_answer()

    def refusals(self) -> Mapping[str, str]:
        """The nodes that would refuse or did not answer, each with its reason."""
        return {
            node: answer.text or "no reason was given"
            for node, answer in self.answers.items()
            if answer is not None and not answer.ok
        }

    def unasked_text(self) -> str:
        """How many nodes can't check in advance, and why; empty if all can."""
        if not self.unasked:
            return ""
        of, count = self.concerned, len(self.unasked)
        return f"{count} of {counted(of, 'node')} can't check in advance: no service ~/{SERVICE}"

    def words(self, node: str) -> tuple[str, str]:
        """The note beside a node's name, and its style; empty if nothing would change."""
        if node in self.unasked:
            return "can't check in advance", "dim"
        if node not in self.answers:
            return "", "dim"
        answer = self.answers[node]
        if answer is None:
            return "checking ...", "dim"
        return ("checked: will accept", "good") if answer.ok else ("✗ checked:", "error")
