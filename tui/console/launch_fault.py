"""Why a launch file cannot be run, as one message with file and line."""

from __future__ import annotations

import sysconfig
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any

ENDLESS = "launch files include each other without end"


def fault_text(error: BaseException, path: str, file_of: Callable[[Any], str] = lambda entity: "") -> str:
    """What went wrong and where; `path` is the launch file that was asked for, `file_of` knows where entities stand."""
    error = _cause(error)
    if isinstance(error, SyntaxError) and error.filename:
        return _at(error.filename, error.lineno, f"syntax error: {error.msg}")
    place = _user_line(error) or _file_line(error) or _entity_line(error, file_of) or (path, None)
    if isinstance(error, RecursionError):
        return _at(*place, ENDLESS)
    own = type(error).__module__.partition(".")[0] in ("launch", "launch_ros", "launch_xml", "launch_yaml")
    text = str(error) or type(error).__name__
    return _at(*place, text if own else f"{type(error).__name__}: {text}")


def _at(file: str, line: int | None, text: str) -> str:
    return f"{file}, line {line}: {text}" if line else f"{file}: {text}"


def _cause(error: BaseException) -> BaseException:
    """What the reader for files of that ending has said; the others have only tried."""
    causes = getattr(error, "_likely_errors", None)
    while causes:
        error = causes[0]
        causes = getattr(error, "_likely_errors", None)
    return error


def _user_line(error: BaseException) -> tuple[str, int] | None:
    """The innermost line that is neither launch's nor a library's."""
    libraries = _library_folders()
    lines = [
        (frame.filename, frame.lineno)
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.lineno and not frame.filename.startswith(("<", *libraries))
    ]
    return lines[-1] if lines else None


def _library_folders() -> tuple[str, ...]:
    import launch_ros

    import launch

    folders = [str(Path(module.__file__).parent.parent) for module in (launch, launch_ros) if module.__file__]
    folders += [sysconfig.get_path(name) for name in ("stdlib", "purelib", "platlib")]
    folders.append(str(Path(__file__).parents[2]))
    return tuple(dict.fromkeys(each for folder in folders for each in (folder, str(Path(folder).resolve()))))


def _frames(trace: TracebackType | None) -> Iterator[FrameType]:
    while trace is not None:
        yield trace.tb_frame
        trace = trace.tb_next


def _file_line(error: BaseException) -> tuple[str, int | None] | None:
    """The file that a reader of XML or YAML was at, and the line where its parser says one."""
    files = [frame.f_locals.get("launch_file_path") for frame in _frames(error.__traceback__)]
    known = [each for each in files if isinstance(each, str)]
    if not known:
        return None
    mark: Any = getattr(error, "problem_mark", None)
    position: Any = getattr(error, "position", None)
    return known[-1], mark.line + 1 if mark is not None else (position[0] if isinstance(position, tuple) else None)


def _entity_line(error: BaseException, file_of: Callable[[Any], str]) -> tuple[str, int | None] | None:
    """Where the action that failed was made, if it says so, else the file that it stands in."""
    from launch import Action

    found: tuple[str, int | None] | None = None
    for frame in _frames(error.__traceback__):
        entity = frame.f_locals.get("self")
        if isinstance(entity, Action):
            made_at: Any = getattr(entity, "made_at", None)
            file = file_of(entity)
            found = made_at or ((file, None) if file else found)
    return found
