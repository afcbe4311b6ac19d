"""A graph drawn as text that can be scrolled, and in which one item is selected."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.widgets.diagram.drawing import Drawing, Place, Run, draw
from bot_console.tui.widgets.diagram.graph import Digraph
from rich.cells import cell_len
from rich.segment import Segment
from rich.style import Style
from textual.events import MouseEvent
from textual.geometry import Region, Size
from textual.message import Message
from textual.reactive import reactive
from textual.scroll_view import ScrollView
from textual.strip import Strip

MARGIN = 2
"""Cells kept free around the selected item when the picture is scrolled to it."""


class DiagramView(ScrollView, can_focus=True):
    """The picture of a graph. Arrow keys select what stands in that direction, what is linked first."""

    BINDINGS = keymap.bindings("diagram")
    DEFAULT_CSS = """
    DiagramView { height: 1fr; background: $surface; color: $text; scrollbar-size: 1 1; }
    DiagramView:focus { background: $surface; }
    .diagram--box { color: $text; text-style: bold; }
    .diagram--chip { color: $text; background: $panel; }
    .diagram--line { color: $text-muted; }
    .diagram--linked { color: $primary; }
    .diagram--linked-chip { color: $primary; background: $panel; }
    .diagram--selected { color: $block-cursor-foreground; background: $block-cursor-background; text-style: bold; }
    .diagram--warn { color: $warning; background: $panel; }
    """
    COMPONENT_CLASSES: ClassVar[set[str]] = {
        f"diagram--{each}" for each in ("box", "chip", "line", "linked", "linked-chip", "selected", "warn")
    }

    EMPTY: ClassVar[Digraph] = Digraph()

    selected: reactive[str] = reactive("")
    """The id of the selected item; empty when there is none."""

    class Selected(Message):
        """Another item is selected."""

        def __init__(self, view: DiagramView, item: str) -> None:
            super().__init__()
            self.view = view
            self.item = item

    def __init__(self) -> None:
        super().__init__()
        self.drawing = Drawing()
        self._graph = Digraph()
        self._warned: frozenset[str] = frozenset()

    @property
    def places(self) -> dict[str, Place]:
        """Where the items stand."""
        return dict(self.drawing.places or {})

    def show(self, graph: Digraph, warned: frozenset[str] = frozenset()) -> None:
        """Draw a graph; items in `warned` stand out. Selection and scroll position stay where they can."""
        self._warned = warned
        if graph != self._graph:
            self._graph = graph
            self.drawing = draw(graph)
            self.virtual_size = Size(self.drawing.width + 1, len(self.drawing.rows))
        if self.selected not in self.places:
            self.selected = self._first()
        self.refresh()

    def _first(self) -> str:
        return min(self.places, key=lambda each: (self.places[each].x, self.places[each].y), default="")

    # Drawing ------------------------------------------------------------------------------------------------------

    def render_line(self, y: int) -> Strip:
        """One line of the picture."""
        row = y + self.scroll_offset.y
        width = self.size.width
        base = self.rich_style
        runs = self.drawing.rows[row] if row < len(self.drawing.rows) else ()
        segments: list[Segment] = []
        at = 0
        for run in runs:
            if run.x > at:
                segments.append(Segment(" " * (run.x - at), base))
            segments.append(Segment(run.text, base + self._style(run)))
            at = run.x + cell_len(run.text)
        left = self.scroll_offset.x
        return Strip(segments).crop_extend(left, left + width, base)

    def _style(self, run: Run) -> Style:
        return self.get_component_rich_style(f"diagram--{self._class(run)}", partial=True)

    def _class(self, run: Run) -> str:
        selected = self.selected
        if not run.item:
            return "linked" if any(selected in edge for edge in run.edges) else "line"
        if run.item == selected:
            return "selected"
        boxed = self.places[run.item].boxed
        if (selected, run.item) in self._links or (run.item, selected) in self._links:
            return "linked" if boxed else "linked-chip"
        if run.item in self._warned:
            return "warn"
        return "box" if boxed else "chip"

    @property
    def _links(self) -> set[tuple[str, str]]:
        return set(self.drawing.edges)

    # Selecting ----------------------------------------------------------------------------------------------------

    def watch_selected(self, before: str, after: str) -> None:
        """Draw anew, keep the item in view, and tell."""
        self.refresh()
        self.show_selected()
        self.post_message(self.Selected(self, after))

    def show_selected(self) -> None:
        """Scroll so that the selected item is seen."""
        place = self.places.get(self.selected)
        if place is not None:
            region = Region(place.x - MARGIN, place.y - 1, place.width + 2 * MARGIN, place.height + 2)
            self.scroll_to_region(region, animate=False, force=True)

    def action_select(self, across: int, down: int) -> None:
        """Select the nearest item in a direction; one that is linked counts as nearer."""
        here = self.places.get(self.selected)
        if here is None:
            self.selected = self._first()
            return
        beyond = [each for each, place in self.places.items() if _beyond(here, place, across, down)]
        self.selected = min(beyond, key=lambda each: self._distance(here, each, across), default=self.selected)

    def _distance(self, here: Place, item: str, across: int) -> tuple[int, str]:
        place = self.places[item]
        dx = abs(place.x - here.x) if not across else max(place.x - here.x - here.width, here.x - place.x - place.width)
        dy = abs(place.y + place.height // 2 - here.y - here.height // 2)
        ends = (self.selected, item) if across > 0 else (item, self.selected)
        nearer = 60 if across and ends in self._links else 0
        return (dx + 4 * dy - nearer if across else 2 * dx + dy), item

    def action_scroll_picture(self, across: int, down: int) -> None:
        """Scroll by half of what is seen."""
        self.scroll_relative(
            x=across * max(1, self.size.width // 2), y=down * max(1, self.size.height // 2), animate=False, force=True
        )

    def on_click(self, event: MouseEvent) -> None:
        """Select what was clicked."""
        x, y = event.x + self.scroll_offset.x, event.y + self.scroll_offset.y
        for each, place in self.places.items():
            if place.x <= x < place.x + place.width and place.y <= y < place.y + place.height:
                self.selected = each

    def on_resize(self) -> None:
        """Keep the selected item in view."""
        self.show_selected()


def _beyond(here: Place, there: Place, across: int, down: int) -> bool:
    if across:
        return (there.x >= here.x + here.width) if across > 0 else (there.x + there.width <= here.x)
    return there.y >= here.y + here.height if down > 0 else there.y + there.height <= here.y
