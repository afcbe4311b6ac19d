"""Why a launch file cannot be run, as one message with file and line."""

from __future__ import annotations

import re
import traceback
from collections.abc import Callable, Iterator, Sequence
from types import FrameType, TracebackType
from typing import Any, TypeAlias

from bot_console.tui.console.user_code import library_folders

ENDLESS = "launch files include each other without end"


Place: TypeAlias = "tuple[str, int | None]"
"""A file, and the line in it where that is known."""


def fault_text(error: BaseException, path: str, file_of: Callable[[Any], str] = lambda entity: "") -> str:
    """What went wrong and where; `path` is the launch file that was asked for, `file_of` knows where entities stand."""
    causes = list(_causes(error))
    error = causes[-1]
    if isinstance(error, SyntaxError) and error.filename:
        return _at((error.filename, error.lineno), f"syntax error: {error.msg}")
    own = _user_line(error)
    entity = _entity_line(causes, file_of)
    if isinstance(error, RecursionError):
        return _at(own or entity or (path, None), ENDLESS)
    place = own or _file_line(causes) or entity or (path, None)
    named = own and not _is_missing_package(error)
    return _at(place, f"{type(error).__name__}: {error}" if named else _text(error))


def _text(error: BaseException) -> str:
    """The words of an error that launch or a parser has found."""
    if _is_missing_package(error):
        return _no_package(str(error.args[0]))
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    problem = getattr(error, "problem", None)  # of a YAML parser
    text = str(problem or (error.args[0] if isinstance(error, KeyError) and error.args else error))
    return " ".join(text.split()) or type(error).__name__


def _is_missing_package(error: BaseException) -> bool:
    from ament_index_python.packages import PackageNotFoundError

    return isinstance(error, PackageNotFoundError) and bool(error.args)


def _no_package(said: str) -> str:
    """A package that was not found, and what to do."""
    from difflib import get_close_matches

    from ament_index_python.packages import get_packages_with_prefixes

    text = said.partition(", searching:")[0]
    name = re.search("'([^']*)'", text)
    similar = get_close_matches(name[1] if name else "", list(get_packages_with_prefixes()), 3)
    return f"{text}; " + (f"is it {' or '.join(similar)}?" if similar else "is its workspace given with --workspace?")


def _at(place: Place, text: str) -> str:
    file, line = place
    return f"{file}, line {line}: {text}" if line else f"{file}: {text}"


def _causes(error: BaseException) -> Iterator[BaseException]:
    """An error, then what the reader for files of that ending has said; the other readers have only tried."""
    yield error
    readers = getattr(error, "_likely_errors", None)
    if readers:
        yield from _causes(readers[0])


def _user_line(error: BaseException) -> tuple[str, int] | None:
    """The innermost line that is neither launch's nor a library's."""
    libraries = library_folders()
    lines = [
        (frame.filename, frame.lineno)
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.lineno and not frame.filename.startswith(("<", *libraries))
    ]
    return lines[-1] if lines else None


def _frames(trace: TracebackType | None) -> Iterator[FrameType]:
    while trace is not None:
        yield trace.tb_frame
        trace = trace.tb_next


def _file_line(causes: Sequence[BaseException]) -> Place | None:
    """The file that a reader of XML or YAML was at, and the line where its parser says one."""
    frames = [frame for error in causes for frame in _frames(error.__traceback__)]
    files = [each for each in (frame.f_locals.get("launch_file_path") for frame in frames) if isinstance(each, str)]
    return (files[-1], _parsers_line(causes[-1]) or _elements_line(frames)) if files else None


def _parsers_line(error: BaseException) -> int | None:
    mark: Any = getattr(error, "problem_mark", None)
    position: Any = getattr(error, "position", None)
    if mark is not None:
        return mark.line + 1
    return None if position is None else position[0]


def _elements_line(frames: Sequence[FrameType]) -> int | None:
    """The line of the element that was being read, if it says so."""
    lines = [getattr(frame.f_locals.get("entity"), "line", None) for frame in frames]
    return next((line for line in reversed(lines) if isinstance(line, int)), None) or None


def _entity_line(causes: Sequence[BaseException], file_of: Callable[[Any], str]) -> Place | None:
    """Where the innermost action that was being executed was made, if it says so, else the file that it stands in."""
    from launch import Action

    libraries = library_folders()
    found: Place | None = None
    for frame in (frame for error in causes for frame in _frames(error.__traceback__)):
        entity = frame.f_locals.get("self")
        if isinstance(entity, Action):
            made_in, _, line = str(getattr(entity, "origin", "")).rpartition(":")
            file = file_of(entity)
            if line.isdigit() and not made_in.startswith(libraries):
                found = (made_in, int(line))
            elif file:
                found = (file, None)
    return found
