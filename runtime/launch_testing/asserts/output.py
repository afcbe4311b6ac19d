"""Assertions about the output of processes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from launch_testing.texts import build_text_match, remove_ansi_escape_sequences
from launch_testing.util.proc_lookup import name_of, resolveProcesses

STREAMS = ("stdout", "stderr")


def assertInStream(
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Callable[[str], str] | None = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
    stream: str = "stderr",
) -> None:
    """Assert that a process, or for None any process, has written something, by the rules of `build_text_match`.

    Raises `ValueError` for a stream not in `STREAMS`, and for a filter that is not callable.
    """
    meant = resolveProcesses(proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching)
    if output_filter is not None and not callable(output_filter):
        raise ValueError("output_filter is not callable")
    match = build_text_match(expected_output)
    if stream not in STREAMS:
        raise ValueError("Invalid value for stream; must be 'stdout' or 'stderr'")
    for action in meant:
        pieces = (each for each in proc_output[action] if each.from_stderr == (stream == "stderr"))
        text = b"".join(each.text for each in pieces).decode(errors="replace")
        if strip_ansi_escape_sequences:
            text = remove_ansi_escape_sequences(text)
        if match(output_filter(text) if output_filter else text) is not None:
            return
    names = ", ".join(sorted(map(name_of, meant)))
    raise AssertionError(f"Did not find '{expected_output}' in output for any of the matching processes: {names}")


def assertInStdout(
    proc_output: object, expected_output: object, process: object, cmd_args: object = None, *,
    output_filter: Callable[[str], str] | None = None, strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
) -> None:  # fmt: skip
    """`assertInStream` for the standard output."""
    assertInStream(
        proc_output, expected_output, process, cmd_args, output_filter=output_filter,
        strict_proc_matching=strict_proc_matching, strip_ansi_escape_sequences=strip_ansi_escape_sequences,
        stream="stdout",
    )  # fmt: skip


def assertInStderr(
    proc_output: object, expected_output: object, process: object, cmd_args: object = None, *,
    output_filter: Callable[[str], str] | None = None, strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
) -> None:  # fmt: skip
    """`assertInStream` for the standard error."""
    assertInStream(
        proc_output, expected_output, process, cmd_args, output_filter=output_filter,
        strict_proc_matching=strict_proc_matching, strip_ansi_escape_sequences=strip_ansi_escape_sequences,
        stream="stderr",
    )  # fmt: skip


class SequentialTextChecker:
    """Asserts texts one after the other: the search for each begins after the previous one."""

    def __init__(self, output: list[str]) -> None:
        self._text = "".join(output)
        self._at = 0

    def assertInText(self, msg: str) -> None:
        """Assert that a text comes later; a failure leaves the position unchanged."""
        found = self._text.find(msg, self._at)
        if found < 0:
            raise AssertionError(
                f"'{msg}' not found in sequence after previous match.  "
                f"The output near the last matched line:\n{self.get_nearby_lines()}"
            )
        self._at = found + len(msg)

    def assertInStdout(self, msg: str) -> None:
        """Do the same under the name that tests use."""
        self.assertInText(msg)

    def get_nearby_lines(self) -> str:
        """Return the line of the last match with two lines before and after it."""
        begin, end = self._at, self._at
        for _ in range(3):
            begin = max(self._text.rfind("\n", 0, begin), 0)
        for _ in range(3):
            end = max(self._text.find("\n", end + 1), end)
        return self._text[begin + 1 if begin else 0 : end]


@contextmanager
def assertSequentialStdout(proc_output: Any, process: Any, cmd_args: Any = None) -> Iterator[SequentialTextChecker]:
    """Return a checker of all output of one process, standard error included."""
    action = resolveProcesses(proc_output, process=process, cmd_args=cmd_args)[0]
    yield SequentialTextChecker([each.text.decode(errors="replace") for each in proc_output[action]])
