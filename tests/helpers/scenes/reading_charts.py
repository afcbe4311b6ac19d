"""Reads a drawn flow chart as a person does: from the text on a line along its strokes to the boxes at its ends."""

from __future__ import annotations

from collections.abc import Iterator

from bot_console.tui.widgets.diagram.drawing import Drawing
from rich.cells import cell_len

UP, DOWN, LEFT, RIGHT = (0, -1), (0, 1), (-1, 0), (1, 0)
STROKES = {
    "│": (UP, DOWN), "─": (LEFT, RIGHT), "╰": (UP, RIGHT), "╯": (UP, LEFT), "╭": (DOWN, RIGHT), "╮": (DOWN, LEFT),
    "├": (UP, DOWN, RIGHT), "┤": (UP, DOWN, LEFT), "┴": (LEFT, RIGHT, UP), "┬": (LEFT, RIGHT, DOWN),
    "╋": (UP, DOWN, LEFT, RIGHT), "┼": (UP, DOWN, LEFT, RIGHT),
}  # fmt: skip
HEADS = {"▶": RIGHT, "◀": LEFT}
Cell = tuple[int, int]


class Reader:
    """The cells of a drawing, and their characters."""

    def __init__(self, drawing: Drawing) -> None:
        self.cells: dict[Cell, str] = {}
        self.owners: dict[Cell, str] = {}
        places = drawing.places or {}
        for y, row in enumerate(drawing.rows):
            end = 0
            for run in row:
                assert run.x >= end, f"two things in one cell: row {y}, {run}"
                end = run.x + cell_len(run.text)
                assert end <= drawing.width, f"outside of the picture: row {y}, {run}"
                for at, character in enumerate(run.text):
                    self.cells[run.x + at, y] = character
                    if run.item:
                        self.owners[run.x + at, y] = run.item
        for item, place in places.items():
            assert place.x >= 0 and place.x + place.width <= drawing.width, item
            assert place.y >= 0 and place.y + place.height <= len(drawing.rows), item
        self.places = places

    def ends_of(self, line: str) -> tuple[set[str], set[str]]:
        """The items where the line with this text begins, and those to which its arrows lead."""
        place = self.places[line]
        sources: set[str] = set()
        targets: set[str] = set()
        for start, step in (((place.x - 1, place.y), LEFT), ((place.x + place.width, place.y), RIGHT)):
            for item, by_arrow in self._reached(start, step):
                (targets if by_arrow else sources).add(item)
        return sources, targets

    def _reached(self, start: Cell, step: Cell) -> Iterator[tuple[str, bool]]:
        """The boxes at which the strokes end, and whether with an arrow; the text of another line ends the search."""
        todo, seen = [(start, step)], set[tuple[Cell, Cell]]()
        while todo:
            cell, step = todo.pop()
            if (cell, step) in seen or cell not in self.cells:
                continue
            seen.add((cell, step))
            character, owner = self.cells[cell], self.owners.get(cell)
            if owner is not None:
                if self.places[owner].boxed:
                    yield owner, False
                continue
            if character in HEADS:
                if HEADS[character] == step:
                    beyond = (cell[0] + step[0], cell[1] + step[1])
                    yield self.owners[beyond], True
                continue
            back = (-step[0], -step[1])
            assert back in STROKES[character], f"a line breaks off at {cell}: {character}"
            onward = (step,) if character == "┼" else tuple(each for each in STROKES[character] if each != back)
            todo += [((cell[0] + each[0], cell[1] + each[1]), each) for each in onward]
