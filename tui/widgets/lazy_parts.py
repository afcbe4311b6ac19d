"""A container whose parts are made when it is first shown, since most panes are never opened in a run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

from bot_console.tui.terminal.cache_limits import limit_query_cache
from bot_console.tui.terminal.output import SUPPORTED
from textual.compose import compose  # pyright: ignore[reportUnknownVariableType] -- Textual's App is generic
from textual.containers import Container
from textual.widget import Widget


class LazyParts(Container):
    """A container that composes itself as usual, unless `come_late` was called before it is mounted.

    The parts are then created by `make_parts`, or by the first query for them.
    """

    _late = False
    """Whether `make_parts` makes the parts instead of the mount, even after it has made them."""
    _missing = False

    def __init__(self, *children: Widget, **how: Any) -> None:
        super().__init__(*children, **how)
        limit_query_cache(self)

    @property
    def has_parts(self) -> bool:
        """Whether the parts exist: false before they are made, and while the screen is being dismantled."""
        return bool(self.children) and not self._is_closing

    @property
    def is_ending(self) -> bool:
        """Whether the container is being dismantled with its screen."""
        return self._is_closing or not (self.is_attached if self._missing else self.children)

    @property
    def _is_closing(self) -> bool:
        """Whether the parts are being removed one by one; before the unmount, Textual has no public API for this."""
        private = cast(Any, self)
        return bool(private._closing or private._pruning)

    def come_late(self) -> None:
        """Defer the parts: they are composed by `make_parts` instead of the mount."""
        self._late = self._missing = True

    def make_parts(self) -> None:
        """Make the parts now, unless they exist; the next query finds all of them."""
        if self._missing and self.is_attached and not self._is_closing:
            self._missing = False
            mount_without_layout(self, compose(self))

    async def _compose(self) -> None:
        if not self._late:
            await super()._compose()

    if not TYPE_CHECKING:  # type checkers should see the parent's overloads

        def query(self, *what: Any, **how: Any) -> Any:
            """The matching parts, made if necessary."""
            self.make_parts()
            return super().query(*what, **how)

        def query_one(self, *what: Any, **how: Any) -> Any:
            """The first matching part, made if necessary."""
            self.make_parts()
            return super().query_one(*what, **how)


def mount_without_layout(parent: Widget, widgets: Sequence[Widget]) -> None:
    """Mount widgets and their children in a parent that is not displayed yet, without a layout.

    Textual's own mount would lay out the screen again, and mount nested parts only later.
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
        mount_without_layout(each, within)
