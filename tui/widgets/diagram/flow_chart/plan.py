"""Places the boxes of a flow chart as stairs, each right of the lines that still lead past it, and routes the links.

A box has one trunk, from which a branch with its words leads to the left side of each later box that it is linked to.
Links to earlier boxes run on the right, and end at the right sides of their targets. Pure.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from bot_console.tui.widgets.diagram.flow_chart.cells import Cells
from bot_console.tui.widgets.diagram.flow_chart.model import Chart, ChartBox, ChartLink
from bot_console.tui.widgets.diagram.flow_chart.order import order_boxes
from rich.cells import cell_len

BRACKET = 2
"""Cells between a box of several members and the line that splits into an arrow to each, including the arrow."""
LOOK_BACK_ROWS = 40
"""Rows above the lowest box in which to search for a place for the next one."""


@dataclass(frozen=True)
class Style:
    """How a chart is drawn. The first `rightward` boxes have their trunks on the right, the others below."""

    rightward: int = 0
    slack: int = 0
    """Cells by which a box may move to the right to get a higher place."""
    words: int = 99
    """Maximum number of words on a line."""
    pad: int = 1
    """Cells kept free on both sides of the words."""
    framed: bool = True
    """Whether boxes have frames; without one, a box takes only one row for each name and each arrow."""
    cells: int = 99
    """Maximum length of a word in cells."""

    @property
    def frame(self) -> int:
        """The rows of the top border of a box, and of the bottom border."""
        return int(self.framed)

    @property
    def dash(self) -> int:
        """The minimum cells of line on either side of the words."""
        return int(self.framed)


@dataclass
class PlacedBox:
    """A box with its position; `trunk` is the column of its trunk, `out` the row on which that leaves the box."""

    box: ChartBox
    x: int
    y: int
    height: int
    framed: bool = True
    trunk: int = -1
    out: int = -1
    rightward: bool = False
    ports_in: dict[str, int] = field(default_factory=lambda: {})
    """The row of each link that ends here, by id."""
    back_row: int = -1
    """The row on which links to earlier boxes leave."""

    @property
    def width(self) -> int:
        """The width in cells."""
        return self.box.width(self.framed)

    @property
    def right(self) -> int:
        """The first column right of the box."""
        return self.x + self.width

    @property
    def bottom(self) -> int:
        """The last row of the box."""
        return self.y + self.height - 1

    def member_rows(self) -> list[int]:
        """The rows of its members."""
        count, step = len(self.box.members), 1 + self.framed
        first = self.y + (self.height - (step * (count - 1) + 1)) // 2 if self.framed else self.y
        return [first + step * at for at in range(count)]


@dataclass(frozen=True)
class Label:
    """The words of a link, at their position."""

    link: str
    x: int
    y: int
    text: str


@dataclass
class Plan:
    """The positions of boxes by id, the forward and the backward links, the lanes of the latter, and the labels."""

    placed: dict[str, PlacedBox] = field(default_factory=lambda: {})
    forward: list[ChartLink] = field(default_factory=lambda: [])
    back: list[ChartLink] = field(default_factory=lambda: [])
    lanes: dict[str, int] = field(default_factory=lambda: {})
    labels: list[Label] = field(default_factory=lambda: [])
    width: int = 0
    height: int = 0


def make_plan(chart: Chart, style: Style, room: int) -> Plan:
    """Place everything; boxes without links fill rows of the width `room` below the others."""
    builder = _Builder(chart, style)
    groups = order_boxes(chart)
    for group in groups:
        builder.place_group(group)
    builder.add_lanes()
    linked = {each for group in groups for each in group}
    builder.add_alone([each for each in chart.boxes if each.id not in linked], room)
    return builder.plan


class _Builder:
    def __init__(self, chart: Chart, style: Style) -> None:
        self.plan = Plan()
        self._style = style
        self._boxes = {each.id: each for each in chart.boxes}
        self._links = chart.links
        self._cells = Cells()
        self._trunk_end: dict[str, int] = {}
        self._left: dict[str, set[str]] = {}
        """The targets of each trunk that have not been placed yet."""
        self._rightward = style.rightward

    def place_group(self, group: Sequence[str]) -> None:
        at = {each: number for number, each in enumerate(group)}
        links = [each for each in self._links if each.source in at]
        forward = [each for each in links if at[each.source] < at[each.target]]
        back = [each for each in links if at[each.source] > at[each.target]]
        self.plan.forward += forward
        self.plan.back += back
        self._left = {}
        for each in group:
            rightward = self._rightward > 0
            self._rightward -= 1
            self._place(each, forward, back, rightward)

    def _label(self, link: ChartLink) -> str:
        pad = " " * self._style.pad
        return f"{pad}{link.label(self._style.words, self._style.cells)}{pad}"

    def _place(self, name: str, forward: list[ChartLink], back: list[ChartLink], rightward: bool) -> None:
        box = self._boxes[name]
        ins = sorted((each for each in forward if each.target == name), key=lambda each: -self._column(each))
        outs = {each.target for each in forward if each.source == name}
        back_in = [each for each in back if each.target == name]
        back_out = any(each.source == name for each in back)
        several = len(box.members) > 1
        rightward = rightward and bool(outs) and not several
        right_ports = len(back_in) + (back_out and not several) + rightward
        style = self._style
        inner = max((1 + style.framed) * (len(box.members) - 1) + 1, len(ins), right_ports, 1)
        inner += (
            several and back_out and not style.framed
        )  # an extra row; with a frame, the bottom border serves as that row
        wants = _BoxNeeds(box, ins, outs, back_in, back_out, rightward, inner + 2 * style.frame, style)
        spot = self._spot(wants)
        self._settle(wants, spot)

    def _column(self, link: ChartLink) -> int:
        return self.plan.placed[link.source].trunk

    def _spot(self, wants: _BoxNeeds) -> tuple[int, int]:
        """The highest free place; among those at the same height, the leftmost."""
        live = [self.plan.placed[each].trunk for each, left in self._left.items() if left]
        left = BRACKET if len(wants.box.members) > 1 and wants.ins else 0
        first = max((each + 2 for each in live), default=0) + left
        sure = first
        for each in wants.ins:
            room = cell_len(self._label(each)) + 2 + 2 * self._style.dash + left
            first = max(first, self._column(each) + room) if self._column(each) == max(live) else first
            sure = max(sure, max(live) + room)
        edges = {each.right + 1 + left for each in self.plan.placed.values()}
        columns = sorted({first, sure} | {each for each in edges if first < each <= sure + self._style.slack})
        least = max((self.plan.placed[each.source].out for each in wants.ins), default=0) - wants.height
        top = max(0, least, self._cells.bottom - LOOK_BACK_ROWS)
        while True:
            for x in columns:
                if self._fits(wants, x, top):
                    return x, top
            top += 1

    def _ports(self, wants: _BoxNeeds, top: int) -> list[int]:
        start = top + (wants.height - len(wants.ins)) // 2
        return [start + at for at in range(len(wants.ins))]

    def _fits(self, wants: _BoxNeeds, x: int, top: int) -> bool:
        cells = self._cells
        several = len(wants.box.members) > 1
        bracket = BRACKET if several else 0
        begin = x - (bracket if wants.ins else 0)
        end = x + wants.width + (bracket if wants.back_in else 0) + (2 if wants.rightward else 0)
        bottom = top + wants.height
        if not cells.free_for_box(begin, end, range(top, bottom)):
            return False
        if not all(cells.free_to_the_right(y, end) for y in wants.right_rows(top)):
            return False
        if wants.outs:
            trunk, out = wants.trunk(x, top)
            if not cells.free_down(trunk, range(max(out, bottom), cells.bottom)):
                return False
        return all(
            self._reaches(each, port, begin, wants)
            for each, port in zip(wants.ins, self._ports(wants, top), strict=True)
        )

    def _reaches(self, link: ChartLink, port: int, end: int, wants: _BoxNeeds) -> bool:
        """Whether the link can run along a row to the left side of its target, with its words."""
        source, cells = self.plan.placed[link.source], self._cells
        below = not source.rightward
        if port < source.out + below:
            return False
        ended = self._trunk_end[link.source]
        fresh = range(ended + 1, port + 1)
        if not cells.free_down(source.trunk, fresh) or not cells.free_across(port, source.trunk + 1, end):
            return False
        if (source.trunk, port) in cells.across and port != source.out:
            return False
        if (end - 1, port) in cells.down:  # the arrow head
            return False
        return self._gap(link, port, end, wants) is not None

    def _gap(self, link: ChartLink, port: int, end: int, wants: _BoxNeeds) -> int | None:
        """The column at which the words have room on the row, as near to the arrow as possible; None if nowhere."""
        name = wants.box.id
        passing = {
            self.plan.placed[each].trunk for each, left in self._left.items() if left - {name} and each != link.source
        }
        begin = self.plan.placed[link.source].trunk + 1
        taken = [x for x in range(begin, end) if (x, port) in self._cells.down or x in passing]
        length, dash = cell_len(self._label(link)), self._style.dash
        stop = end - 1  # the arrow
        for wall in [*reversed(taken), begin - 1]:
            if stop - wall - 1 >= length + 2 * dash:
                return stop - dash - length
            stop = wall
        return None

    def _settle(self, wants: _BoxNeeds, spot: tuple[int, int]) -> None:
        x, top = spot
        cells, box = self._cells, wants.box
        found = PlacedBox(box, x, top, wants.height, self._style.framed, rightward=wants.rightward)
        several = len(box.members) > 1
        begin = x - (BRACKET if several and wants.ins else 0)
        end = x + wants.width + (BRACKET if several and wants.back_in else 0)
        cells.add(cells.boxes, ((at, y) for y in range(top, top + wants.height) for at in range(begin, end)))
        for link, port in zip(wants.ins, self._ports(wants, top), strict=True):
            gap = self._gap(link, port, begin, wants)
            assert gap is not None
            label = Label(link.id, gap, port, self._label(link))
            self.plan.labels.append(label)
            # Lines of later boxes must not run down through the words or the arrow head.
            cells.add(cells.down, ((gap + at, port) for at in range(cell_len(label.text))))
            source = self.plan.placed[link.source]
            first = self._trunk_end[link.source] + 1
            cells.add(cells.down, ((source.trunk, y) for y in range(first, port + 1)))
            cells.add(cells.across, ((at, port) for at in range(source.trunk, begin)))
            cells.add(cells.down, [(begin - 1, port)])
            self._trunk_end[link.source] = max(self._trunk_end[link.source], port)
            self._left[link.source].discard(box.id)
            found.ports_in[link.id] = port
        rows = wants.right_rows(top)
        for link, row in zip(wants.back_in, rows, strict=False):
            found.ports_in[link.id] = row
            cells.add(cells.boxes, [(end, row)])
        if wants.back_out:
            found.back_row = rows[-1]
        for row in rows:
            cells.kept[row] = end
        if wants.outs:
            found.trunk, found.out = wants.trunk(x, top)
            self._left[box.id] = set(wants.outs)
            self._trunk_end[box.id] = found.out
            if wants.rightward:
                cells.add(cells.across, ((at, found.out) for at in range(found.right, found.trunk + 1)))
                cells.add(cells.down, [(found.trunk, found.out)])
        self.plan.placed[box.id] = found
        self._measure()

    def _measure(self) -> None:
        self.plan.width = max(self._cells.last.values(), default=-1) + 1
        self.plan.height = self._cells.bottom

    def add_lanes(self) -> None:
        """Route the backward links on the right, short ones inside long ones."""
        spans: list[tuple[int, int, str]] = []
        for source in dict.fromkeys(each.source for each in self.plan.back):
            rows = [self.plan.placed[source].back_row]
            rows += [
                self.plan.placed[each.target].ports_in[each.id] for each in self.plan.back if each.source == source
            ]
            spans.append((min(rows), max(rows), source))
        for low, high, source in sorted(spans, key=lambda each: (each[1] - each[0], each)):
            self._add_lane(low, high, source)
        self._measure()

    def _add_lane(self, low: int, high: int, source: str) -> None:
        cells = self._cells
        lane = max(cells.last.get(y, -1) for y in range(low, high + 1)) + 2
        links = [each for each in self.plan.back if each.source == source]
        starts: list[tuple[ChartLink, int, int]] = []
        for link in links:
            target = self.plan.placed[link.target]
            start = target.right + 1 + (BRACKET if len(target.box.members) > 1 else 0)
            row = target.ports_in[link.id]
            starts.append((link, row, start))
            length = cell_len(self._label(link))
            if self._gap_back(row, start, lane, length) is None:
                last = max((x for x in range(start, lane) if (x, row) in cells.down), default=start - 1)
                lane = max(lane, last + length + 3)
        for link, row, start in starts:
            at = self._gap_back(row, start, lane, cell_len(self._label(link)))
            assert at is not None
            self.plan.labels.append(Label(link.id, at, row, self._label(link)))
            cells.add(cells.across, ((x, row) for x in range(start - 1, lane)))
        owner = self.plan.placed[source]
        cells.add(cells.across, ((x, owner.back_row) for x in range(owner.right, lane)))
        cells.add(cells.down, ((lane, y) for y in range(low, high + 1)))
        self.plan.lanes[source] = lane

    def _gap_back(self, row: int, start: int, lane: int, length: int) -> int | None:
        begin = start
        for x in range(start, lane + 1):
            if x == lane or (x, row) in self._cells.down:
                if x - begin >= length + 2:
                    return begin + 1
                begin = x + 1
        return None

    def add_alone(self, boxes: Sequence[ChartBox], room: int) -> None:
        """Place the boxes without links in rows below the others."""
        style = self._style
        x, top, high = 0, self._cells.bottom, 0
        for box in boxes:
            width = box.width(style.framed)
            height = (1 + style.framed) * (len(box.members) - 1) + 1 + 2 * style.frame
            if x and x + width > room:
                x, top, high = 0, top + high, 0
            self.plan.placed[box.id] = PlacedBox(box, x, top, height, style.framed)
            cells = ((at, y) for y in range(top, top + height) for at in range(x, x + width))
            self._cells.add(self._cells.boxes, cells)
            x, high = x + width + 1, max(high, height)
        self._measure()


@dataclass(frozen=True)
class _BoxNeeds:
    """What a box needs at its place: its links in and out, and its height."""

    box: ChartBox
    ins: list[ChartLink]
    outs: set[str]
    back_in: list[ChartLink]
    back_out: bool
    rightward: bool
    height: int
    style: Style

    @property
    def width(self) -> int:
        """The width of the box."""
        return self.box.width(self.style.framed)

    def right_rows(self, top: int) -> list[int]:
        """The rows of the backward lines: first those that end at this box, last the one that begins here."""
        several = len(self.box.members) > 1
        count = len(self.back_in) + (self.back_out and not several)
        start = top + (self.height - count - self.rightward) // 2
        rows = [start + at for at in range(count)]
        if self.rightward and self.back_out:
            rows[-1] += 1
        return [*rows, top + self.height - 1] if self.back_out and several else rows

    def trunk(self, x: int, top: int) -> tuple[int, int]:
        """The column of the trunk and the row on which it leaves the box."""
        if not self.rightward:
            return x + 1 + self.style.frame, top + self.height - 1
        before = len(self.back_in)
        count = before + self.back_out + 1
        return x + self.width + 1, top + (self.height - count) // 2 + before
