"""The one key table. Footer, help screen, palette and bindings are made from it; a test checks it.

Keys are chosen to survive SSH, tmux and browsers' terminals: letters, digits, Enter, Space, arrows, Escape.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from textual.binding import Binding, BindingType


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
            "palette",
            "Command palette",
            footer=True,
            shown=":",
            short="Commands",
        ),
        Key(
            "app.stop",
            "exclamation_mark",
            "all_stop",
            "All stop: the robot is locked; or released again",
            footer=True,
            shown="!",
            short="Stop",
        ),
        Key("app.overview", "0", "pane('overview')", "Overview"),
        Key("app.parameters", "1", "pane('parameters')", "Parameters"),
        Key("app.logs", "2", "pane('logs')", "Logs"),
        Key("app.graph", "3", "pane('graph')", "Node graph"),
        Key("app.plot", "4", "pane('plot')", "Plot"),
        Key("app.world", "5", "pane('world')", "World"),
        Key("app.steering", "6", "pane('steering')", "Steering"),
        Key("app.profiles", "7", "pane('profiles')", "Profiles"),
        Key("app.launch", "8", "pane('launch')", "Launch"),
        Key("app.next", "tab", "next_pane(1)", "Next pane", priority=True),
        Key("app.previous", "shift+tab", "next_pane(-1)", "Previous pane", priority=True),
        Key("app.zoom", "z", "zoom", "Maximise this pane, and back"),
        Key(
            "app.quit",
            "q",
            "quit",
            "Quit: ask where values would be lost, then end the robot",
            footer=True,
            short="Quit",
        ),
        Key("app.quit_now", "ctrl+q,ctrl+c", "quit", "Quit from anywhere; twice: at once", priority=True),
        Key("app.acknowledge", "ctrl+e", "acknowledge", "Acknowledge the errors: count only those that come"),
        Key("app.redraw", "ctrl+l", "redraw", "Draw the screen anew"),
    ),
    "parameters": (
        Key(
            "parameters.edit",
            "enter",
            "edit",
            "Edit the value, an array element by element; open or close a node",
            footer=True,
            short="Edit",
        ),
        Key("parameters.edit_text", "e", "edit_text", "Edit the value as text, an array on one line"),
        Key("parameters.more", "plus,equals_sign", "nudge(1)", "One step up", footer=True, shown="+", short="More"),
        Key("parameters.less", "minus", "nudge(-1)", "One step down", footer=True, shown="-", short="Less"),
        Key("parameters.much_more", "greater_than_sign", "nudge(10)", "Ten steps up", shown=">"),
        Key("parameters.much_less", "less_than_sign", "nudge(-10)", "Ten steps down", shown="<"),
        Key("parameters.default", "d", "reset", "Back to the start value"),
        Key("parameters.undo", "u", "undo", "Undo the last change", footer=True, short="Undo"),
        Key("parameters.redo", "U", "redo", "Redo", shown="U"),
        Key("parameters.filter", "slash", "filter", "Filter", footer=True, shown="/"),
        Key("parameters.all", "escape", "clear", "Take the mark of a refused value away, or else the filter"),
        Key("parameters.changed", "c", "toggle_changed", "Only what differs from its start value"),
        Key("parameters.hidden", "h", "toggle_built_in", "Show built-in parameters too"),
        Key("parameters.fold", "left", "fold(True)", "Close the node"),
        Key("parameters.unfold", "right", "fold(False)", "Open the node"),
        Key("parameters.fold_all", "C", "fold_all", "Close or open all nodes", shown="C"),
        Key("parameters.dismiss", "x", "dismiss", "Take the mark of a refused value away"),
        Key("parameters.plot", "p", "plot", "Plot this parameter"),
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
    ),
    "world": (
        Key("world.in", "plus,equals_sign", "zoom_map(1)", "Zoom in", footer=True, shown="+"),
        Key("world.out", "minus", "zoom_map(-1)", "Zoom out", footer=True, shown="-"),
        Key("world.fit", "f", "fit", "Whole map, or follow the robot", footer=True, short="Fit"),
    ),
    "graph": (
        Key("graph.detail", "enter", "detail", "All about this node or topic", footer=True, short="Details"),
        Key("graph.mode", "m", "mode", "Topics in use, all topics, or nodes only", footer=True, short="Mode"),
        Key("graph.filter", "slash", "filter", "Filter", footer=True, shown="/"),
        Key(
            "graph.debug",
            "D",
            "hide('debug')",
            "Show debug topics and hidden nodes",
            footer=True,
            shown="D",
            short="Debug",
        ),
        Key("graph.sinks", "d", "hide('dead_sinks')", "Hide topics that nobody listens to"),
        Key("graph.leaves", "L", "hide('leaves')", "Hide topics with a single connection", shown="L"),
        Key("graph.turn", "o", "turn_picture", "Arrows to the right, down, or as it fits"),
        Key("graph.all", "escape", "clear_filter", "Take the filter away"),
        Key("graph.export", "e", "export", "Export as text, Mermaid or DOT"),
    ),
    "plot": (
        Key("plot.add", "a", "add", "Add a curve: /topic/field or /node:parameter", footer=True, short="Add"),
        Key("plot.remove", "x", "remove", "Remove the selected curve", footer=True, short="Remove"),
        Key("plot.remove_all", "X", "remove_all", "Remove all curves", shown="X"),
        Key("plot.pause", "space", "pause", "Pause the picture; data go on coming", footer=True, short="Pause"),
        Key("plot.longer", "minus", "window(1)", "Longer time window", footer=True, shown="-", short="Longer"),
        Key(
            "plot.shorter",
            "plus,equals_sign",
            "window(-1)",
            "Shorter time window",
            footer=True,
            shown="+",
            short="Shorter",
        ),
        Key("plot.form", "f", "form", "Framed plot, or one strip for each curve", footer=True, short="Form"),
        Key("plot.limits", "y", "limits", "Limits of the value axis: automatic or given"),
        Key("plot.back", "left,h", "shift(-1)", "Back in time, while paused"),
        Key("plot.forth", "right,l", "shift(1)", "Forth in time, while paused"),
        Key("plot.up", "up,k", "choose(-1)", "Previous curve"),
        Key("plot.down", "down,j", "choose(1)", "Next curve"),
        Key("plot.clear", "K", "clear", "Forget what has been drawn so far", shown="K"),
        Key("plot.csv", "e", "export", "Export the samples as CSV"),
        Key("plot.picture", "S", "picture", "Save the picture as text or HTML", shown="S"),
    ),
    "steering": (
        Key("steering.arm", "enter", "arm", "Arm, or disarm", footer=True, short="Arm"),
        Key("steering.stop", "space", "zero", "Stop: zero velocity", footer=True, short="Stop"),
        Key("steering.faster", "w,up", "steer(1,0,1)", "Faster", footer=True, shown="w"),
        Key("steering.slower", "s,down", "steer(-1,0,1)", "Slower", footer=True, shown="s"),
        Key("steering.left", "a,left", "steer(0,1,1)", "Turn left", footer=True, shown="a", short="Left"),
        Key("steering.right", "d,right", "steer(0,-1,1)", "Turn right", footer=True, shown="d", short="Right"),
        Key("steering.much_faster", "W,shift+up", "steer(1,0,10)", "Much faster", shown="W"),
        Key("steering.much_slower", "S,shift+down", "steer(-1,0,10)", "Much slower", shown="S"),
        Key("steering.hard_left", "A,shift+left", "steer(0,1,10)", "Turn hard left", shown="A"),
        Key("steering.hard_right", "D,shift+right", "steer(0,-1,10)", "Turn hard right", shown="D"),
        Key("steering.no_speed", "x", "zero_axis(0)", "Zero linear velocity"),
        Key("steering.no_turn", "c", "zero_axis(1)", "Zero angular velocity"),
        Key("steering.deadman", "t", "deadman", "Dead-man time: seconds without a key until the robot stops"),
        Key("steering.hand_back", "h", "hand_back", "Hand back: the robot's own program drives again"),
        Key("steering.disarm", "escape", "disarm", "Disarm: the robot stands, locked, until it is handed back"),
    ),
    "profiles": (
        Key(
            "profiles.apply",
            "a,enter",
            "apply(False)",
            "Apply: set the values live",
            footer=True,
            shown="a",
            short="Apply",
        ),
        Key(
            "profiles.world",
            "w",
            "apply(True)",
            "Apply, and reset the simulator into the profile's world",
            footer=True,
            short="Apply+world",
        ),
        Key("profiles.again", "r", "again", "Work the differences out anew", footer=True, short="Refresh"),
        Key("profiles.undo", "u", "undo", "Undo the last change"),
        Key("profiles.scroll_down", "right,l,space", "scroll(1)", "Scroll the differences down"),
        Key("profiles.scroll_up", "left,h", "scroll(-1)", "Scroll the differences up"),
    ),
    "launch": (
        Key("launch.open", "o", "open", "Open a launch file", footer=True, short="Open"),
        Key("launch.start", "s", "do('start')", "Start the process again", footer=True, short="Start"),
        Key("launch.stop", "x", "do('stop')", "Stop the process, as Ctrl-C does", footer=True, short="Stop"),
        Key("launch.restart", "r", "do('restart')", "Restart the process", footer=True, short="Restart"),
        Key("launch.kill", "K", "do('kill')", "Kill the process at once", footer=True, shown="K", short="Kill"),
        Key(
            "launch.detail",
            "enter",
            "detail",
            "All about this process; open or close a group",
            footer=True,
            short="Details",
        ),
        Key("launch.timeline", "t", "timeline", "All launch events"),
        Key("launch.fold", "left,h", "fold(True)", "Close the group"),
        Key("launch.unfold", "right,l", "fold(False)", "Open the group"),
    ),
    "diagram": (
        Key("diagram.up", "up,k", "select(0,-1)", "Select above"),
        Key("diagram.down", "down,j", "select(0,1)", "Select below"),
        Key("diagram.left", "left,h", "select(-1,0)", "Select to the left"),
        Key("diagram.right", "right,l", "select(1,0)", "Select to the right"),
        Key("diagram.scroll_up", "shift+up,pageup", "scroll_picture(0,-1)", "Scroll up"),
        Key("diagram.scroll_down", "shift+down,pagedown", "scroll_picture(0,1)", "Scroll down"),
        Key("diagram.scroll_left", "shift+left,home", "scroll_picture(-1,0)", "Scroll left"),
        Key("diagram.scroll_right", "shift+right,end", "scroll_picture(1,0)", "Scroll right"),
    ),
    "list": (
        Key("list.up", "up,k", "cursor(-1)", "Up"),
        Key("list.down", "down,j", "cursor(1)", "Down"),
        Key("list.page_up", "pageup", "page(-1)", "Page up"),
        Key("list.page_down", "pagedown", "page(1)", "Page down"),
        Key("list.home", "g,home", "end(-1)", "First row"),
        Key("list.end", "G,end", "end(1)", "Last row", shown="G"),
    ),
    "broken": (Key("broken.reopen", "enter,r", "reopen", "Open the pane again", footer=True, short="Open again"),),
    "overlay": (
        Key("overlay.close", "escape,enter,q", "dismiss", "Close"),
        Key("overlay.stop", "exclamation_mark", "app.all_stop", "All stop", shown="!"),
        Key("overlay.up", "up,k", "scroll_box(-1)", "Up"),
        Key("overlay.down", "down,j", "scroll_box(1)", "Down"),
        Key("overlay.page_up", "pageup", "page_box(-1)", "Page up"),
        Key("overlay.page_down", "pagedown", "page_box(1)", "Page down"),
        Key("overlay.home", "g,home", "end_of_box(-1)", "To the top"),
        Key("overlay.end", "G,end", "end_of_box(1)", "To the bottom", shown="G"),
    ),
    "help": (Key("help.close", "question_mark,f1", "dismiss", "Close"),),
    "question": (Key("question.give_up", "escape", "give_up", "Close without an answer"),),
    "confirm": (
        Key("confirm.yes", "y", "yes", "Yes"),
        Key("confirm.no", "n,q", "give_up", "No"),
        Key("confirm.stop", "exclamation_mark", "app.all_stop", "All stop", shown="!"),
    ),
    "elements": (
        Key("elements.edit", "enter,e", "edit", "Edit the element"),
        Key("elements.insert", "i,insert", "insert(0)", "Insert an element before this one"),
        Key("elements.append", "a", "insert(1)", "Add an element behind this one"),
        Key("elements.delete", "d,delete", "delete", "Delete the element"),
        Key("elements.earlier", "K,shift+up", "move(-1)", "Move the element up", shown="K"),
        Key("elements.later", "J,shift+down", "move(1)", "Move the element down", shown="J"),
        Key("elements.undo", "u", "undo", "Undo the last change of the list"),
        Key("elements.take", "s", "take", "Set the array as it is here"),
        Key("elements.give_up", "escape,q", "leave", "Close; what was changed is dropped"),
        Key("elements.stop", "exclamation_mark", "app.all_stop", "All stop", shown="!"),
    ),
    "picker": (
        Key("picker.down", "down", "move(1)", "Down", priority=True),
        Key("picker.up", "up", "move(-1)", "Up", priority=True),
        Key("picker.page_down", "pagedown", "move(10)", "Page down", priority=True),
        Key("picker.page_up", "pageup", "move(-10)", "Page up", priority=True),
    ),
    "form": (
        Key("form.next", "down,tab", "step(1)", "Next argument", priority=True),
        Key("form.previous", "up,shift+tab", "step(-1)", "Previous argument", priority=True),
        Key("form.choice", "ctrl+n,pagedown", "choice(1)", "Next choice", priority=True),
        Key("form.choice_back", "pageup", "choice(-1)", "Previous choice", priority=True),
    ),
}


def bindings(scope: str) -> list[BindingType]:
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


NAMES = {
    "question_mark": "?",
    "colon": ":",
    "exclamation_mark": "!",
    "slash": "/",
    "plus": "+",
    "equals_sign": "=",
    "minus": "-",
    "greater_than_sign": ">",
    "less_than_sign": "<",
    "escape": "esc",
    "up": "↑",
    "down": "↓",
    "left": "←",
    "right": "→",
}


def key_text(key: Key, most: int = 9) -> str:
    """The keys of an action, at most so many, as they are written on the keyboard."""
    return " ".join(_written(each) for each in key.keys.split(",")[:most])


def _written(key: str) -> str:
    shift = "⇧" if key.startswith("shift+") else ""
    name = key.removeprefix("shift+")
    return shift + NAMES.get(name, name.replace("ctrl+", "^"))
