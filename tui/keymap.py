"""The one key table. Footer, help screen, palette and bindings are made from it; a test checks it.

Keys are chosen to survive SSH, tmux and browsers' terminals: letters, digits, Enter, Space, arrows, Escape.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from textual.binding import Binding


@dataclass(frozen=True)
class Key:
    """One action: its keys (any of them, separated by commas), what it does, and whether the footer names it."""

    id: str
    keys: str
    action: str
    text: str
    footer: bool = False
    shown: str = ""
    """How the key is written; empty: as Textual writes it."""
    priority: bool = False
    short: str = ""
    """What the footer says, where `text` is too long for it."""


TABLE: Mapping[str, tuple[Key, ...]] = {
    "app": (
        Key("app.help", "question_mark,f1", "help", "Help for this pane", footer=True, shown="?", short="Help"),
        Key(
            "app.palette",
            "colon,ctrl+p",
            "command_palette",
            "Command palette",
            footer=True,
            shown=":",
            short="Commands",
        ),
        Key(
            "app.stop",
            "exclamation_mark",
            "all_stop",
            "All stop: zero velocity, held",
            footer=True,
            shown="!",
            short="Stop",
        ),
        Key("app.overview", "0", "pane('overview')", "Overview"),
        Key("app.parameters", "1", "pane('parameters')", "Parameters"),
        Key("app.logs", "2", "pane('logs')", "Logs"),
        Key("app.world", "5", "pane('world')", "World"),
        Key("app.next", "tab", "next_pane(1)", "Next pane", priority=True),
        Key("app.previous", "shift+tab", "next_pane(-1)", "Previous pane", priority=True),
        Key("app.zoom", "z", "zoom", "Maximise this pane, and back"),
        Key("app.quit", "q", "quit", "Quit: zero velocity, then end the robot", footer=True, short="Quit"),
        Key("app.quit_now", "ctrl+q,ctrl+c", "quit", "Quit from anywhere", priority=True),
        Key("app.redraw", "ctrl+l", "redraw", "Draw the screen anew"),
    ),
    "parameters": (
        Key(
            "parameters.edit",
            "enter,e",
            "edit",
            "Edit the value; open or close a node",
            footer=True,
            shown="enter",
            short="Edit",
        ),
        Key("parameters.more", "plus,equals_sign", "nudge(1)", "One step up", footer=True, shown="+", short="More"),
        Key("parameters.less", "minus", "nudge(-1)", "One step down", footer=True, shown="-", short="Less"),
        Key("parameters.much_more", "greater_than_sign", "nudge(10)", "Ten steps up", shown=">"),
        Key("parameters.much_less", "less_than_sign", "nudge(-10)", "Ten steps down", shown="<"),
        Key("parameters.default", "d", "reset", "Back to the default"),
        Key("parameters.undo", "u", "undo", "Undo the last change", footer=True, short="Undo"),
        Key("parameters.redo", "U", "redo", "Redo", shown="U"),
        Key("parameters.filter", "slash", "filter", "Filter", footer=True, shown="/"),
        Key("parameters.changed", "c", "toggle_changed", "Only what differs from its default"),
        Key("parameters.hidden", "h", "toggle_built_in", "Show built-in parameters too"),
        Key("parameters.fold", "left", "fold(True)", "Close the node"),
        Key("parameters.unfold", "right", "fold(False)", "Open the node"),
        Key("parameters.fold_all", "C", "fold_all", "Close or open all nodes", shown="C"),
        Key("parameters.copy", "y", "copy", "Copy the ros2 command of this parameter"),
        Key("parameters.save", "s", "save", "Save to a ROS parameter file"),
    ),
    "logs": (
        Key("logs.follow", "f", "follow", "Follow the newest line", footer=True, short="Follow"),
        Key("logs.warnings", "w", "warnings", "Warnings and worse only", footer=True, short="Warnings"),
        Key("logs.level", "v", "level", "Next minimum severity", footer=True, short="Level"),
        Key("logs.filter", "slash", "filter", "Filter", footer=True, shown="/"),
        Key("logs.detail", "enter", "detail", "The whole message", footer=True, short="Message"),
        Key("logs.exclude", "x", "exclude", "Hide this node's lines"),
        Key("logs.all", "escape", "clear_filter", "Take all filters away"),
        Key("logs.next_error", "E", "next_error", "Next error", shown="E"),
        Key("logs.clear", "K", "clear", "Clear the log", shown="K"),
        Key("logs.copy", "y", "copy", "Copy the message"),
        Key("logs.save", "S", "save", "Save the lines shown to a file", shown="S"),
        Key("logs.end", "G,end", "jump_end", "Newest line", shown="G"),
        Key("logs.home", "g,home", "jump_home", "Oldest line", shown="g"),
    ),
    "world": (
        Key("world.in", "plus,equals_sign", "zoom_map(1)", "Zoom in", footer=True, shown="+"),
        Key("world.out", "minus", "zoom_map(-1)", "Zoom out", footer=True, shown="-"),
        Key("world.fit", "f", "fit", "Whole map, or follow the robot", footer=True, short="Fit"),
    ),
    "list": (
        Key("list.up", "up,k", "cursor(-1)", "Up"),
        Key("list.down", "down,j", "cursor(1)", "Down"),
        Key("list.page_up", "pageup", "page(-1)", "Page up"),
        Key("list.page_down", "pagedown", "page(1)", "Page down"),
    ),
}


def bindings(scope: str) -> list[Binding]:
    """The bindings of one scope of the table, for a class's `BINDINGS`."""
    return [
        Binding(
            key.keys,
            key.action,
            key.short or key.text,
            show=key.footer,
            key_display=key.shown or None,
            priority=key.priority,
            id=key.id,
        )
        for key in TABLE[scope]
    ]
