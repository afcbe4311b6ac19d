"""Draws a flow chart: the first of several plans that fits. Pure."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from itertools import product

from bot_console.tui.widgets.diagram.columns import Edge
from bot_console.tui.widgets.diagram.drawing import Drawing, Place, Rows, Run
from bot_console.tui.widgets.diagram.flow_chart.model import Chart, ChartLink
from bot_console.tui.widgets.diagram.flow_chart.plan import PlacedBox, Plan, Style, make_plan
from bot_console.tui.widgets.diagram.flow_chart.spreading import spread
from bot_console.tui.widgets.diagram.lines import LEFT, RIGHT, UP, Lines
from rich.cells import cell_len

MIN_WIDE_COLUMNS = 116
"""Minimum width (columns) at which a chain of boxes may run from left to right instead of down."""
RIGHTWARD = (99, 3, 2, 1, 0)
SLACK = (0, 4, 10)
WORDS = (
    Style(pad=1), Style(pad=0), Style(pad=1, framed=False), Style(pad=0, framed=False),
    Style(pad=0, words=3), Style(pad=0, words=3, framed=False), Style(pad=0, words=3, framed=False, cells=10),
    Style(pad=0, words=1, framed=False, cells=7),
)  # fmt: skip
"""Styles from spacious to compact: blanks around the words, then frames, are the first things to be left out."""
SOME_LINKS, MANY_LINKS = 24, 80
"""Above these numbers of links, only a few plans are tried, or only one."""


def best_plan(chart: Chart, width: int, height: int) -> Plan:
    """The first plan that fits, or the one with the largest visible part."""
    lengths = (replace(each, words=tuple("─" * cell_len(word) for word in each.words)) for each in chart.links)
    return make_plan(chart, _best_style(Chart(chart.boxes, tuple(lengths)), width, height), width)


@lru_cache(maxsize=8)
def _best_style(shape: Chart, width: int, height: int) -> Style:
    """The best style for a chart whose words have these lengths; cached, as rates change but their lengths do not."""
    styles = list(_styles(shape, width))
    if len(styles) == 1:
        return styles[0]
    best: tuple[float, Style] | None = None
    for style in styles:
        plan = make_plan(shape, style, width)
        excess = max(1.0, plan.width / max(1, width)) * max(1.0, plan.height / max(1, height))
        if excess == 1.0:
            return style
        if best is None or excess < best[0]:
            best = excess, style
    return best[1] if best else Style()


def _styles(chart: Chart, width: int) -> Iterator[Style]:
    count, wide = len(chart.links), width >= MIN_WIDE_COLUMNS
    if count > MANY_LINKS:
        yield Style(words=3)
        return
    few = count > SOME_LINKS
    slacks = (4,) if few else SLACK[::2] if wide else SLACK
    rightward = (0,) if not wide else RIGHTWARD[1::3] if few else RIGHTWARD
    for style, right, slack in product((*WORDS[::3], WORDS[-1]) if few else WORDS, rightward, slacks):
        if style.framed or not right:
            yield replace(style, rightward=right, slack=slack)


def draw_chart(chart: Chart, width: int, height: int) -> Drawing:
    """Draw a chart for a window of `width` x `height` cells."""
    return draw_plan(chart, spread(best_plan(chart, width, height), height))


def draw_plan(chart: Chart, plan: Plan) -> Drawing:
    """Draw a plan."""
    lines = Lines()
    for link in plan.forward:
        _draw_forward(lines, plan, link)
    for link in plan.back:
        _draw_back(lines, plan, link)
    runs: dict[int, list[Run]] = {}
    places: dict[str, Place] = {}
    outgoing = {each.source for each in plan.forward}
    for each in plan.placed.values():
        _draw_box(each, each.box.id in outgoing, runs, places)
    for label in plan.labels:
        width = cell_len(label.text)
        lines.erase(label.y, label.x, label.x + width)
        runs.setdefault(label.y, []).append(Run(label.x, label.text, label.link))
        places[label.link] = Place(label.x, label.y, width, 1, False)
    members = {each.id: [item for item, _ in each.members] for each in chart.boxes}
    edges: list[Edge] = []
    for link in chart.links:
        edges += [(item, link.id) for item in members[link.source]]
        edges += [(link.id, item) for item in members[link.target]]
        edges += [(a, b) for a in members[link.source] for b in members[link.target]]
    return Drawing(Rows(plan.height, lines, runs), places, plan.width, tuple(edges))


def _edges(plan: Plan, link: ChartLink) -> frozenset[Edge]:
    sources = (item for item, _ in plan.placed[link.source].box.members)
    targets = (item for item, _ in plan.placed[link.target].box.members)
    return frozenset({*((each, link.id) for each in sources), *((link.id, each) for each in targets)})


def _draw_forward(lines: Lines, plan: Plan, link: ChartLink) -> None:
    source, target, edges = plan.placed[link.source], plan.placed[link.target], _edges(plan, link)
    port, owner = target.ports_in[link.id], source.box.id
    start = source.out
    if not source.rightward:
        start += 1
        lines.stub(source.trunk, start, UP, edges, owner)
    else:
        lines.across(source.out, source.right, source.trunk, edges, owner)
    lines.down(source.trunk, start, port, edges, owner)
    end = target.x - 1
    if len(target.box.members) == 1:
        lines.across(port, source.trunk, end, edges, owner)
        lines.arrow(end, port, edges)
        return
    lines.across(port, source.trunk, end - 2, edges, owner)
    lines.stub(end - 2, port, RIGHT, edges, owner)
    _draw_bracket(lines, target, end - 1, port, edges, LEFT)


def _draw_back(lines: Lines, plan: Plan, link: ChartLink) -> None:
    source, target, edges = plan.placed[link.source], plan.placed[link.target], _edges(plan, link)
    port, owner, lane = target.ports_in[link.id], source.box.id, plan.lanes[link.source]
    lines.across(source.back_row, source.right, lane, edges, owner)
    lines.down(lane, source.back_row, port, edges, owner)
    if len(target.box.members) == 1:
        lines.across(port, target.right, lane, edges, owner)
        lines.arrow_back(target.right, port, edges, owner)
        return
    lines.across(port, target.right + 2, lane, edges, owner)
    lines.stub(target.right + 2, port, LEFT, edges, owner)
    _draw_bracket(lines, target, target.right + 1, port, edges, RIGHT)


def _draw_bracket(lines: Lines, target: PlacedBox, x: int, port: int, edges: frozenset[Edge], side: int) -> None:
    """Split a line into an arrow to each member of a box; the lines of several sources join here."""
    owner = f"{target.box.id} {side}"
    rows = target.member_rows()
    lines.down(x, min(port, *rows), max(port, *rows), edges, owner)
    lines.stub(x, port, side, edges, owner)
    for row in rows:
        lines.stub(x, row, RIGHT if side == LEFT else LEFT, edges, owner)
        if side == LEFT:
            lines.arrow(x + 1, row, edges)
        else:
            lines.arrow_back(x - 1, row, edges, owner)


def _draw_box(placed: PlacedBox, outgoing: bool, runs: dict[int, list[Run]], places: dict[str, Place]) -> None:
    rows = placed.member_rows()
    items = [item for item, _ in placed.box.members]
    for y in range(placed.y, placed.bottom + 1):
        member = min(range(len(rows)), key=lambda at: abs(rows[at] - y))
        text = _framed_row(placed, y, outgoing) if placed.framed else _bare_row(placed, y)
        runs.setdefault(y, []).append(Run(placed.x, text, items[member]))
    for item, row in zip(items, rows, strict=True):
        one = len(items) == 1
        y, height = (placed.y, placed.height) if one else (row, 1)
        places[item] = Place(placed.x, y, placed.width, height, True)


def _framed_row(placed: PlacedBox, y: int, outgoing: bool) -> str:
    box, inside, rows = placed.box, placed.width - 2, placed.member_rows()
    if y == placed.y:
        loop = f" {box.loop} " if box.loop else ""
        return f"╭{loop}{'─' * (inside - cell_len(loop))}╮"
    if y == placed.bottom:
        text = "╰" + "─" * inside
        if outgoing and not placed.rightward:
            text = f"{text[:2]}┬{text[3:]}"
        return text + ("┴" if placed.back_row == y else "╯")
    if y in rows:
        label = box.members[rows.index(y)][1]
        return f"│ {label}{' ' * (inside - 1 - cell_len(label))}│"
    return "├" + "─" * inside + "┤" if rows[0] < y < rows[-1] else "│" + " " * inside + "│"


def _bare_row(placed: PlacedBox, y: int) -> str:
    rows, texts = placed.member_rows(), placed.box.texts(framed=False)
    text = texts[rows.index(y)] if y in rows else ""
    return f"[{text}{' ' * (placed.width - 2 - cell_len(text))}]"
