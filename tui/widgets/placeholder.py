"""The text in the middle of an empty part of a pane: what the part is for, and keys to press next."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import NamedTuple

from bot_console.tui.text.sanitize import sanitize
from textual.widget import Widget

MARGIN_COLUMNS = 2
"""Columns left free on both sides."""
MAX_COLUMNS = 64

Line = tuple[tuple[str, str], ...]
"""Pieces of text with the names of their styles."""


class Placeholder(NamedTuple):
    """A sentence, and keys with their actions."""

    sentence: str = ""
    actions: Sequence[tuple[str, str]] = ()


NO_PLACEHOLDER = Placeholder()
FILTERED_OUT = Placeholder("Nothing matches the filter.", (("esc", "Clear the filter"), ("/", "Change it")))


class WithPlaceholder(Widget):
    """A widget that draws a placeholder while it has nothing else to show."""

    placeholder = NO_PLACEHOLDER

    def show_placeholder(self, placeholder: Placeholder) -> None:
        """Change the placeholder."""
        if placeholder != self.placeholder:
            self.placeholder = placeholder
            self.refresh()


def placeholder_lines(placeholder: Placeholder, width: int, height: int) -> Sequence[Line]:
    """The lines of a placeholder, centred in `width` x `height` cells; keys are left out if they do not fit."""
    columns = min(width - 2 * MARGIN_COLUMNS, MAX_COLUMNS)
    if not placeholder.sentence or columns < 8 or height < 1:
        return ()
    sentence = wrap(sanitize(placeholder.sentence), columns)[:height]
    lines: list[Line] = [((" " * ((width - len(line)) // 2) + line, "dim"),) for line in sentence]
    actions = [each for each in placeholder.actions if len(" ".join(each)) + 1 <= columns]
    if actions and len(lines) + 2 <= height:
        actions = actions[: height - len(lines) - 1]
        key_width = max(len(key) for key, _ in actions)
        block = key_width + 2 + max(len(text) for _, text in actions)
        indent = " " * max(0, (width - block) // 2)
        lines.append(())
        lines += [((f"{indent}{key:>{key_width}}  ", "key"), (text, "")) for key, text in actions]
    return [*[()] * ((height - len(lines)) // 2), *lines]
