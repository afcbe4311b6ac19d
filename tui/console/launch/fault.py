"""Explains why a launch file cannot be run, in one message with file and line."""

from __future__ import annotations

import re
import traceback
from collections.abc import Callable, Iterable, Iterator, Sequence
from difflib import get_close_matches
from typing import Any, TypeAlias

from bot_console.tui.console.user_code import library_folders

ENDLESS = "launch files include each other endlessly"


Place: TypeAlias = "tuple[str, int | None]"
"""A file, and the line in it if known."""


def fault_text(
    error: BaseException, path: str, file_of: Callable[[Any], str] = lambda entity: "", *, reading: bool = False
) -> str:
    """The message for an error of a launch, with its place.

    `path` is the requested launch file; `reading` says that no other file had been read yet; `file_of` returns the file
    that contains an entity. The embedded launch records on the exception what it was doing. With another launch, the
    place comes from the user's lines in the traceback or from the parser's message.
    """
    causes = list(_causes(error))
    error = causes[-1]
    if isinstance(error, SyntaxError) and error.filename:
        return _with_place((error.filename, error.lineno), f"syntax error: {error.msg}")
    own = _user_line(error)
    if isinstance(error, RecursionError):
        return _with_place(own or _include_line(causes) or (path, None), ENDLESS)
    place = own or _recorded_place(causes, file_of) or (path, _parser_line(error) if reading else None)
    named = own and not _is_missing_package(error)
    return _with_place(place, f"{type(error).__name__}: {error}" if named else _text(error))


def _text(error: BaseException) -> str:
    """The message of an error raised by launch or a parser."""
    if _is_missing_package(error):
        return _missing_package_text(str(error.args[0]))
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    problem = getattr(error, "problem", None)  # set by a YAML parser
    text = str(problem or (error.args[0] if isinstance(error, KeyError) and error.args else error))
    return " ".join(text.split()) or type(error).__name__


def _is_missing_package(error: BaseException) -> bool:
    from ament_index_python.packages import PackageNotFoundError

    return isinstance(error, PackageNotFoundError) and bool(error.args)


def _missing_package_text(message: str) -> str:
    """The message for a package that was not found, with a remedy."""
    from ament_index_python.packages import get_packages_with_prefixes

    text = message.partition(", searching:")[0]
    name = re.search("'([^']*)'", text)
    similar = get_close_matches(name[1] if name else "", list(get_packages_with_prefixes()), 3)
    return f"{text}; " + (
        f"did you mean {' or '.join(similar)}?" if similar else "is its workspace given with --workspace?"
    )


def _with_place(place: Place, text: str) -> str:
    file, line = place
    return f"{file}, line {line}: {text}" if line else f"{file}: {text}"


def _causes(error: BaseException) -> Iterator[BaseException]:
    """An error, then that of the parser for the file's extension; other parsers merely tried to read the file."""
    from launch.invalid_launch_file_error import InvalidLaunchFileError

    yield error
    if isinstance(error, InvalidLaunchFileError) and error.__cause__ is not None:
        yield from _causes(error.__cause__)


def _user_line(error: BaseException) -> Place | None:
    """The innermost traceback line that belongs neither to launch nor to a library."""
    libraries = library_folders()
    lines = [
        (frame.filename, frame.lineno)
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.lineno and not frame.filename.startswith(("<", *libraries))
    ]
    return lines[-1] if lines else None


def _parser_line(error: BaseException) -> int | None:
    """The line at which a YAML or XML parser stopped."""
    mark: Any = getattr(error, "problem_mark", None)
    position: Any = getattr(error, "position", None)
    if mark is not None:
        return mark.line + 1
    return None if position is None else position[0]


def _recorded_place(causes: Sequence[BaseException], file_of: Callable[[Any], str]) -> Place | None:
    """The place that launch recorded on the innermost error; a line in a library is replaced by the launch file that
    caused it.
    """
    for reported in _launch_places(reversed(causes)):
        if reported.file and not (reported.entity is not None and reported.file.startswith(library_folders())):
            return reported.file, reported.line
        file = "" if reported.entity is None else file_of(reported.entity)
        if file:
            return file, None
    return None


def _include_line(causes: Sequence[BaseException]) -> Place | None:
    """The line of the include that was being executed."""
    return next(((reported.file, reported.line) for reported in _launch_places(causes) if reported.line), None)


def _launch_places(errors: Iterable[BaseException]) -> Iterator[Any]:
    """The `launch.launch_place.LaunchPlace` of each error that has one."""
    return (each for each in (getattr(error, "launch_place", None) for error in errors) if each is not None)
