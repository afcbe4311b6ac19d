"""The graph pane: nodes and topics drawn as text, selected with the arrow keys."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo
from bot_console.tui.console.query import parse
from bot_console.tui.panes.graph.export import exported
from bot_console.tui.panes.graph.view import (
    TOPIC,
    GraphView,
    Mode,
    Shown,
    ends_of,
    node_of,
    shown,
    summary,
    types_of,
)
from bot_console.tui.panes.pane import Pane
from bot_console.tui.save_file import save_file
from bot_console.tui.screens.facts import FactsScreen, Section
from bot_console.tui.widgets.diagram_view import LARGE, DiagramView
from bot_console.tui.widgets.prompt.common import filter_line
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.words import Words
from textual.app import ComposeResult

TOO_LARGE = 2.5
"""From this many times the size of the pane on, topics with one end only are left out until they are asked for."""


class GraphPane(Pane):
    """Who talks to whom."""

    TITLE = "Graph"
    HELP = (
        "Nodes are boxes, topics stand on the lines; an arrow leads from a publisher through the topic to each\n"
        "subscription. The way back of a loop runs below. What is linked to the selected item is coloured; a topic\n"
        "that nobody publishes or nobody listens to is orange."
    )
    BINDINGS = keymap.bindings("graph")

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._info: GraphInfo | None = None
        self._problem = ""
        self._view = GraphView()
        self._mode: Mode | None = None
        self._words = ""
        self._shown = Shown(graph=DiagramView.EMPTY)

    def compose(self) -> ComposeResult:
        """The picture, a line on what is selected, a prompt."""
        yield DiagramView()
        yield Words(id="graph-status")
        yield Prompt(id="graph-prompt")

    @property
    def _picture(self) -> DiagramView:
        return self.query_one(DiagramView)

    def focus_target(self) -> None:
        """The picture takes the keys."""
        self._picture.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Draw the graph anew when it is another object."""
        if snapshot.graph is not self._info or snapshot.problem != self._problem:
            self._info = snapshot.graph
            self._problem = snapshot.problem
            self._draw()

    def _draw(self) -> None:
        if self._info is None:
            return
        for mode in (self._mode,) if self._mode else (Mode.ALL, Mode.ACTIVE):
            self._view = replace(self._view, mode=mode)
            self._shown = shown(self._info, self._view)
            self._picture.show(self._shown.graph, self._shown.dead_ends)
            if self._picture.excess <= TOO_LARGE or len(self._shown.graph.items) > LARGE:
                break
        self._tell()

    def on_resize(self) -> None:
        """Choose anew what fits."""
        self.call_after_refresh(self._draw)

    def _tell(self) -> None:
        """Say what is selected, and what is left out."""
        info = self._info or GraphInfo()
        parts = [self._view.mode.value] if self._view.mode is not Mode.ALL else []
        parts += [f"/{self._words}"] if self._words else []
        parts += [f"{self._shown.hidden} hidden"] if self._shown.hidden else []
        self.caption(" · ".join(parts))
        if self._shown.graph.items:
            text = summary(info, self._picture.selected)
        elif self._problem:
            text = self._problem
        else:
            text = "Nothing matches the filter; escape takes it away." if info.nodes else "No nodes yet ..."
        self.query_one("#graph-status", Words).say(text)

    def on_diagram_view_selected(self, event: DiagramView.Selected) -> None:
        """Tell of the item."""
        event.stop()
        self._tell()

    def action_mode(self) -> None:
        """The next mode."""
        modes = list(Mode)
        self._mode = modes[(modes.index(self._view.mode) + 1) % len(modes)]
        self._draw()

    def action_hide(self, what: str) -> None:
        """Hide or show a kind of topic."""
        self._mode = self._mode or Mode.ALL
        self._view = replace(self._view, **{what: not getattr(self._view, what)})
        self._draw()

    def action_filter(self) -> None:
        """Ask for a filter."""
        self.ask(filter_line(self._words, self._apply))

    def action_clear_filter(self) -> None:
        """Show everything again."""
        self._apply("")

    def _apply(self, words: str) -> None:
        self._words = words
        self._view = replace(self._view, query=parse(words))
        self._draw()

    def action_turn_picture(self) -> None:
        """Another direction of the arrows."""
        self._picture.action_turn()

    def action_detail(self) -> None:
        """Show all about the selected node or topic."""
        item, info = self._picture.selected, self._info
        if not item or info is None:
            return
        if item.startswith(TOPIC):
            name = item.removeprefix(TOPIC)
            self.host.push_screen(FactsScreen(name, topic_facts(info, name)))
        else:
            self.host.push_screen(FactsScreen(item, node_facts(info, item)))

    def action_export(self) -> None:
        """Ask where to export to."""
        self.ask_file("export to (.txt .mmd .dot)", "graph.mmd", self._save)

    def _save(self, path: Path) -> str:
        save_file(path, exported(self._shown.graph, self._picture.drawing, path.suffix))
        return f"graph saved to {path}"


def node_facts(info: GraphInfo, name: str) -> list[Section]:
    """Everything known of a node."""
    node = node_of(info, name)
    if node is None:
        return [("The node has left.", (name,))]
    return [
        ("Publishers", _lines(node.publishers)),
        ("Subscriptions", _lines(node.subscriptions)),
        ("Action servers", _lines(node.action_servers)),
        ("Action clients", _lines(node.action_clients)),
        ("Services", _lines(node.services)),
        ("Service clients", _lines(node.clients)),
    ]


def topic_facts(info: GraphInfo, name: str) -> list[Section]:
    """Everything known of a topic."""
    publishers, subscribers = ends_of(info, name)
    qos = {
        (node.name, kind): each.qos
        for node in info.nodes
        for kind, ends in (("p", node.publishers), ("s", node.subscriptions))
        for each in ends
        if each.name == name
    }
    types = types_of(info, name)
    return [
        ("Type" if len(types) < 2 else "Types: more than one, so not all of them hear each other", types),
        ("Publishers", [f"{each}  {qos.get((each, 'p'), '')}" for each in publishers] or ["nobody"]),
        ("Subscriptions", [f"{each}  {qos.get((each, 's'), '')}" for each in subscribers] or ["nobody"]),
    ]


def _lines(ends: tuple[Endpoint, ...]) -> list[str]:
    width = max((len(each.name) for each in ends), default=0)
    return [f"{each.name.ljust(width)}  {', '.join(each.types)}  {each.qos}".rstrip() for each in ends]
