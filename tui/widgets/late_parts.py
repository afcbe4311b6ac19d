"""A container whose parts are made when it is first shown: most panes of a run are never looked at."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

from bot_console.tui.terminal.composing.cache_limits import limit_query_cache
from bot_console.tui.terminal.output import SUPPORTED
from textual.compose import compose  # pyright: ignore[reportUnknownVariableType] -- Textual's App is generic
from textual.containers import Container
from textual.widget import Widget


class LateParts(Container):
    """Composes itself as any container does, unless `come_late` was called before it is mounted.

    Whoever asks for one of its parts gets it: they are made then at the latest.
    """

    _late = False
    """Whether the parts come by `make_parts`, also when that was before the mount is over."""
    _missing = False

    def __init__(self, *children: Widget, **how: Any) -> None:
        super().__init__(*children, **how)
        limit_query_cache(self)

    @property
    def has_parts(self) -> bool:
        """Whether the parts are there; false before they are made, and at the end, when the screen is taken apart."""
        return bool(self.children)

    @property
    def is_ending(self) -> bool:
        """Whether the screen is taken apart, and this with it."""
        return not (self.is_attached if self._missing else self.children)

    def come_late(self) -> None:
        """Make no parts yet. They are not composed by the mount, but by `make_parts`."""
        self._late = self._missing = True

    def make_parts(self) -> None:
        """Make the parts now, if they are not there yet: what is asked of them next finds all of them in place."""
        private = cast(Any, self)
        if self._missing and self.is_attached and not (private._closing or private._pruning):
            self._missing = False
            put(self, compose(self))

    async def _compose(self) -> None:
        if not self._late:
            await super()._compose()

    if not TYPE_CHECKING:  # the parent's many signatures are those that count

        def query(self, *what: Any, **how: Any) -> Any:
            """The parts that match, made if need be."""
            self.make_parts()
            return super().query(*what, **how)

        def query_one(self, *what: Any, **how: Any) -> Any:
            """The first part that matches, made if need be."""
            self.make_parts()
            return super().query_one(*what, **how)


def put(parent: Widget, widgets: Sequence[Widget]) -> None:
    """Put widgets into a parent that is not displayed yet, with what was given to them; nothing is laid out for it.

    Textual's own mount lays the screen out a second time, and lets the parts within parts come a little later.
    """
    if not widgets:
        return
    if not SUPPORTED:
        parent.mount_all(widgets)
        return
    cast(Any, parent.app)._register(parent, *widgets)  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
    for each in widgets:
        given: list[Widget] = cast(Any, each)._pending_children
        within, given[:] = [*given], []
        put(each, within)
