"""Launch files that no parser can read."""

from __future__ import annotations

from collections.abc import Iterable


class InvalidLaunchFileError(Exception):
    """A launch file cannot be read; the causes are the errors of the parsers that tried it."""

    def __init__(self, extension: str = "", *, likely_errors: Iterable[BaseException] = ()) -> None:
        super().__init__(extension)
        self._extension = extension
        self._likely_errors = list(likely_errors)
        if self._likely_errors:
            self.__cause__ = self._likely_errors[0]  # the error of the parser for files with that extension

    def __str__(self) -> str:
        """Return the causes, one per line."""
        if self._extension == "" or not self._likely_errors:
            return "The launch file may have a syntax error, or its format is unknown"
        lines = [f"Caught multiple exceptions when trying to load file of format [{self._extension}]:"]
        lines += [f" - {type(each).__name__}: {each}" for each in self._likely_errors]
        return "\n".join(lines)
