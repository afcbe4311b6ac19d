"""The source code of a function that walks a CDR stream, extended field by field."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from bot_console.runtime.rosidl.cdr_layout import Place, nested, row


class Source:
    """The lines, the objects they name, and the position in the stream that they have reached.

    The position is `at` plus a known number of bytes (`ahead`), or only that number while all lengths are known.
    """

    def __init__(
        self, names: dict[str, Any], order: str, place: Place, begin: int | None = None, shift: int = 0
    ) -> None:
        """Start a function at byte `begin`, or at the `at` passed to it; alignment counts `shift` more bytes."""
        self.names = names
        self.place = place
        self._order = order
        self._at, self._ahead = ("at", 0) if begin is None else ("", begin)
        self._shift = shift
        self._lines: list[tuple[str, bool]] = []
        self._locals = 0
        self._holders: dict[Sequence[str], str] = {(): "m"}

    def name(self, character: str, value: object) -> str:
        """Return a name by which the function refers to a value."""
        found = f"{character}{len(self.names)}"
        self.names[found] = value
        return found

    def local(self, character: str) -> str:
        """Return a name for a local variable of the function."""
        self._locals += 1
        return f"{character}{self._locals}"

    def nested(self, cls: object) -> Iterator[tuple[str, str, Any]]:
        """Yield the single nested messages, outer ones first: a local name, the expression it replaces, and the
        class.
        """
        for path, inner in nested(cls):
            expression = self.field(path)
            self._holders[path] = self.local("m")
            yield self._holders[path], expression, inner

    def field(self, path: Sequence[str]) -> str:
        """Return the expression of a field by its path, using the local name of its message."""
        return f"{self._holders[path[:-1]]}._{path[-1]}"

    def line(self, text: str, *, moves: bool = False) -> None:
        """Add a line; one that only moves `at` is dropped if no later line needs that."""
        self._lines.append((text, moves))

    @property
    def there(self) -> str:
        """The position as an expression."""
        return self._expression(self._ahead)

    @property
    def aligned(self) -> str:
        """The position used for alignment, as an expression."""
        return self._expression(self._ahead + self._shift)

    def _expression(self, ahead: int) -> str:
        if not self._at:
            return str(ahead)
        return f"at + {ahead}" if ahead else "at"

    def step(self, length: int) -> None:
        """Advance by a known number of bytes."""
        self._ahead += length
        self.place = self.place.behind(length)

    def leap(self, length: str, place: Place) -> None:
        """Advance by an expression; `place` is what is known about the position after it."""
        self.line(f"at = {self.there} + {length}", moves=True)
        self.land(place)

    def land(self, place: Place) -> None:
        """Continue at the `at` that a line has set; `place` is what is known about it."""
        self._at, self._ahead, self.place = "at", 0, place

    def reach(self) -> None:
        """Set `at` to the position, for lines that need it."""
        if self.there != "at":
            self.line(f"at = {self.there}", moves=True)
            self.land(self.place)

    def row(self, codes: Sequence[str], use: Callable[[str], str]) -> None:
        """Add a line that uses the structure of some numbers, and advance past them."""
        structures, behind = row(codes, self.place, self._order)
        if len(structures) == 1:
            self.line(use(self.name("S", structures[0])))
            self._ahead += structures[0].size
            self.place = behind
        else:
            self.line(f"s = {self.name('S', structures)}[{self.aligned} & 7]")
            self.line(use("s"))
            self.leap("s.size", behind)

    def lines(self) -> Sequence[str]:
        """Return the body of the function."""
        asked = max(
            (number for number, (text, moves) in enumerate(self._lines) if not moves and re.search(r"\bat\b", text)),
            default=-1,
        )
        return [text for number, (text, moves) in enumerate(self._lines) if not moves or number < asked]

    def compiled(self, arguments: str, lines: Sequence[str], title: str) -> Callable[..., Any]:
        """Compile a body into the function `f`."""
        text = "\n".join([f"def f({arguments}):", *("    " + line for line in lines)])
        exec(compile(text, f"<{title}>", "exec"), self.names)
        return self.names["f"]
