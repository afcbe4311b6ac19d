"""The parts of a terminal that the console uses: cells, their styles, and the cursor position."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Protocol

from rich.cells import get_character_cell_size

TOKEN = re.compile(r"\x1b\[(?P<private>\??)(?P<numbers>[\d;]*)(?P<final>[@-~])|\x1b.|(?P<letter>[^\x1b])", re.DOTALL)
BLANK = (" ", "")
FRAME_END = b"\x1b[6n"
"""The query to the terminal after each frame."""


class Emulator:
    """Processes output, and keeps the character and the SGR style of each cell."""

    def __init__(self, width: int, height: int) -> None:
        self.cells = [[BLANK] * width for _ in range(height)]
        self._x = self._y = 0
        self._style: tuple[str, ...] = ()

    def feed(self, text: str) -> None:
        """Process output."""
        for token in TOKEN.finditer(text):
            if token["letter"] is not None:
                self._put(token["letter"])
            elif token["final"] and not token["private"]:
                self._control(token["final"], token["numbers"])

    def _control(self, final: str, numbers: str) -> None:
        first, _, second = numbers.partition(";")
        if final == "H":
            self._y, self._x = int(first or 1) - 1, int(second or 1) - 1
        elif final == "C":
            self._x += int(first or 1)
        elif final == "m":
            self._style = styled(self._style, numbers)

    def _put(self, character: str) -> None:
        width = get_character_cell_size(character)
        row = self.cells[self._y]
        if not width:
            before = self._x - 1 - (row[self._x - 1][0] == "")
            row[before] = (row[before][0] + character, row[before][1])
            return
        for at, shown in enumerate((character, "")[:width]):
            if self._x + at < len(row):
                row[self._x + at] = (shown, ";".join(self._style))
        self._x += width

    def lines(self) -> list[str]:
        """The characters of each line."""
        return ["".join(character for character, _ in row) for row in self.cells]


def styled(before: tuple[str, ...], numbers: str) -> tuple[str, ...]:
    """The style that results from applying further SGR codes: attributes in order, then foreground, then background."""
    style = {_kind(code): code for code in before}
    for code in _codes(numbers):
        if code in ("", "0"):
            style.clear()
        elif code in ENDS:
            for each in ENDS[code]:
                style.pop(each, None)
        else:
            style[_kind(code)] = code
    return tuple(style[each] for each in sorted(style))


ENDS = {"22": ("1", "2"), "23": ("3",), "24": ("4",), "27": ("7",), "29": ("9",), "39": ("x",), "49": ("y",)}


def _codes(numbers: str) -> list[str]:
    return re.findall(r"[34]8;2;\d+;\d+;\d+|[34]8;5;\d+|\d+", numbers) or [""]


def _kind(code: str) -> str:
    value = int(code.partition(";")[0])
    if value == 38 or 30 <= value <= 37 or 90 <= value <= 97:
        return "x"
    return "y" if value == 48 or 40 <= value <= 47 or 100 <= value <= 107 else code


class Output(Protocol):
    """A program in a terminal."""

    output: bytes
    """Everything that it has written."""


def last_screen(program: Output) -> str:
    """The text on the screen after all output so far."""
    screen = Emulator(120, 40)
    screen.feed(program.output.decode(errors="replace"))
    return "\n".join(screen.lines())


def screen_of(program: Output) -> Callable[..., bool]:
    """Return a predicate that is true once the screen shows all given texts.

    The console sends only differences between frames, so searching its bytes would not do.
    """
    screen, fed = Emulator(120, 40), 0

    def shows(*words: str) -> bool:
        nonlocal fed
        whole = max(fed, program.output.rfind(FRAME_END))
        screen.feed(program.output[fed:whole].decode())
        fed = whole
        text = "\n".join(screen.lines())
        return all(each in text for each in words)

    return shows
