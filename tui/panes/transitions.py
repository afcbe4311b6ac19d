"""Asks which transition a lifecycle node should make."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.graph.lifecycle_states import TRANSITIONS
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.panes.pane import Pane
from bot_console.tui.widgets.prompt.question import Choice, Option

FINAL = ("shutdown",)
"""Transitions that cannot be undone."""


def ask_transition(pane: Pane, graph: GraphInfo, nodes: Sequence[str]) -> None:
    """Ask for a transition of one of these nodes and request it; notifies why if none is possible."""
    managed = [each for each in nodes if each in graph.lifecycle]
    if not managed:
        pane.notify("This is not a lifecycle node.", severity="warning")
        return
    if not pane.may_change():
        return
    options = [
        Option(f"{verb} {node}", about(graph.lifecycle[node], verb), f"{verb} {node}")
        for node in managed
        for verb in TRANSITIONS.get(graph.lifecycle[node], ())
    ]
    if not options:
        pane.notify(f"{managed[0]} is {graph.lifecycle[managed[0]]}: no transition is possible.", severity="warning")
        return

    def chosen(answer: str) -> None:
        verb, _, node = answer.partition(" ")
        pane.report_later(pane.console.graph.change_state(node, verb))

    def find(typed: str) -> Sequence[Option]:
        return [each for each in options if typed.strip().lower() in each.title.lower()]

    pane.ask(Choice("Transition", chosen, find=find, hint="type part of a name", empty="No such transition."))


def state_text(state: str) -> str:
    """A state, with the key that changes it, unless no transition is possible."""
    return f"{state}, T changes it" if state in TRANSITIONS else state


def about(state: str, verb: str) -> str:
    """The description of a transition."""
    return f"is {state}" + (", cannot be undone" if verb in FINAL else "")
