"""Launch files that no parser can read."""

from __future__ import annotations

from collections.abc import Iterable
from traceback import format_exception_only


class InvalidLaunchFileError(Exception):
    """A launch file cannot be read; the causes are what each parser that tried it has said."""

    def __init__(self, extension: str = "", *, likely_errors: Iterable[BaseException] = ()) -> None:
        super().__init__(extension)
        self._extension = extension
        self._likely_errors = list(likely_errors)

    def __str__(self) -> str:
        """The causes, one below the other."""
        if self._extension == "" or not self._likely_errors:
            return "The launch file may have a syntax error, or its format is unknown"
        lines = [f"Caught multiple exceptions when trying to load file of format [{self._extension}]:"]
        lines += [f" - {type(each).__name__}: {each}" for each in self._likely_errors]
        return "\n".join(lines)


def error_line(error: BaseException) -> str:
    """The line that a traceback of an error ends with."""
    return "".join(format_exception_only(type(error), error)).strip()
