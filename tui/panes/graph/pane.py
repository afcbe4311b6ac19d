"""The graph pane: nodes and topics drawn as text, selected with the arrow keys."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.filter_syntax import Query, parse
from bot_console.tui.console.graph.hidden_names import TOOL_NAMES
from bot_console.tui.console.model import ConsoleSnapshot, GraphInfo
from bot_console.tui.console.sensors.port import Sensors
from bot_console.tui.files.save_file import save_file
from bot_console.tui.panes.graph.about import node_of, nodes_on_topic
from bot_console.tui.panes.graph.details import (
    DETAIL,
    ITEM,
    PANE,
    TYPE,
    details,
    finding_options,
    line_options,
)
from bot_console.tui.panes.graph.export import export_graph
from bot_console.tui.panes.graph.filtering import complete_word, matches
from bot_console.tui.panes.graph.focus_history import FocusHistory
from bot_console.tui.panes.graph.frames import FramesView
from bot_console.tui.panes.graph.namespaces import (
    ACTION,
    SERVICE,
    SPACE,
    TOPIC,
    default_folds,
    is_link,
    namespace_of,
    unfold,
)
from bot_console.tui.panes.graph.notes import caption, dead_ends, empty_placeholder, item_notes, item_summary, legend
from bot_console.tui.panes.graph.rates import Rates
from bot_console.tui.panes.graph.view import GraphView, Mode, VisibleGraph, visible_graph
from bot_console.tui.panes.graph.view_state import STATE_NAME, ViewState, view_state_of
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.transitions import ask_transition
from bot_console.tui.text.namespaces import foldable_namespaces
from bot_console.tui.widgets.diagram.flow_chart.drawing import MIN_WIDE_COLUMNS
from bot_console.tui.widgets.diagram_view import MIN_THREADED_ITEMS, DiagramView
from bot_console.tui.widgets.prompt.filtered import Filterable
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Choice, Line, Option, matching_options
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from rich.text import Text
from textual.app import ComposeResult


class GraphPane(Pane, Filterable):  # pyright: ignore[reportIncompatibleVariableOverride] # Textual's HELP
    """The nodes, and the topics, services and actions between them."""

    TITLE = "Graph"
    HELP = (
        "Nodes are boxes. The words on a line are the topics that lead from one box to another, along the arrow;\n"
        "`name ×3` are three topics of one namespace, ↺ is what a node sends to itself, `idle` is a topic without\n"
        "messages now. Topics without a publisher or a subscriber are listed below, and D shows the hidden ones.\n"
        "Boxes with the same topics and the same partners share a frame and its lines.\n"
        "m switches to rqt's drawings, in which topics are items of their own, and to a list.\n"
        "What is linked to the selected item is coloured; where QoS does not match so that nothing arrives, the line\n"
        "is red and the topic marked ✗. Namespaces fold into boxes, by themselves where there are many nodes.\n"
        "Enter lists everything about the item, and leads to what it lists; w lists the findings in words.\n"
        "t shows the tf2 frames as a tree instead: when, how often and by whom each was published, and what is wrong:\n"
        "loops, two parents, silence."
    )
    BINDINGS = keymap.bindings("graph")

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s); tests replace it with one that they step."""
    SCOPES: ClassVar[tuple[str, ...]] = ("find", "narrowed", "diagram")

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._info: GraphInfo | None = None
        self._problem = ""
        self._view = GraphView()
        self._shown = VisibleGraph(graph=DiagramView.EMPTY)
        self._snapshot = ConsoleSnapshot()
        self._focus_history = FocusHistory()
        self._folds: frozenset[str] | None = None
        """The namespaces that the user has folded; None: the default, which depends on the number of nodes."""
        self._rates = Rates()
        self._asking_by: Sensors | None = None
        """The sensors port of the console that probes the nodes for liveness; None while nothing does."""

    def on_mount(self) -> None:
        """Restore the view of the last run."""
        left = view_state_of(self.state_store.get(STATE_NAME))
        self._view, self._folds = replace(left.view, hides=getattr(self.host, "graph_hides", TOOL_NAMES)), left.folds
        self._rates.wanted = left.rates

    def on_unmount(self) -> None:
        """Save the view."""
        self.state_store.put(STATE_NAME, ViewState(self._view, self._folds, self._rates.wanted).data)

    def compose(self) -> ComposeResult:
        """The picture, details of the selected item, and a prompt."""
        yield DiagramView()
        yield FramesView()
        yield StaticText(id="graph-dead-ends")
        yield StaticText(id="graph-status")
        yield Prompt(id="graph-prompt")

    @property
    def _picture(self) -> DiagramView:
        return self.query_one(DiagramView)

    @property
    def _frames(self) -> FramesView:
        return self.query_one(FramesView)

    def focus_target(self) -> None:
        """Focus the picture, or the frames that replace it."""
        if self._frames.open:
            self._frames.take_focus()
        else:
            self._picture.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Redraw the graph if it is a different object."""
        self._snapshot = snapshot
        if snapshot.graph is not self._info or snapshot.problem != self._problem:
            self._info = snapshot.graph
            self._problem = snapshot.problem
            self._draw()

    @property
    def _visible(self) -> list[str]:
        return [each.name for each in (self._info or GraphInfo()).nodes if not each.hidden]

    def _draw(self) -> None:
        info = self._info
        if info is None:
            return
        folded = self._folds if self._folds is not None else default_folds(self._visible)
        self._view = replace(self._view, folded=folded, focus=self._focus_history.now)
        # If topics are items of their own, names are shortened when the drawing does not fit with full ones.
        for short in (False, True) if self._view.mode in (Mode.ACTIVE, Mode.ALL) else (False,):
            self._view = replace(self._view, short=short)
            self._shown = visible_graph(info, self._view, self._rates.shown(self._measures))
            self._report_dead_ends()
            faults = self._shown.bundles.faults or self._shown.faults
            self._picture.show(self._shown.content, self._shown.dead_ends, faults, self._shown.silent)
            if self._picture.excess <= 1.0 or len(self._shown.graph.items) > MIN_THREADED_ITEMS:
                break
        self._report()

    def tick(self) -> None:
        """Show rates if requested and the pane is visible; otherwise measure nothing."""
        self._ask_nodes()
        if self.has_parts:
            self._frames.poll(self.console.sensors, self.clock(), seen=self.display)
            if self._frames.open:
                self._report()
        if not self.display or not self._measures:
            self._rates.stop_measuring(self.console.topics)
        elif self._rates.poll(self.console.topics, self._shown.topics_drawn, self.clock()):
            self._draw()

    @property
    def _measures(self) -> bool:
        """Whether rates are shown: as the user has chosen, by default in a flow chart that has room for them."""
        picture, wanted = self._picture, self._rates.wanted
        room = self._view.mode is Mode.FLOW and picture.outer_size.width >= MIN_WIDE_COLUMNS and not picture.is_large
        return room if wanted is None else wanted

    def _ask_nodes(self) -> None:
        """Have nodes probed for liveness while the pane is visible."""
        wanted = self.console.sensors if self.display else None
        if wanted is not self._asking_by:  # a different one, too, after a reconnection
            self._asking_by = wanted
            self.console.graph.watch_nodes(wanted is not None, "graph")

    def detach(self) -> None:
        """Stop measuring and probing."""
        self.console.topics.measure([], "graph")
        self.console.graph.watch_nodes(False, "graph")
        self.console.sensors.watch_frames(False)

    def on_diagram_view_resized(self) -> None:
        """Draw again: what fits has changed."""
        self._draw()

    def _report(self) -> None:
        """Update the caption, and describe the selected item or frame."""
        if self._frames.open:
            self.caption(self._frames.caption)
            self.query_one("#graph-status", StaticText).show_text(self._frames.summary)
            return
        info = self._info or GraphInfo()
        self.caption(caption(info, self._shown, self._view, self.words))
        text = item_summary(info, self._shown, self._view, self._picture.selected)
        self._picture.show_placeholder(empty_placeholder(info))
        self.query_one("#graph-status", StaticText).show_text(text or self._problem)
        self._report_more()

    def _report_dead_ends(self) -> None:
        """List the topics, services and actions that lack one end, as far as they fit, below the drawing."""
        words = self.query_one("#graph-dead-ends", StaticText)
        lines = dead_ends(self._shown, max(1, self.content_size.width - 2))
        words.display = bool(lines) and not self._frames.open
        words.styles.height = max(1, len(lines))
        words.show_text(Text("\n".join(lines)))

    def _report_more(self) -> None:
        """Explain the marks, and describe the selected item, in the rows that the drawing leaves free."""
        picture, rates = self._picture, self._rates.shown(self._measures)
        width, lines = picture.outer_size.width - 2, list[str]()
        if self._view.mode is Mode.FLOW and width >= MIN_WIDE_COLUMNS - 2:
            free = picture.free_rows - 2
            lines = item_notes(self._snapshot, self._shown, self._view, picture.selected, rates, width, free)
        picture.set_footer(lines, legend(self._shown, width) if self._view.mode is Mode.FLOW else "")

    def on_diagram_view_selected(self, event: DiagramView.Selected) -> None:
        """Describe the selected item."""
        event.stop()
        self._report()

    def action_mode(self) -> None:
        """Switch to the next mode."""
        modes = list(Mode)
        self._view = replace(self._view, mode=modes[(modes.index(self._view.mode) + 1) % len(modes)])
        self._draw()

    def action_hide(self, what: str) -> None:
        """Hide or show a kind of topic."""
        self._view = replace(self._view, **{what: not getattr(self._view, what)})
        self._draw()

    def ask_words(self, line: Line) -> None:
        """Ask for search words at the bottom of the pane."""
        self.query_one(Prompt).ask(replace(line, complete=self._completed))

    def _completed(self, text: str) -> str:
        return complete_word(text, self._info or GraphInfo())

    def apply_filter(self, words: str) -> None:
        """Draw the items that pass the filter, and the items linked to them."""
        self._frames.filter_by(words)
        self._view = replace(self._view, query=parse(words, lists=True))
        self._draw()

    def find(self, words: str, step: int) -> bool:
        """Select the next node or topic whose own name matches."""
        query = parse(words, lists=True)
        if self._frames.open:
            return self._frames.find(query, step)
        return self._picture.find(lambda item: self._matches(item, query), step)

    def is_on_match(self, words: str) -> bool:
        """Whether the selected item matches."""
        if self._frames.open:
            return self._frames.is_on_match(parse(words))
        return bool(self._picture.selected) and self._matches(self._picture.selected, parse(words, lists=True))

    def _matches(self, item: str, query: Query) -> bool:
        return any(matches(each, query) for each in self._shown.bundles.links.get(item, (item,)))

    def action_turn_picture(self) -> None:
        """Change the direction of the arrows."""
        self._picture.action_turn()

    def action_detail(self) -> None:
        """List all details of the selected item, each leading to its subject; unfold a folded namespace."""
        if self._frames.open:
            self._frames.show_facts(self.host, self.clock())
            return
        item, info = self._picture.selected, self._info
        if not item or info is None:
            return
        if item.startswith(SPACE):
            self.action_fold(False)
            return
        links = self._shown.bundles.links.get(item)
        if links is not None:
            self._offer(
                item_summary(info, self._shown, self._view, item), line_options(info, links), "Nothing matches."
            )
            return
        self._list_details(item)

    def _list_details(self, item: str) -> None:
        name = item.partition(":")[2] if is_link(item) else item
        self._offer(name, details(self._snapshot, item), "Nothing matches.")

    def action_findings(self) -> None:
        """List the findings."""
        if self._frames.open:
            self._offer("Findings about the frames", self._frames.anomalies(self.clock()), "There are no findings.")
            return
        self._offer("Findings", finding_options(self._info or GraphInfo()), "There are no findings.")

    def _offer(self, title: str, options: Sequence[Option], empty: str) -> None:
        self.ask(
            Choice(
                title,
                self._go,
                find=partial(matching_options, options),
                hint="type to filter, Enter jumps there",
                empty=empty,
            )
        )

    def _go(self, where: str) -> None:
        """Go where an option leads."""
        if self._frames.open:
            self._frames.go_to(where)
        elif where.startswith(ITEM):
            self._go_to_item(where.removeprefix(ITEM))
        elif where.startswith(DETAIL):
            self._list_details(where.removeprefix(DETAIL))
        elif where.startswith(PANE):
            pane, _, name = where.removeprefix(PANE).partition(" ")
            self.post_message(self.PaneWanted(pane, name))
        elif where.startswith(TYPE):
            self.post_message(self.LineWanted(f"ros2 interface show {where.removeprefix(TYPE)}"))

    def _go_to_item(self, item: str) -> None:
        """Select an item, or the line that carries it; an item that is not drawn becomes the focus."""
        lines = self._shown.bundles.links
        item = next((line for line, links in lines.items() if item in links), item)
        if item not in self._picture.places:
            services = self._view.services or item.startswith((SERVICE, ACTION))
            self._view = replace(self._view, mode=Mode.ALL, debug=True, services=services)
            self._folds = frozenset()
            self._focus_history.go(item)
            self._draw()
        self._picture.choose(item)

    def go_to(self, name: str) -> None:
        """Select a node or a topic."""
        info = self._info or GraphInfo()
        self._go_to_item(name if node_of(info, name) or not any(nodes_on_topic(info, name)) else TOPIC + name)

    def action_focus(self) -> None:
        """Draw only what is linked to the selected item; each further call adds a hop."""
        item = self._picture.selected
        if item:
            self._focus_history.go(self._shown.bundles.links.get(item, (item,))[0])
            self._draw()

    def action_focus_history(self, where: str) -> None:
        """Go to the previous or next focus."""
        if self._focus_history.back() if where == "back" else self._focus_history.forward():
            self._draw()
            if self._focus_history.now.item:
                self._picture.choose(self._focus_history.now.item)
        else:
            self.notify("There is no earlier focus." if where == "back" else "There is no later focus.")

    def action_fold(self, closed: bool) -> None:
        """Fold the namespace of the selected node, or unfold the selected box."""
        item, folded = self._picture.selected, self._view.folded
        space = item.removeprefix(SPACE)
        if item.startswith(SPACE):
            space = namespace_of(space) if closed else space
        else:
            space = "" if is_link(item) or not closed else namespace_of(item)
        if not space:
            self.notify(
                "The selected item is in no namespace." if closed else "Only a folded namespace can be unfolded."
            )
            return
        self._folds = folded | {space} if closed else unfold(folded, space, self._visible)
        self._draw()
        self._picture.choose(SPACE + min(self._folds - folded, default=space))

    def action_fold_all(self) -> None:
        """Fold every namespace, or unfold all."""
        self._folds = frozenset() if self._view.folded else foldable_namespaces(self._visible)
        if not self._folds and not self._view.folded:
            self.notify("No namespace has two nodes or more.")
        self._draw()

    def action_rates(self) -> None:
        """Turn the rates beside the topics on or off."""
        self._rates.wanted = not self._measures
        self.tick()
        self._draw()

    def action_transition(self) -> None:
        """Ask which transition the selected lifecycle node should make."""
        ask_transition(self, self._info or GraphInfo(), (self._picture.selected,))

    def action_frames(self) -> None:
        """Show the frames of tf2 instead of nodes and topics, or go back."""
        frames = self._frames
        frames.toggle()
        self._picture.display = not frames.open
        self._report_dead_ends()
        self.focus_target()
        self.tick()
        self._report()

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Describe the frame at the cursor."""
        event.stop()
        self._report()

    def action_export(self) -> None:
        """Ask for the file to export to."""
        self.ask_file("export to (.mmd .dot .svg .txt)", "graph.mmd", self._save)

    def _save(self, path: Path) -> Answer:
        whole = visible_graph(
            self._info or GraphInfo(), replace(self._view, short=False, whole=True), self._rates.texts
        )
        save_file(path, export_graph(whole.graph, self._picture.drawing, path.suffix))
        return Answer(True, f"graph saved to {path}")
