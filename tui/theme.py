"""The console's own theme: dark, calm, with blue for what was taken and orange for what was not."""

from __future__ import annotations

from textual.theme import Theme

DARK = Theme(
    name="bot-dark",
    primary="#6cb6ff",
    secondary="#7d8590",
    accent="#6cb6ff",
    foreground="#d5dbe3",
    background="#11151a",
    surface="#161b22",
    panel="#1d242d",
    success="#57ab9a",
    warning="#e0a458",
    error="#f47067",
    dark=True,
    variables={
        "border": "#2d3742",
        "block-cursor-background": "#2b4a6b",
        "block-cursor-foreground": "#ffffff",
        "footer-key-foreground": "#6cb6ff",
        "input-selection-background": "#2b4a6b",
    },
)
