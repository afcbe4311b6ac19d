"""The key table for watching the robot: diagnostics, alarms, images."""

from __future__ import annotations

from bot_console.tui.keys.key import Key

WATCHING: dict[str, tuple[Key, ...]] = {
    "diagnostics": (
        Key("diagnostics.open", "enter", "open", "All about this status; open or close", footer=True, short="Details"),
        Key("diagnostics.bad", "w", "bad_only", "Only what is not OK, or all", footer=True, short="Not OK"),
        Key("diagnostics.fold", "left,h", "fold(True)", "Close what stands below, or what it stands in"),
        Key("diagnostics.unfold", "right,l", "fold(False)", "Open what stands below"),
        Key("diagnostics.fold_all", "C", "fold_all", "Close all, or open all", shown="C"),
    ),
    "alarms": (
        Key("alarms.add", "a", "add", "Add an alarm", footer=True, short="Add"),
        Key("alarms.edit", "enter,e", "edit", "Edit name and condition", footer=True, short="Edit"),
        Key("alarms.delete", "d,delete", "delete", "Take the alarm away", footer=True, short="Delete"),
        Key("alarms.bell", "b", "bell", "Ring the terminal's bell, too, or not", footer=True, short="Bell"),
        Key("alarms.plot", "p", "plot", "Plot what it looks at"),
    ),
    "images": (
        Key("images.topic", "t,enter", "topic", "Another topic", footer=True, short="Topic"),
        Key("images.next", "n", "next", "The next topic", footer=True, short="Next"),
        Key("images.freeze", "space", "freeze", "Freeze the picture, or let it go on", footer=True, short="Freeze"),
        Key("images.letters", "g", "letters", "Greys as letters, or half-blocks in colour", short="Letters"),
        Key("images.faster", "plus,equals_sign", "rate(2)", "Twice as many pictures per second", shown="+"),
        Key("images.slower", "minus", "rate(0.5)", "Half as many pictures per second", shown="-"),
        Key("images.copy", "y", "copy", "Copy the ros2 command"),
    ),
}
