"""The part of the app that shows notifications: one at a time, and never as markup."""

from __future__ import annotations

from bot_console.tui.text.sanitize import brief, sanitize
from bot_console.tui.widgets.toast_place import place_toasts
from textual.app import App
from textual.notifications import Notify, SeverityLevel

MAX_NOTIFICATIONS = 5
"""Notifications that are kept; the newest is shown, and those before it once it has gone."""


class NotifyingApp(App[None]):
    """An app whose notifications stand above the status line and leave the row at the cursor free."""

    def notify(
        self,
        message: str,
        *,
        title: str = "",
        severity: SeverityLevel = "information",
        timeout: float | None = None,
        markup: bool = False,
    ) -> None:
        """Show a notification; the text of nodes and people is never parsed as markup."""
        super().notify(brief(message), title=sanitize(title), severity=severity, timeout=timeout, markup=False)

    def on_notify(self, event: Notify) -> None:
        """Make room for a notification, and say in it how many others there are."""
        others = len(self._notifications)
        if others >= MAX_NOTIFICATIONS:
            self.clear_notifications()
        if others:
            event.notification.message += f"  +{others} more"
        if self.screen_stack:
            place_toasts(self.screen, another=True)

    def update_notifications(self) -> None:
        """Show the newest one that is left, and follow the cursor; called ten times a second."""
        if len(self._notifications):
            place_toasts(self.screen)
