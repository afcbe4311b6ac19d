"""Logs what launched processes report about themselves."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from bot_console.runtime.process import on_notice
from bot_console.runtime.process.reported_facts import on_fact
from bot_console.tui.console.model import Severity
from bot_console.tui.console.parameters.provenance import Learn

if TYPE_CHECKING:
    from bot_console.runtime.process.roles import Warned
    from launch.child import News

Printed = Callable[[int, str, str], None]


def log_process_reports(printed: Printed, learn: Learn) -> Callable[[], None]:
    """Log notices and crashes of all processes, threads of this one or not, and pass on the facts that they report.

    Returns a function that ends the reporting.
    """
    from launch.child import on_news  # ROS names can only be imported in a composed program

    def noticed(process: Warned, text: str) -> None:
        printed(Severity.WARN, process.name, text)

    def heard(news: News) -> None:
        if news.kind == "notice":
            printed(Severity.WARN, news.process, str(news.facts["text"]))
        elif news.kind == "crash":
            printed(Severity.ERROR, news.process, str(news.facts["text"]))
        elif news.kind in ("declared", "given"):
            learn(news.kind, news.facts)

    forget = (on_notice(noticed), on_news(heard), on_fact(learn))

    def forget_all() -> None:
        for each in forget:
            each()

    return forget_all
