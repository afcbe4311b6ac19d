"""Log lines on the console, in the format of rcutils."""

from __future__ import annotations

import os
import re
import sys
import time
from typing import Any

from rclpy.constants import S_TO_NS

DEFAULT_FORMAT = "[{severity}] [{time}] [{name}]: {message}"
NAMES = {0: "UNSET", 10: "DEBUG", 20: "INFO", 30: "WARN", 40: "ERROR", 50: "FATAL"}
COLOURS = {10: "\033[32m", 20: "\033[0m", 30: "\033[33m", 40: "\033[31m", 50: "\033[31m"}
RESET = "\033[0m"
ENVELOPE_VARIABLE = "BOT_CONSOLE_LOG_ENVELOPE"
"""A format around each line, in which `{line}` stands for the usual line. Programs that capture the output of a process
set it, to distinguish what a logger wrote from what was merely printed.
"""
_ESCAPES = {"\\a": "\a", "\\b": "\b", "\\n": "\n", "\\r": "\r", "\\t": "\t"}
_TOKEN = re.compile(r"\{([a-z_]+)\}")

_FIELDS = {
    "severity": "{0}",
    "name": "{1}",
    "message": "{2}",
    "file_name": "{3}",
    "function_name": "{4}",
    "line_number": "{5}",
    "time": "{6}.{7:09d}",
    "time_as_nanoseconds": "{8}",
    "date_time_with_ms": "{9}",
    "on_rosout": "{10}",
}


class Formatter:
    """Formats and writes log lines, with the settings that rcutils reads from the environment."""

    def __init__(self, pattern: str, colours: str, *, to_stdout: bool) -> None:
        self._simple = not pattern or pattern == DEFAULT_FORMAT
        self._template = _template(pattern or DEFAULT_FORMAT)
        self._dated = "{9}" in self._template
        self._colours = colours
        self._to_stdout = to_stdout

    @classmethod
    def of_environment(cls, *, enveloped: bool = True) -> Formatter:
        """Return the formatter that the calling process's environment configures; lines in a file have no envelope."""
        environment = os.environ
        put = _in_envelope if enveloped else _out_of_envelope
        return cls(
            put(environment.get("RCUTILS_CONSOLE_OUTPUT_FORMAT", ""), environment.get(ENVELOPE_VARIABLE, "")),
            environment.get("RCUTILS_COLORIZED_OUTPUT", ""),
            to_stdout=environment.get("RCUTILS_LOGGING_USE_STDOUT") == "1",
        )

    def line(
        self,
        severity: int,
        name: str,
        text: str,
        file: str,
        function: str,
        line: int,
        stamp_ns: int,
        on_rosout: bool = False,
    ) -> str:
        """Return one formatted message, without colours and line end; `on_rosout` is whether `/rosout` got it, too."""
        seconds, nanoseconds = divmod(stamp_ns, S_TO_NS)
        level = NAMES.get(severity, "UNKNOWN")
        # The default format is made without a template, which halves the time of a log line.
        if self._simple:
            return f"[{level}] [{seconds:010d}.{nanoseconds:09d}] [{name}]: {text}"
        dated = _date_text(seconds, nanoseconds) if self._dated else ""
        return self._template.format(
            level, name, text, file, function, line, f"{seconds:010d}", nanoseconds, stamp_ns, dated, int(on_rosout)
        )

    def write(
        self,
        severity: int,
        name: str,
        text: str,
        file: str,
        function: str,
        line: int,
        stamp_ns: int,
        on_rosout: bool = False,
    ) -> None:
        """Print one message."""
        stream = sys.stdout if self._to_stdout else sys.stderr
        out = self.line(severity, name, text, file, function, line, stamp_ns, on_rosout)
        if self._uses_colours(stream):
            out = f"{COLOURS.get(severity, RESET)}{out}{RESET}"
        try:
            stream.write(out + "\n")
        except UnicodeEncodeError:  # lone surrogates, or a terminal that is not UTF-8
            stream.write(out.encode("utf-8", "backslashreplace").decode("ascii", "backslashreplace") + "\n")

    def _uses_colours(self, stream: Any) -> bool:
        if self._colours in ("0", "1"):
            return self._colours == "1"
        return bool(stream.isatty())


def _in_envelope(pattern: str, envelope: str) -> str:
    """Wrap the pattern in the envelope, unless it is wrapped already."""
    if not envelope or pattern.startswith(envelope.partition("{line}")[0]):
        return pattern
    return envelope.replace("{line}", pattern or DEFAULT_FORMAT)


def _out_of_envelope(pattern: str, envelope: str) -> str:
    """Unwrap the pattern from the envelope."""
    before, _, after = envelope.partition("{line}")
    return pattern.removeprefix(before).removesuffix(after) if pattern.startswith(before) else pattern


def _template(pattern: str) -> str:
    """Convert the pattern to a template of `str.format`."""
    for written, meant in _ESCAPES.items():
        pattern = pattern.replace(written, meant)
    parts: list[str] = []
    end = 0
    for found in _TOKEN.finditer(pattern):
        if found[1] in _FIELDS:
            parts += [_escape_braces(pattern[end : found.start()]), _FIELDS[found[1]]]
            end = found.end()
    return "".join([*parts, _escape_braces(pattern[end:])])


def _escape_braces(text: str) -> str:
    return text.replace("{", "{{").replace("}", "}}")


def _date_text(seconds: int, nanoseconds: int) -> str:
    return time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds)) + f".{nanoseconds // 1_000_000:03d}"
