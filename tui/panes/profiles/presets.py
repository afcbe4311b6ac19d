"""Presets that nodes offer as services: finding these nodes, and listing, applying, saving and deleting presets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import partial

from bot_console.tui.console.answer import Answer, answer_of
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.protocol import Console
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.prompt.question import Choice, Confirmation, Line, Option, Question, matching_options

LIST, CHANGE = "std_srvs/srv/Trigger", "diagnostic_msgs/srv/AddDiagnostics"
"""The types of `list`, and of `apply`, `save` and `delete`."""
NOBODY = "No node here keeps presets. One that does: ros2 run bot_console_robot preset_node"
UNSEEN = (
    "{keeper} sets the values itself, all or none. Which values these are, and whether any makes the robot less "
    "safe, cannot be shown in advance; History lists them afterwards, and each can be undone there."
)


def keepers(graph: GraphInfo) -> tuple[str, ...]:
    """The common prefixes, such as `/presets`, of the preset services of all nodes that offer all four of them."""
    offered = {each.name: each.types for each in graph.services}
    lists = [name.removesuffix("/list") for name, types in offered.items() if name.endswith("/list") and LIST in types]
    verbs = ("apply", "save", "delete")
    return tuple(sorted(each for each in lists if all(CHANGE in offered.get(f"{each}/{verb}", ()) for verb in verbs)))


@dataclass
class PresetMenu:
    """A menu of the presets of all nodes that offer some, with the actions for each.

    `later` runs a call in the panes' thread, `ask` asks the user, `report` shows the outcome.
    """

    console: Console
    later: Callable[..., object]
    ask: Callable[[Question[str] | Question[None]], object]
    report: Callable[[Answer], object]
    _lists: dict[str, Answer] = field(default_factory=dict[str, Answer])

    def open(self, graph: GraphInfo) -> None:
        """Request the lists of all nodes with presets; the menu opens when the last one has answered."""
        asked = keepers(graph)
        if not asked:
            self.report(Answer(False, NOBODY))
        for each in asked:
            answer = self.console.topics.call_service(f"{each}/list", LIST, {})
            answer.add_done_callback(partial(self._heard, asked, each))

    def _heard(self, asked: Sequence[str], keeper: str, done: Future[Answer]) -> None:
        self.later(self._listed, asked, keeper, answer_of(done))

    def _listed(self, asked: Sequence[str], keeper: str, answer: Answer) -> None:
        self._lists[keeper] = answer
        if len(self._lists) < len(asked):
            return
        for each, listed in self._lists.items():
            if not listed.ok:
                self.report(Answer(False, f"{each}: {listed.text}"))
        offers = self._offers()
        if offers:
            options = [option for option, _ in offers.values()]
            self.ask(
                Choice(
                    "Presets", lambda chosen: offers[chosen][1](), find=partial(matching_options, options), hint="words"
                )
            )

    def _offers(self) -> dict[str, tuple[Option, Callable[[], object]]]:
        """The options with their actions, by value."""
        kept = [
            (keeper, *line.partition(": ")[::2])
            for keeper, answer in self._lists.items()
            if answer.ok
            for line in answer.text.splitlines()
        ]
        offers: dict[str, tuple[Option, Callable[[], object]]] = {}

        def offer(title: str, about: str, then: Callable[[], object]) -> None:
            key = str(len(offers))
            offers[key] = Option(sanitize(title), sanitize(about), key), then

        for keeper, name, title in kept:
            offer(f"apply {name}", f"{title}  {keeper}".strip(), partial(self._ask_apply, keeper, name))
        for keeper, answer in self._lists.items():
            if answer.ok:
                offer("save the running values as a preset", keeper, partial(self._ask_save, keeper))
        for keeper, name, _ in kept:
            offer(f"delete {name}", keeper, partial(self._ask_delete, keeper, name))
        return offers

    def _ask_apply(self, keeper: str, name: str) -> None:
        then = partial(self._change, keeper, "apply", name)
        self.ask(Confirmation(f"Apply {name}?", lambda _: then(), reasons=UNSEEN.format(keeper=keeper)))

    def _ask_delete(self, keeper: str, name: str) -> None:
        then = partial(self._change, keeper, "delete", name)
        self.ask(Confirmation(f"Delete the preset {name} of {keeper}?", lambda _: then()))

    def _ask_save(self, keeper: str) -> None:
        label = f"save the running values as a preset of {keeper}"
        self.ask(Line(label, partial(self._change, keeper, "save"), check=_name_problem))

    def _change(self, keeper: str, verb: str, name: str) -> None:
        answer = self.console.topics.call_service(f"{keeper}/{verb}", CHANGE, {"load_namespace": name.strip()})
        answer.add_done_callback(lambda done: self.later(self.report, answer_of(done)))


def _name_problem(text: str) -> str:
    return "" if text.strip() else "a preset needs a name"
