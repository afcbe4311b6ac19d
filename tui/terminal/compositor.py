"""A compositor that asks widgets only for the lines to be drawn.

Textual asks every widget within the bounding box of all changes for all of its lines: a number that changes in the
first line and one in the last cost as much as the whole screen, ten times a second.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from textual._compositor import ChopsUpdate, Compositor, CompositorMap, LayoutUpdate, ReflowResult
from textual.geometry import Region, Size
from textual.strip import Strip
from textual.widget import Widget

Pieces = dict[int, dict[int, int]]
"""Parts of lines between the borders of widgets, by line: the columns where each begins and ends."""


class PartwiseCompositor(Compositor):
    """Composes only the changed parts of lines, from the visible parts of the widgets there."""

    _laid_out: CompositorMap | None = None
    """The places that the widgets were told at the last layout."""

    def reflow(self, parent: Widget, size: Size) -> ReflowResult:
        """Lay out the widgets; what has changed is seen from the last layout.

        Textual compares with the places that it has looked up since, for instance to draw something else before the
        layout: a widget that has just been shown would not be told its size, and one that it moves would not be drawn.
        """
        if self._laid_out is not None:
            self._full_map = self._laid_out
        result = super().reflow(parent, size)
        self._laid_out = self._full_map
        return result

    def render_partial_update(self) -> ChopsUpdate | None:
        """The update with what has changed since the last one; None if nothing has."""
        regions = [*self._dirty_regions]
        self._dirty_regions.clear()
        if not regions:
            return None
        spans = list(self._regions_to_spans(regions))
        return ChopsUpdate(self._chops(spans), spans, [cuts[1:] for cuts in self.cuts])

    def render_full_update(self, simplify: bool = False) -> LayoutUpdate:
        """The update of the whole screen; with `simplify`, for screenshots, Textual's own."""
        if simplify:
            return super().render_full_update(simplify)
        self._dirty_regions.clear()
        width, height = self.size
        chops = self._chops([(y, 0, width) for y in range(height)])
        lines: list[Iterable[Strip]] = [[each for each in chop.values() if each is not None] for chop in chops]
        return LayoutUpdate(lines, self.size.region)

    def lines(self, rows: range) -> list[Strip]:
        """Complete lines in their current state; those below the last one are blank."""
        width, height = self.size
        chops = self._chops([(y, 0, width) for y in rows if y < height])
        return [Strip.join(chops[y].values()) if y < height else Strip.blank(width) for y in rows]

    def _chops(self, spans: Sequence[tuple[int, int, int]]) -> list[dict[int, Strip | None]]:
        """The strips of each line by column; lines outside all spans have none."""
        chops: list[dict[int, Strip | None]] = [{} for _ in self.cuts]
        wanted = self._pieces(spans)
        for y in wanted:
            chops[y] = dict.fromkeys(self.cuts[y][:-1])
        for widget, (region, clip) in self.visible_widgets.items():  # front to back
            if not wanted:
                break
            shown = region.intersection(clip)
            for y, strip in _lines(widget, region, shown, wanted):
                line = wanted[y]
                for x in [x for x in line if shown.x <= x < shown.right]:
                    chops[y][x] = strip.crop(x - shown.x, line.pop(x) - shown.x)
                if not line:
                    del wanted[y]
        return chops

    def _pieces(self, spans: Iterable[tuple[int, int, int]]) -> Pieces:
        pieces: Pieces = {}
        for y, begin, end in spans:
            line = pieces.setdefault(y, {})
            line.update((x, until) for x, until in pairwise(self.cuts[y]) if x < end and until > begin)
        return pieces


def _lines(widget: Widget, region: Region, shown: Region, wanted: Pieces) -> Iterator[tuple[int, Strip]]:
    """The wanted lines of a widget that nothing in front of it has covered yet."""
    rows = [
        y for y, line in wanted.items()
        if shown.y <= y < shown.bottom and any(shown.x <= x < shown.right for x in line)
    ]  # fmt: skip
    while rows:
        first, count = rows[0], 1
        while count < len(rows) and rows[count] == first + count:
            count += 1
        crop = Region(shown.x - region.x, first - region.y, shown.width, count)
        yield from zip(rows[:count], widget.render_lines(crop), strict=False)
        del rows[:count]
