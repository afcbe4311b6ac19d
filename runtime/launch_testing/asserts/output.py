"""Assertions about what processes have written."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from launch_testing.asserts.texts import matcher
from launch_testing.processes import name_of, resolve

Filter = Callable[[str], str] | None


def assertInStdout(
    proc_output: Any, expected_output: Any, process: Any = None, cmd_args: Any = None, *,
    output_filter: Filter = None, strict_proc_matching: bool = True,
) -> None:  # fmt: skip
    """Assert that a process has written something to its standard output."""
    _assert_in(proc_output, expected_output, process, cmd_args, output_filter, strict_proc_matching, stderr=False)


def assertInStderr(
    proc_output: Any, expected_output: Any, process: Any = None, cmd_args: Any = None, *,
    output_filter: Filter = None, strict_proc_matching: bool = True,
) -> None:  # fmt: skip
    """Assert that a process has written something to its standard error."""
    _assert_in(proc_output, expected_output, process, cmd_args, output_filter, strict_proc_matching, stderr=True)


def _assert_in(
    proc_output: Any, expected: Any, process: Any, cmd_args: Any, output_filter: Filter, strict: bool, *, stderr: bool
) -> None:
    found, texts = matcher(expected), {}
    for action in resolve(proc_output.processes(), process, cmd_args, strict):
        text = "".join(
            each.text.decode(errors="replace")
            for each in proc_output
            if each.action is action and each.from_stderr == stderr
        )
        texts[name_of(action)] = output_filter(text) if output_filter else text
    assert any(found(text) for text in texts.values()), (
        f"Did not find {expected!r} in output of {' or '.join(texts) or 'any process'}"
    )


class SequentialTextChecker:
    """Asserts texts one after the other: each is looked for behind the one before."""

    def __init__(self, output: list[str]) -> None:
        self._lines = output
        self._at = 0

    def assertInStdout(self, msg: Any) -> None:
        """Assert that a later line has a text."""
        found = matcher(msg)
        for at in range(self._at, len(self._lines)):
            if found(self._lines[at]):
                self._at = at + 1
                return
        raise AssertionError(f"'{msg}' not found in output")


@contextmanager
def assertSequentialStdout(proc_output: Any, process: Any, cmd_args: Any = None) -> Iterator[SequentialTextChecker]:
    """A checker of the lines that a process has written to its standard output."""
    (action,) = resolve(proc_output.processes(), process, cmd_args)
    pieces = (each for each in proc_output if each.action is action and not each.from_stderr)
    text: str = "".join(each.text.decode(errors="replace") for each in pieces)
    yield SequentialTextChecker([str(line) for line in text.splitlines()])
