"""A scrollable drawing of a graph with one selected item."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import ClassVar, TypeAlias

from bot_console.tui import keymap
from bot_console.tui.terminal.styling import StyledByPart
from bot_console.tui.widgets.diagram.arrow_direction import DOWN, RIGHT, ArrowDirection
from bot_console.tui.widgets.diagram.drawing import Drawing, Place, Run, draw
from bot_console.tui.widgets.diagram.flow_chart.drawing import draw_chart
from bot_console.tui.widgets.diagram.flow_chart.model import Chart
from bot_console.tui.widgets.diagram.graph import Digraph
from bot_console.tui.widgets.diagram.listing import Listing, draw_listing
from bot_console.tui.widgets.diagram.overview_map import Window, map_lines, map_size, visible_part
from bot_console.tui.widgets.placeholder import WithPlaceholder, placeholder_lines
from rich.cells import cell_len
from rich.segment import Segment
from rich.style import Style
from textual.events import MouseEvent
from textual.geometry import Region, Size
from textual.message import Message
from textual.reactive import reactive
from textual.scroll_view import ScrollView
from textual.strip import Strip

MIN_THREADED_ITEMS = 60
"""A graph with more items than this is laid out in a thread."""

Content: TypeAlias = Digraph | Chart | Listing
Manner: TypeAlias = ArrowDirection | Size
"""How to lay out the content: a graph in a direction, anything else for a window size."""

MARGIN_CELLS = 2
"""Cells kept free around the selected item when the picture is scrolled to it."""


class DiagramView(ScrollView, StyledByPart, WithPlaceholder, can_focus=True):  # pyright: ignore[reportIncompatibleMethodOverride] -- Textual's own
    """Shows a graph. Arrow keys select an item in that direction, linked items first."""

    BINDINGS = keymap.bindings("diagram")
    DEFAULT_CSS = """
    DiagramView { height: 1fr; background: $surface; color: $text; scrollbar-size: 1 1;
                  scrollbar-background: $surface; scrollbar-corner-color: $surface; }
    DiagramView:focus { background: $surface; }
    .diagram--box { color: $foreground; text-style: bold; }
    .diagram--chip { color: $foreground; background: $panel; }
    .diagram--line { color: $secondary; }
    .diagram--key { color: $primary; text-style: bold; }
    .diagram--linked { color: $primary; }
    .diagram--linked-chip { color: $primary; background: $panel; }
    .diagram--selected { color: $block-cursor-foreground; background: $block-cursor-background; text-style: bold; }
    .diagram--fault { color: $error; text-style: bold; }
    .diagram--faded { color: $secondary; }
    .diagram--map { color: $secondary; background: $panel; }
    .diagram--seen { color: $foreground; background: $boost; text-style: bold; }
    .diagram--warn { color: $warning; background: $panel; }
    """
    COMPONENT_CLASSES: ClassVar[set[str]] = {
        f"diagram--{each}"
        for each in (
            "box",
            "chip",
            "line",
            "key",
            "linked",
            "linked-chip",
            "selected",
            "warn",
            "fault",
            "faded",
            "map",
            "seen",
        )
    }

    EMPTY: ClassVar[Digraph] = Digraph()
    selected: reactive[str] = reactive("", init=False)
    """The id of the selected item; empty if there is none."""

    class Resized(Message):
        """The room for the picture has changed."""

    class Selected(Message):
        """Another item is selected."""

        def __init__(self, view: DiagramView, item: str) -> None:
            super().__init__()
            self.view = view
            self.item = item

    def __init__(self) -> None:
        super().__init__()
        self.drawing = Drawing()
        self.places: dict[str, Place] = {}
        self._links: frozenset[tuple[str, str]] = frozenset()
        self._content: Content = Digraph()
        self._warned: frozenset[str] = frozenset()
        self._faults: frozenset[tuple[str, str]] = frozenset()
        self._faded: frozenset[str] = frozenset()
        self._map: tuple[object, list[str]] | None = None
        self._drawings: dict[Manner, Drawing] = {}
        self._direction: ArrowDirection | None = None
        self._selecting = False
        self._downward = False
        self._room = Size()
        self._footer: tuple[str, ...] = ()
        self._legend = ""
        self._drawing_beside = False

    def show(
        self,
        content: Content,
        warned: frozenset[str] = frozenset(),
        faults: frozenset[tuple[str, str]] = frozenset(),
        faded: frozenset[str] = frozenset(),
    ) -> None:
        """Draw a graph; items in `warned` and edges in `faults` are highlighted, items in `faded` are dimmed.

        Selection and scroll position are kept if possible.
        """
        self._warned, self._faults, self._faded = warned, faults, faded
        if content != self._content:
            self._content = content
            self._drawings.clear()
        self._lay_out()
        self.refresh()

    @property
    def is_large(self) -> bool:
        """Whether laying the graph out takes so long that it is done in a thread."""
        content = self._content
        if isinstance(content, Chart):
            return len(content.boxes) + len(content.links) > MIN_THREADED_ITEMS
        return isinstance(content, Digraph) and len(content.items) > MIN_THREADED_ITEMS

    def _manners(self) -> tuple[Manner, ...]:
        """The manners in which the content may be drawn."""
        if not isinstance(self._content, Digraph):
            return (self._window,)
        if self.is_large:
            return (self._direction or RIGHT,)
        return (self._direction,) if self._direction else (RIGHT, DOWN)

    @property
    def _window(self) -> Size:
        """The room for a picture without scroll bars.

        A hidden widget has no size, and if it is shown again in its old size, it is not resized; so the outer size
        counts.
        """
        return self.outer_size or self.size

    def _lay_out(self) -> None:
        """Draw the manners that are not drawn yet, and choose one; a large picture is drawn in a thread."""
        manners = self._manners()
        missing = [each for each in manners if each not in self._drawings]
        if missing and self.is_large:
            if not self._drawing_beside:
                self._drawing_beside = True
                self.run_worker(self._draw_beside(), group="draw")
            return
        for each in missing:
            self._drawings[each] = _draw_content(self._content, each)
        self._choose(manners)

    async def _draw_beside(self) -> None:
        """Lay out a large picture in a thread, in one manner only, while the previous drawing stays visible.

        Only one layout runs at a time; changes in the meantime, such as new rates, wait for the next round.
        """
        try:
            while self.is_large and (manner := self._manners()[0]) not in self._drawings:
                content = self._content
                drawing = await asyncio.to_thread(_draw_content, content, manner)
                if content is self._content:
                    self._drawings[manner] = drawing
                if self.is_large:
                    self._present(drawing, manner)
        finally:
            self._drawing_beside = False

    def _choose(self, manners: Sequence[Manner]) -> None:
        """Show the drawing of which the largest part is visible."""
        manner = min(manners, key=self._excess)
        self._present(self._drawings[manner], manner)

    def _present(self, drawing: Drawing, manner: Manner) -> None:
        if drawing is not self.drawing:
            self._downward = isinstance(manner, ArrowDirection) and manner.downward
            self.drawing = drawing
            self.places = dict(drawing.places or {})
            self._links = frozenset(drawing.edges)
            self.virtual_size = Size(drawing.width + 1, len(drawing.rows))
            self.refresh()
        if not self._selecting or self.selected not in self.places:
            self.selected = self._first()

    @property
    def excess(self) -> float:
        """The ratio of the picture's size to its visible part; 1 if all of it is visible."""
        return min((self._excess(each) for each in self._manners() if each in self._drawings), default=1.0)

    def _excess(self, manner: Manner) -> float:
        room = self.size or self.outer_size
        drawing = self._drawings[manner]
        return max(1.0, drawing.width / max(1, room.width)) * max(1.0, len(drawing.rows) / max(1, room.height))

    @property
    def free_rows(self) -> int:
        """The number of free rows below the drawing."""
        return max(0, self.size.height - len(self.drawing.rows))

    def set_footer(self, lines: Sequence[str], legend: str) -> None:
        """Show lines in the last free rows, below a rule; the first line is a heading.

        The legend is shown above them if there is another free row.
        """
        if (tuple(lines), legend) != (self._footer, self._legend):
            self._footer, self._legend = tuple(lines), legend
            self.refresh()

    def _below(self, at: int, width: int) -> tuple[str, str] | None:
        """The text and style of a row below the drawing, counted from the first line of the footer."""
        if at >= 0:
            return (f" {self._footer[at]}", "" if at else "box") if at < len(self._footer) else None
        if self._footer and at == -1:
            return "─" * width, "line"
        return (f" {self._legend}", "line") if self._legend and at == (-2 if self._footer else -1) else None

    def choose(self, item: str) -> None:
        """Select a drawn item; it remains selected as long as it is drawn."""
        if item in self.places:
            self._selecting = True
            self.selected = item

    def action_turn(self) -> None:
        """Switch between arrows to the right, arrows down, and whichever fits better."""
        order: tuple[ArrowDirection | None, ...] = (None, RIGHT, DOWN)
        self._direction = order[(order.index(self._direction) + 1) % 3]
        self._lay_out()
        self.show_selected()

    def _first(self) -> str:
        def order(item: str) -> tuple[bool, int, int]:
            place = self.places[item]
            return (not place.boxed, place.y, place.x) if self._downward else (not place.boxed, place.x, place.y)

        return min(self.places, key=order, default="")

    def render_line(self, y: int) -> Strip:
        """Render a line of the picture, the footer or the placeholder."""
        row = y + self.scroll_offset.y
        width = self.size.width
        base = self.own_style
        at = y - (self.size.height - len(self._footer))
        if self.drawing.rows and row >= len(self.drawing.rows) and (below := self._below(at, width)):
            text, name = below
            return Strip(
                [Segment(text, base + self.part_style(f"diagram--{name}") if name else base)]
            ).adjust_cell_length(width, base)
        lines = () if self.drawing.rows else placeholder_lines(self.placeholder, width, self.size.height)
        if y < len(lines):
            styles = {"": base} | {
                name: base + self.part_style(f"diagram--{part}") for name, part in (("dim", "line"), ("key", "key"))
            }
            return Strip([Segment(text, styles[name]) for text, name in lines[y]]).adjust_cell_length(width, base)
        runs = self.drawing.rows[row] if row < len(self.drawing.rows) else ()
        segments: list[Segment] = []
        at = 0
        for run in runs:
            if run.x > at:
                segments.append(Segment(" " * (run.x - at), base))
            segments.append(Segment(run.text, base + self._style(run)))
            at = run.x + cell_len(run.text)
        left = self.scroll_offset.x - self._indent
        if left < 0:
            segments.insert(0, Segment(" " * -left, base))
            left = 0
        strip = Strip(segments).crop_extend(left, left + width, base)
        return self._with_map(strip, y, width)

    def _with_map(self, strip: Strip, y: int, width: int) -> Strip:
        """Draw the overview map over the lower right corner, unless the whole picture is visible."""
        window = Window(self.scroll_offset.x, self.scroll_offset.y, width, self.size.height)
        extent = (self.drawing.width, len(self.drawing.rows))
        size = map_size(*extent, window)
        line = y - (window.height - size[1])
        if not size[0] or line < 0:
            return strip
        key = (id(self.drawing), size, self.selected)
        if self._map is None or self._map[0] != key:
            self._map = key, map_lines(self.places, extent, size, self.selected)
        characters = self._map[1][line]
        columns, lines = visible_part(extent, size, window)
        inside = line in lines
        first, last = (columns.start, columns.stop) if inside else (0, 0)
        parts = ((characters[:first], "map"), (characters[first:last], "seen"), (characters[last:], "map"))
        styles = {name: self.get_component_rich_style(f"diagram--{name}") for name in ("map", "seen")}
        return Strip.join(
            [
                strip.crop(0, width - size[0] - 1),
                Strip([Segment("▏", styles["map"]), *(Segment(text, styles[name]) for text, name in parts if text)]),
            ]
        )

    @property
    def _indent(self) -> int:
        """The indentation (cells) that centres a picture that is narrower than the widget."""
        return max(0, (self.size.width - self.drawing.width) // 2)

    def _style(self, run: Run) -> Style:
        return self.part_style(f"diagram--{self._class(run)}")

    def _class(self, run: Run) -> str:
        selected = self.selected
        if not run.item:
            if run.edges & self._faults:
                return "fault"
            return "linked" if any(selected in edge for edge in run.edges) else "line"
        if run.item == selected:
            return "selected"
        if run.item in self._faded:
            return "faded"
        boxed = self.places[run.item].boxed
        if (selected, run.item) in self._links or (run.item, selected) in self._links:
            return "linked" if boxed else "linked-chip"
        if run.item in self._warned:
            return "warn"
        return "box" if boxed else "chip"

    def watch_selected(self, before: str, after: str) -> None:
        """Redraw, scroll to the item, and post `Selected`."""
        self.refresh()
        self.show_selected()
        self.post_message(self.Selected(self, after))

    def show_selected(self) -> None:
        """Scroll the selected item into view."""
        place = self.places.get(self.selected)
        if place is not None:
            region = Region(place.x - MARGIN_CELLS, place.y - 1, place.width + 2 * MARGIN_CELLS, place.height + 2)
            self.scroll_to_region(region, animate=False, force=True)

    def action_select(self, across: int, down: int) -> None:
        """Select the nearest item in a direction; a linked one counts as nearer."""
        self._selecting = True
        here = self.places.get(self.selected)
        if here is None:
            self.selected = self._first()
            return
        beyond = [each for each, place in self.places.items() if _beyond(here, place, across, down)]
        self.selected = min(beyond, key=lambda each: self._distance(here, each, across, down), default=self.selected)

    def find(self, wanted: Callable[[str], bool], step: int) -> bool:
        """Select the next (`step` 1) or previous (-1) matching item, line by line, wrapping around."""
        order = sorted(self.places, key=lambda each: (self.places[each].y, self.places[each].x))
        at = order.index(self.selected) if self.selected in order else -1
        found = next(
            (each for away in range(1, len(order) + 1) if wanted(each := order[(at + step * away) % len(order)])), ""
        )
        if found:
            self._selecting = True
            self.selected = found
        return bool(found)

    def _distance(self, here: Place, item: str, across: int, down: int) -> tuple[int, str]:
        place = self.places[item]
        # A cell is about twice as high as it is wide.
        dx = _apart(here.x, here.width, place.x, place.width)
        dy = 2 * _apart(here.y, here.height, place.y, place.height)
        ends = (self.selected, item) if across + down > 0 else (item, self.selected)
        straight, aside = (dx, dy) if across else (dy, dx)
        return straight + 3 * aside - (60 if ends in self._links else 0), item

    def action_scroll_picture(self, across: int, down: int) -> None:
        """Scroll by half of the visible part."""
        self.scroll_relative(
            x=across * max(1, self.size.width // 2), y=down * max(1, self.size.height // 2), animate=False, force=True
        )

    def on_click(self, event: MouseEvent) -> None:
        """Select what was clicked."""
        x, y = event.x + self.scroll_offset.x - self._indent, event.y + self.scroll_offset.y
        for each, place in self.places.items():
            if place.x <= x < place.x + place.width and place.y <= y < place.y + place.height:
                self._selecting = True
                self.selected = each

    def on_resize(self) -> None:
        """Choose the direction again, and keep the selected item in view."""
        self._lay_out()
        self.show_selected()
        if self.outer_size != self._room:  # unlike `size`, it does not depend on scroll bars
            self._room = self.outer_size
            self.post_message(self.Resized())


def _draw_content(content: Content, manner: Manner) -> Drawing:
    if isinstance(content, Digraph):
        return draw(content, manner if isinstance(manner, ArrowDirection) else RIGHT)
    width, height = (manner.width, manner.height) if isinstance(manner, Size) else (0, 0)
    return draw_chart(content, width - 1, height) if isinstance(content, Chart) else draw_listing(content, width - 1)


def _apart(begin: int, length: int, other: int, other_length: int) -> int:
    """The number of free cells between two intervals; 0 if they overlap."""
    return max(0, other - begin - length, begin - other - other_length)


def _beyond(here: Place, there: Place, across: int, down: int) -> bool:
    if across:
        return (there.x >= here.x + here.width) if across > 0 else (there.x + there.width <= here.x)
    return there.y >= here.y + here.height if down > 0 else there.y + there.height <= here.y
