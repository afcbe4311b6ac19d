"""The console's themes: blue for accepted values and orange for refused ones, on every background."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from textual.theme import Theme


def _theme(
    name: str, dark: bool, colours: Mapping[str, str], curves: tuple[str, ...], *, ansi: bool = False, **variables: str
) -> Theme:
    named = {f"curve-{number}": colour for number, colour in enumerate(curves)}
    own = {key.replace("_", "-"): value for key, value in variables.items()}
    return Theme(name=f"bot-{name}", dark=dark, ansi=ansi, variables={**named, **own}, **dict[str, Any](colours))


DARK = _theme(
    "dark",
    True,
    {
        "primary": "#6cb6ff",
        "secondary": "#7d8590",
        "accent": "#6cb6ff",
        "foreground": "#d5dbe3",
        "background": "#11151a",
        "surface": "#161b22",
        "panel": "#1d242d",
        "success": "#57ab9a",
        "warning": "#e0a458",
        "error": "#f47067",
    },
    ("#6cb6ff", "#e0a458", "#57ab9a", "#dcbdfb", "#f47067", "#c6d166"),
    border="#2d3742",
    block_cursor_background="#2b4a6b",
    block_cursor_foreground="#ffffff",
    footer_key_foreground="#6cb6ff",
    input_selection_background="#2b4a6b",
)

LIGHT = _theme(
    "light",
    False,
    {
        "primary": "#0b5cad",
        "secondary": "#5b6672",
        "accent": "#0b5cad",
        "foreground": "#1b2128",
        "background": "#f4f6f8",
        "surface": "#ffffff",
        "panel": "#e6eaee",
        "success": "#0f6b57",
        "warning": "#8a5200",
        "error": "#b3261e",
    },
    ("#0b5cad", "#a35f00", "#0f6b57", "#7a3fb3", "#b3261e", "#5d6a00"),
    border="#b8c2cc",
    block_cursor_background="#bcd9f7",
    block_cursor_foreground="#0b1622",
    footer_key_foreground="#0b5cad",
    input_selection_background="#bcd9f7",
)

HIGH_CONTRAST = _theme(
    "high-contrast",
    True,
    {
        "primary": "#66d9ff",
        "secondary": "#c8c8c8",
        "accent": "#ffff00",
        "foreground": "#ffffff",
        "background": "#000000",
        "surface": "#000000",
        "panel": "#1a1a1a",
        "success": "#5dff9b",
        "warning": "#ffd000",
        "error": "#ff8080",
    },
    ("#66d9ff", "#ffd000", "#5dff9b", "#ff9dff", "#ff8080", "#ffffff"),
    border="#ffffff",
    block_cursor_background="#ffff00",
    block_cursor_foreground="#000000",
    footer_key_foreground="#ffff00",
    input_selection_background="#0050a0",
)

TERMINAL = _theme(
    "terminal",
    True,
    {
        "primary": "ansi_bright_blue",
        "secondary": "ansi_bright_black",
        "accent": "ansi_bright_blue",
        "foreground": "ansi_default",
        "background": "ansi_default",
        "surface": "ansi_default",
        "panel": "ansi_default",
        "success": "ansi_green",
        "warning": "ansi_yellow",
        "error": "ansi_red",
    },
    ("ansi_bright_blue", "ansi_yellow", "ansi_green", "ansi_magenta", "ansi_red", "ansi_cyan"),
    ansi=True,
    border="ansi_bright_black",
    block_cursor_background="ansi_blue",
    block_cursor_foreground="ansi_bright_white",
    footer_key_foreground="ansi_bright_blue",
    input_selection_background="ansi_blue",
    input_selection_foreground="ansi_bright_white",
    input_cursor_background="ansi_white",
    input_cursor_foreground="ansi_black",
    screen_selection_background="ansi_blue",
    screen_selection_foreground="ansi_bright_white",
    ansi_background="ansi_default",
    ansi_foreground="ansi_default",
)
"""Uses the terminal's own sixteen colours, on its own background."""

THEMES: Mapping[str, Theme] = {
    "dark": DARK,
    "light": LIGHT,
    "high-contrast": HIGH_CONTRAST,
    "terminal": TERMINAL,
}
