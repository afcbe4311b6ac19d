"""Questions that many panes share: a filter, or the name of a file."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.files.save_file import NotSaved, typed_path
from bot_console.tui.widgets.prompt.question import Line


def filter_problem(text: str) -> str:
    """Why a filter is invalid; empty if it is valid."""
    try:
        parse(text)
    except ValueError as error:
        return str(error)
    return ""


def filter_line(words: str, apply: Callable[[str], object], then: Callable[[str], object]) -> Line:
    """Ask for a filter, applied while it is typed; `then` is called with the final one; cancelling removes it."""
    return Line("filter", then, given_up=lambda: apply(""), text=words, check=filter_problem, typed=apply)


def file_line(label: str, name: str, then: Callable[[str], object]) -> Line:
    """Ask for the name of a file to write."""
    return Line(label, then, text=name, check=path_problem)


def path_problem(text: str) -> str:
    """Why a text cannot be a file path; empty if it can."""
    try:
        typed_path(text)
    except NotSaved as error:
        return str(error)
    return ""
