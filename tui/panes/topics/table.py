"""The list of topics, services or actions, with the measurements of the visible ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from bot_console.tui.console.model import RateCheck
from bot_console.tui.console.topics.port import Goal, Measure, Repeated
from bot_console.tui.panes.topics.rows import Kind, Row
from bot_console.tui.text.figures import age_text, amount_text, rate_text, span_text, steady
from bot_console.tui.text.sanitize import cut, cut_name, sanitize
from bot_console.tui.widgets.item_list import ItemList
from rich.cells import cell_len
from rich.segment import Segment

ENDS_CELLS, RATE_CELLS, AMOUNT_CELLS, AGE_CELLS, LATENCY_CELLS = 6, 6, 8, 7, 8
"""Cells of the columns of figures, including their gaps."""
MIN_NAME_CELLS = 14
"""Minimum cells of a name."""

MIN_WIDE_CELLS = 56
"""Minimum width (cells) at which all figures are shown even if names are cut; below it, only the rate is then shown."""
QOS_CELLS = 32
MIN_VALUE_CELLS, MIN_WIDE_VALUE_CELLS = 12, 26
"""Minimum cells of the newest value, and its minimum before types and QoS are shown."""
MAX_VALUE_CELLS = 50
"""Maximum cells of the newest value."""
MIN_TYPE_CELLS = 16
"""Minimum cells of a type."""


@dataclass(frozen=True)
class Columns:
    """Cells of each column; 0 if the column is left out."""

    name: int
    type: int
    figures: bool
    amounts: bool
    """Whether there are more figures than the rate."""

    latency: bool
    qos: int
    value: int


def columns(rows: Sequence[Row], kind: Kind, width: int) -> Columns:
    """Divide `width` cells: names come first, then figures, the newest value, types and QoS."""
    longest = max((cell_len(_label(each)) + 3 for each in rows), default=MIN_NAME_CELLS)
    figures = kind is Kind.TOPICS
    latency = figures and width >= 90
    amounts = figures and (
        width >= MIN_WIDE_CELLS or longest <= width - ENDS_CELLS - RATE_CELLS - AMOUNT_CELLS - AGE_CELLS
    )
    room = width - ENDS_CELLS - (RATE_CELLS * figures) - (AMOUNT_CELLS + AGE_CELLS) * amounts - LATENCY_CELLS * latency
    name = max(MIN_NAME_CELLS, min(longest, room))
    left = room - name
    value = (
        (MIN_WIDE_VALUE_CELLS if left >= MIN_WIDE_VALUE_CELLS else left if left >= MIN_VALUE_CELLS else 0)
        if figures
        else 0
    )
    left -= value
    types = (
        min(max((cell_len(_short(each.type)) + 2 for each in rows), default=0), left) if left >= MIN_TYPE_CELLS else 0
    )
    left -= types
    qos = QOS_CELLS if figures and left >= QOS_CELLS else 0
    left -= qos
    wider = min(left, MAX_VALUE_CELLS - value) if value else 0
    left -= wider
    return Columns(
        name + (0 if types else left), types + (left if types else 0), figures, amounts, latency, qos, value + wider
    )


def heading(shown: Columns, kind: Kind) -> str:
    """The titles of the columns."""
    ends = "pub/sub" if kind is Kind.TOPICS else "srv/cli"
    text = cut("  " + kind.value[:-1], shown.name - 2, pad=True) + f"{ends:>{ENDS_CELLS + 2}}"
    if shown.figures:
        text += f"{'Hz':>{RATE_CELLS}}"
    if shown.amounts:
        text += f"{'per s':>{AMOUNT_CELLS}}{'age':>{AGE_CELLS}}"
    if shown.latency:
        text += f"{'latency':>{LATENCY_CELLS}}"
    if shown.value:
        text += cut("  value", shown.value, pad=True)
    if shown.type:
        text += cut("  type", shown.type, pad=True)
    return text + ("  qos offered" if shown.qos else "")


def _short(type_name: str) -> str:
    """A type without its middle: `sensor_msgs/LaserScan`."""
    return sanitize(type_name.replace("/msg/", "/").replace("/srv/", "/").replace("/action/", "/"))


def _type_text(type_name: str, width: int) -> str:
    """A type without its package if it would not fit into `width` cells otherwise."""
    short = _short(type_name)
    return short if cell_len(short) <= width else short.rpartition("/")[2]


def _label(row: Row) -> str:
    """The name as listed: a namespace has an arrow, its members are indented."""
    if row.members:
        return f"{'▸' if row.is_folded else '▾'} {sanitize(row.name)}"
    return ("  " if row.space else "") + sanitize(row.label)


class TopicRows(ItemList[Row]):
    """One topic, service, action or namespace per row."""

    def __init__(self) -> None:
        super().__init__()
        self.kind = Kind.TOPICS
        self.repeated: Mapping[str, Repeated] = {}
        self.goals: Mapping[str, Goal] = {}
        self.opened = ""
        """The topic whose message is shown beside the list."""

        self.checks: Mapping[str, RateCheck] = {}
        """The expected rates, by topic."""
        self._measured: dict[str, Measure] = {}
        self._values: Mapping[str, str] = {}
        self._texts: dict[object, str] = {}
        self._columns: tuple[object, Columns] | None = None

    def key(self, item: Row) -> object:
        """The name, and whether the row is a namespace: a topic may have the same name."""
        return item.name, bool(item.members)

    @property
    def in_view(self) -> list[str]:
        """The names in the visible rows, without namespaces."""
        top = self.scroll_offset.y
        return [each.name for each in self.rows[top : top + self.size.height] if not each.members]

    def columns(self, width: int) -> Columns:
        """The columns for a width, cached for the same rows."""
        key = (self.rows, self.kind, width)
        known = self._columns
        if known is None or known[0] != key:
            known = self._columns = (key, columns(self.rows, self.kind, width))
        return known[1]

    def show_measured(
        self, measured: Mapping[str, Measure], repeated: Mapping[str, Repeated], values: Mapping[str, str]
    ) -> None:
        """Update figures and values, and redraw the visible rows whose texts have changed."""
        before = self._measured
        self._measured = {topic: _steady(before.get(topic), each) for topic, each in measured.items()}
        self.repeated, self._values = repeated, values
        top = self.scroll_offset.y
        for index in range(top, min(len(self.rows), top + self.size.height)):
            row = self.rows[index]
            late = "!" if self._is_row_late(row) else ""
            figures = "" if row.members else self._figures(row.name, amounts=True, latency=True)
            text = figures + self._mark(row.name) + late + values.get(row.name, "")
            if self._texts.get(self.key(row)) != text:
                self._texts[self.key(row)] = text
                self.row_changed(index)

    def measure_of(self, name: str) -> Measure:
        """The measurements of a topic."""
        return self._measured.get(name, Measure())

    def _mark(self, name: str) -> str:
        goal = self.goals.get(name)
        return "▶" if name in self.repeated or (goal is not None and goal.active) else " "

    def is_late(self, name: str) -> bool:
        """Whether a topic misses its expected rate."""
        return self.kind is Kind.TOPICS and name in self.checks and self.checks[name].late is True

    def _is_row_late(self, row: Row) -> bool:
        return any(map(self.is_late, row.members if row.is_folded else (row.name,)))

    def _figures(self, name: str, *, amounts: bool, latency: bool) -> str:
        known = self._measured.get(name, Measure())
        text = f"{rate_text(known.rate, provisional=known.provisional):>{RATE_CELLS}}"
        if amounts:
            text += f"{amount_text(known.bandwidth):>{AMOUNT_CELLS}}{age_text(known.age):>{AGE_CELLS}}"
        return text + (f"{span_text(known.latency):>{LATENCY_CELLS}}" if latency else "")

    def row(self, index: int, width: int) -> list[Segment]:
        """Mark, name, publishers and subscribers, figures, newest value, type, QoS."""
        row, shown = self.rows[index], self.columns(width)
        late = self._is_row_late(row)
        style = self.row_style("warn") if row.problem or late else None
        mark = self._mark(row.name)
        name = self.row_style("head") if row.name == self.opened or row.members else None
        segments = [
            Segment(mark, self.row_style("good")),
            Segment("!" if row.problem or late else " ", style),
            Segment(cut_name(_label(row), shown.name - 2, pad=True), style or name),
        ]
        if row.members:
            count = f"{len(row.members)} {self.kind.value}" if row.is_folded else ""
            return [*segments, Segment(f"  {count}", self.row_style("dim"))]
        ends = f"{len(row.gives)}/{len(row.takes)}"
        segments.append(Segment(f"{ends:>{ENDS_CELLS}}", style or (self.row_style("dim") if not row.takes else None)))
        if shown.figures:
            figures = self._figures(row.name, amounts=shown.amounts, latency=shown.latency)
            rates = RATE_CELLS + AMOUNT_CELLS * shown.amounts
            dim = self.row_style("dim") if self.measure_of(row.name).provisional else style if late else None
            segments += [Segment(figures[:rates], dim), Segment(figures[rates:])]
        if shown.value:
            value = sanitize(self._values.get(row.name, ""))
            segments.append(Segment("  " + cut(value, shown.value - 2, pad=True)))
        if shown.type:
            kind = _type_text(row.type, shown.type - 2)
            segments.append(Segment(cut("  " + kind, shown.type, pad=True), self.row_style("dim")))
        if shown.qos:
            segments.append(Segment(cut("  " + sanitize(row.qos), shown.qos), self.row_style("dim")))
        return segments


def _steady(before: Measure | None, now: Measure) -> Measure:
    if before is None:
        return now
    return replace(
        now,
        rate=steady(before.rate, now.rate),
        bandwidth=steady(before.bandwidth, now.bandwidth),
        latency=_steady_span(before.latency, now.latency),
    )


def _steady_span(before: float | None, now: float | None) -> float | None:
    """The latency to show: it fluctuates more than a rate, so changes below a fifth or a millisecond are ignored."""
    if before is None or now is None:
        return now
    return before if abs(now - before) <= max(1e-3, abs(before) / 5) else now
