"""A screen over the panes, which remain visible, dimmed, around it.

Textual renders everything below through Rich, splits it into lines again and tints it piece by piece, which is most of
the cost of opening the help or a question. Here only the needed lines are requested, and each style is tinted once.
This relies on private parts of Textual, as `output` does.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, cast

from bot_console.tui.terminal.compositor import PartwiseCompositor
from bot_console.tui.terminal.mouse_targets import MouseTargets
from bot_console.tui.terminal.output import SUPPORTED
from rich.segment import Segment
from rich.style import Style
from textual.await_complete import AwaitComplete
from textual.color import Color
from textual.geometry import Region
from textual.renderables.background_screen import BackgroundScreen
from textual.screen import ModalScreen
from textual.strip import Strip


class DimmedScreen(MouseTargets, ModalScreen[None]):
    """A modal screen that composes only changes, and draws the screen below it line by line."""

    _was_dismissed = False
    """Whether it was dismissed while another screen was in front of it."""

    def __init__(self) -> None:
        super().__init__()
        if SUPPORTED:
            self._compositor = PartwiseCompositor()

    def dismiss(self, result: None = None) -> AwaitComplete:
        """Leave the screen once: each call of Textual's own method removes whatever screen is in front.

        Clicks and keys that were under way still reach a screen that has been left, and may dismiss it again. A screen
        that is dismissed while another is in front of it is left as soon as that one has gone.
        """
        if self.is_active:
            return super().dismiss(result)
        self._was_dismissed = True
        return AwaitComplete()

    def on_screen_resume(self) -> None:
        """Leave the screen if it was dismissed meanwhile."""
        if self._was_dismissed:
            self.dismiss()

    def render_lines(self, crop: Region) -> list[Strip]:
        """The lines of a region of the screen's background, without its widgets."""
        below = self._below()
        if below is None:
            return super().render_lines(crop)
        color, base, width = self.styles.background, self.visual_style.rich_style, self.size.width
        filters = self.get_line_filters()
        found: list[Strip] = []
        for strip in below.lines(crop.line_range):
            dimmed = dim(strip, color, base).adjust_cell_length(width, base)
            for each in filters:
                dimmed = dimmed.apply_filter(each, color)
            found.append(dimmed if crop.column_span == (0, width) else dimmed.crop(*crop.column_span))
        return found

    def _below(self) -> PartwiseCompositor | None:
        """The compositor of the screen below; None if that is invisible or composed by Textual."""
        stack: list[Any] = cast(Any, self.app).screen_stack  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
        at = stack.index(self) if self in stack else 0
        if at < 1 or self.styles.background.a == 1:
            return None
        compositor = stack[at - 1]._compositor
        return compositor if isinstance(compositor, PartwiseCompositor) else None


def dim(strip: Strip, color: Color, base: Style) -> Strip:
    """A line behind a translucent colour, without links; `base` is the style of segments without one."""
    segments = [Segment(text, _dimmed(style, color, base)) for text, style, control in strip if not control]
    return Strip(segments, strip.cell_length)


@lru_cache(maxsize=4096)
def _dimmed(style: Style | None, color: Color, base: Style) -> Style:
    dimmed = next(iter(BackgroundScreen.process_segments([Segment(" ", style)], color))).style
    return base + dimmed if dimmed else base
