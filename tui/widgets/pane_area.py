"""The area of the panes: a tree of splits places them, and the mouse moves the borders between them."""

from __future__ import annotations

from bot_console.tui.layout.placing import Border, Box, borders, boxes
from bot_console.tui.layout.tree import Split, Tree, change_at, move_border
from textual.containers import Container
from textual.events import MouseDown, MouseMove, MouseUp
from textual.geometry import NULL_OFFSET, NULL_SPACING, Region, Size
from textual.layout import ArrangeResult, Layout, WidgetPlacement
from textual.message import Message
from textual.widget import Widget


class PanePlaceholder(Container):
    """Stands in for a pane in the first frame: its border and title, without anything that takes keys."""

    def __init__(self, stands_for: str, title: str, *, chosen: bool) -> None:
        """Create the placeholder; `stands_for` is the id of the pane, `chosen` whether that will get the focus."""
        super().__init__(classes="chosen" if chosen else "")
        self.stands_for = stands_for
        self.border_title = title


class TreeLayout(Layout):
    """Places the children whose ids are in a tree."""

    name = "tree"

    def __init__(self) -> None:
        self.tree: Tree = ""

    def arrange(self, parent: Widget, children: list[Widget], size: Size, greedy: bool = True) -> ArrangeResult:
        """Place the children that are in the tree; others are not shown."""
        places = boxes(self.tree, Box(0, 0, size.width, size.height))
        named = [(child.stands_for if isinstance(child, PanePlaceholder) else child.id, child) for child in children]
        return [
            WidgetPlacement(Region(*places[name]), NULL_OFFSET, NULL_SPACING, child)
            for name, child in named
            if name in places
        ]


class PaneArea(Container):
    """Shows the panes of a tree."""

    class Dragged(Message):
        """A border was moved: the resulting tree, and whether this is the first move of the drag."""

        def __init__(self, tree: Tree, first: bool) -> None:
            super().__init__()
            self.tree = tree
            self.first = first

    def __init__(self, *, id: str) -> None:
        super().__init__(id=id)
        self._places = TreeLayout()
        self._dragged: tuple[Border, Tree, int] | None = None
        self._moved = 0

    @property
    def layout(self) -> Layout:
        """The tree layout, which has no name in styles."""
        return self._places

    @property
    def shown(self) -> Tree:
        """The tree that is shown."""
        return self._places.tree

    def place(self, tree: Tree) -> None:
        """Show a tree; exactly its children must be displayed."""
        if tree != self._places.tree:
            self._places.tree = tree
            for child in self.children:
                # Textual caches an arrangement until a child requests another one.
                child.refresh(layout=True)

    def on_mouse_down(self, event: MouseDown) -> None:
        """Grab a border."""
        x, y = event.screen_x - self.region.x, event.screen_y - self.region.y
        for border in borders(self.shown, Box(0, 0, *self.size)):
            if (
                border.box.x <= x < border.box.x + border.box.width
                and border.box.y <= y < border.box.y + border.box.height
            ):
                self._dragged = border, self.shown, x if border.direction == "beside" else y
                self._moved = 0
                self.capture_mouse()
                event.stop()
                return

    def on_mouse_move(self, event: MouseMove) -> None:
        """Move the border with the mouse."""
        if self._dragged is None:
            return
        border, tree, begin = self._dragged
        at = event.screen_x - self.region.x if border.direction == "beside" else event.screen_y - self.region.y
        if at - begin == self._moved:
            return
        first, self._moved = self._moved == 0, at - begin

        def moved(split: Split) -> Tree:
            return move_border(split, border.after, (at - begin) / max(1, border.whole))

        self.post_message(self.Dragged(change_at(tree, border.path, moved), first))

    def on_mouse_up(self, event: MouseUp) -> None:
        """Release the border."""
        if self._dragged is not None:
            self._dragged = None
            self.release_mouse()
