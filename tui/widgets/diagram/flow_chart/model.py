"""The flow chart to draw: boxes, and links with words on their lines."""

from __future__ import annotations

from dataclasses import dataclass

from bot_console.tui.text.sanitize import cut_name
from rich.cells import cell_len


@dataclass(frozen=True)
class ChartBox:
    """A box with one row for each of its members, which share all links."""

    id: str
    members: tuple[tuple[str, str], ...]
    """The item and the label of each row."""
    loop: str = ""
    """The topics that lead from the box to itself, written into its top border."""

    def texts(self, framed: bool) -> list[str]:
        """The text of each row; without a frame, the first row also names the topics from the box to itself."""
        labels = [label for _, label in self.members]
        return labels if framed or not self.loop else [f"{labels[0]} {self.loop}", *labels[1:]]

    def width(self, framed: bool) -> int:
        """The width in cells, with the frame or the brackets."""
        widest = max(map(cell_len, self.texts(framed)))
        if not framed:
            return widest + 2
        return max(widest + 4, cell_len(self.loop) + 4 if self.loop else 0)


@dataclass(frozen=True)
class ChartLink:
    """Everything that leads from one box to another, drawn as one line with these words on it."""

    id: str
    source: str
    target: str
    words: tuple[str, ...]

    def label(self, maximum: int, cells: int) -> str:
        """The first `maximum` words, with names (not rates) cut to `cells`, and the number of words left out."""
        parts = (each.partition(" ") for each in self.words[:maximum])
        words = [f"{cut_name(name, cells)}{blank}{rest}" for name, blank, rest in parts]
        return "  ".join([*words, *([f"+{len(self.words) - maximum}"] if len(self.words) > maximum else [])])


@dataclass(frozen=True)
class Chart:
    """Boxes and links; there is at most one link in each direction between two boxes."""

    boxes: tuple[ChartBox, ...] = ()
    links: tuple[ChartLink, ...] = ()
