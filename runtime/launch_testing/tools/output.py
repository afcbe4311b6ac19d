"""Filters and expectations for output."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from launch_testing.texts import build_line_match, build_text_match, remove_ansi_escape_sequences


def get_default_filtered_prefixes() -> list[str]:
    """Return the prefixes of lines that are ignored by default."""
    return ["pid", "rc"]


def get_default_filtered_patterns() -> list[str]:
    """Return the patterns of lines that are ignored by default: none."""
    return []


def basic_output_filter(
    filtered_prefixes: Sequence[str] | None = None, filtered_patterns: Sequence[str] | None = None
) -> Callable[[str], str]:
    """Return a function that removes the lines with these prefixes or patterns from a text."""
    prefixes = tuple(get_default_filtered_prefixes() if filtered_prefixes is None else filtered_prefixes)
    some = get_default_filtered_patterns() if filtered_patterns is None else filtered_patterns
    patterns = [re.compile(each) for each in some]

    def counts(line: str) -> bool:
        return not line.startswith(prefixes) and not any(each.match(line) for each in patterns)

    return lambda output: "".join(filter(counts, output.splitlines(keepends=True)))


def expected_output_from_file(path: str, encoding: str | None = None) -> list[Any]:
    """Return the lines of `path`.txt, or the expressions of `path`.regex; raises `RuntimeError` if neither exists."""
    literal, regular = Path(f"{path}.txt"), Path(f"{path}.regex")
    if literal.is_file():
        return list(literal.read_text(encoding=encoding).splitlines())
    if regular.is_file():
        return [re.compile(line) for line in regular.read_text(encoding=encoding).splitlines()]
    raise RuntimeError(f"could not find output check file: {path}")


def expect_output(
    text: str | None = None,
    *,
    lines: Sequence[str] | None = None,
    expected_text: object = None,
    expected_lines: object = None,
    strip_ansi_escape_sequences: bool = True,
    strict: bool = False,
) -> bool:
    """Return whether a text, or lines, match, by the rules of `build_text_match` and `build_line_match`.

    Raises `ValueError` unless exactly one of text and lines, and exactly one of the two expectations, is given.
    """
    if (text is None) == (lines is None):
        raise ValueError("Either lines or text, but not both, must be specified")
    if (expected_text is None) == (expected_lines is None):
        raise ValueError("Either expected lines or text, but not both, must be specified")
    given = "\n".join(lines or ()) if text is None else text
    if strip_ansi_escape_sequences:
        given = remove_ansi_escape_sequences(given)
    if expected_text is not None:
        return build_text_match(expected_text, strict=strict)(given) is not None
    return build_line_match(expected_lines, strict=strict)(given.splitlines()) is not None
