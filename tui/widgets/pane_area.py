"""The area of the panes: the tree of splits places them, and borders are moved with the mouse."""

from __future__ import annotations

from bot_console.tui.layout.placing import Border, Box, borders, boxes
from bot_console.tui.layout.tree import Split, Tree, change_at, move_border
from bot_console.tui.widgets.coming_pane import ComingPane
from textual.containers import Container
from textual.events import MouseDown, MouseMove, MouseUp
from textual.geometry import NULL_OFFSET, NULL_SPACING, Region, Size
from textual.layout import ArrangeResult, Layout, WidgetPlacement
from textual.message import Message
from textual.widget import Widget


class TreeLayout(Layout):
    """Puts the children whose ids are in a tree where it says."""

    name = "tree"

    def __init__(self) -> None:
        self.tree: Tree = ""

    def arrange(self, parent: Widget, children: list[Widget], size: Size, greedy: bool = True) -> ArrangeResult:
        """A place for each child that the tree has."""
        places = boxes(self.tree, Box(0, 0, size.width, size.height))
        named = [(child.stands_for if isinstance(child, ComingPane) else child.id, child) for child in children]
        return [
            WidgetPlacement(Region(*places[name]), NULL_OFFSET, NULL_SPACING, child)
            for name, child in named
            if name in places
        ]


class PaneArea(Container):
    """Shows the panes of a tree."""

    class Dragged(Message):
        """A border was moved: the tree that comes of it, and whether it is the first of this drag."""

        def __init__(self, tree: Tree, first: bool) -> None:
            super().__init__()
            self.tree = tree
            self.first = first

    def __init__(self, *children: Widget, id: str | None = None) -> None:
        super().__init__(*children, id=id)
        self._places = TreeLayout()
        self._dragged: tuple[Border, Tree, int] | None = None
        self._moved = 0

    @property
    def layout(self) -> Layout:
        """The tree's, which no style names."""
        return self._places

    @property
    def shown(self) -> Tree:
        """What is shown."""
        return self._places.tree

    def place(self, tree: Tree) -> None:
        """Show a tree; the children that it has must be displayed, and no others."""
        if tree != self._places.tree:
            self._places.tree = tree
            for child in self.children:
                # Textual keeps an arrangement until a child wants another one.
                child.refresh(layout=True)

    def on_mouse_down(self, event: MouseDown) -> None:
        """Take hold of a border."""
        x, y = event.screen_x - self.region.x, event.screen_y - self.region.y
        for border in borders(self.shown, Box(0, 0, *self.size)):
            if (
                border.box.x <= x < border.box.x + border.box.width
                and border.box.y <= y < border.box.y + border.box.height
            ):
                self._dragged = border, self.shown, x if border.way == "beside" else y
                self._moved = 0
                self.capture_mouse()
                event.stop()
                return

    def on_mouse_move(self, event: MouseMove) -> None:
        """Move the border with the mouse."""
        if self._dragged is None:
            return
        border, tree, begin = self._dragged
        at = event.screen_x - self.region.x if border.way == "beside" else event.screen_y - self.region.y
        if at - begin == self._moved:
            return
        first, self._moved = self._moved == 0, at - begin

        def moved(split: Split) -> Tree:
            return move_border(split, border.after, (at - begin) / max(1, border.whole))

        self.post_message(self.Dragged(change_at(tree, border.path, moved), first))

    def on_mouse_up(self, event: MouseUp) -> None:
        """Let go."""
        if self._dragged is not None:
            self._dragged = None
            self.release_mouse()
