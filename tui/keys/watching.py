"""The part of the key table that is about watching the robot: diagnostics."""

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
}
