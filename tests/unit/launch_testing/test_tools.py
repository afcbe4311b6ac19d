"""Expectations about output, as text and as lines."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from launch_testing.tools import basic_output_filter, expect_output, expected_output_from_file

LINES = ["[talker] foo", "[listener] foo", "[talker] bar"]
TALKER, LISTENER = re.compile(r"\[talker\]"), re.compile(r"\[listener\]")


@pytest.mark.parametrize(
    ("expected", "strict", "found"),
    [
        (LINES, True, True),
        (LINES[:2], True, True),  # the expected lines follow each other; more may come
        (LINES[1:], True, False),
        (LINES[::2], False, True),
        (LINES[::2], True, False),
        (LINES[::-1], False, False),
        ("foo", False, True),
        ("foo", True, False),
        ([TALKER, LISTENER, TALKER], True, True),
        ([LISTENER, LISTENER], False, False),
        (re.compile("foo"), False, False),  # at the beginning of a line
    ],
)
def test_expected_lines_are_compared(expected: Any, strict: bool, found: bool) -> None:
    assert expect_output(lines=LINES, expected_lines=expected, strict=strict) == found
    assert expect_output("\r\n".join(LINES), expected_lines=expected, strict=strict) == found


@pytest.mark.parametrize(
    ("expected", "strict", "found"),
    [
        ("\n".join(LINES), True, True),
        ("foo\n[listener]", False, True),
        ("foo", True, False),
        (re.compile("^.listener", re.M), False, True),
        (re.compile("^.listener", re.M), True, False),
        (["foo", "bar"], False, True),
        (["bar", "foo"], False, False),
    ],
)
def test_expected_text_is_compared(expected: Any, strict: bool, found: bool) -> None:
    assert expect_output("\r\n".join(LINES), expected_text=expected, strict=strict) == found
    assert expect_output(lines=LINES, expected_text=expected, strict=strict) == found


def test_colours_are_ignored_by_default() -> None:
    assert expect_output("\x1b[1;32mgreen\x1b[0m", expected_text="green", strict=True)
    assert not expect_output(
        "\x1b[32mgreen\x1b[0m", expected_text="green", strict=True, strip_ansi_escape_sequences=False
    )


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"expected_text": "x"}, "Either lines or text, but not both"),
        ({"text": "x", "lines": ["x"], "expected_text": "x"}, "Either lines or text, but not both"),
        ({"text": "x"}, "Either expected lines or text, but not both"),
        ({"text": "x", "expected_text": 5}, "Unknown format for expected text"),
        ({"text": "x", "expected_lines": 5}, "Unknown format for expected lines"),
    ],
)
def test_invalid_expectations_are_rejected(given: dict[str, Any], text: str) -> None:
    with pytest.raises(ValueError, match=text):
        expect_output(**given)


def test_output_filter_removes_lines_by_prefix() -> None:
    output = "pid 5\nrc 0\n[talker] foo\n[listener] foo\n"
    assert basic_output_filter()(output) == "[talker] foo\n[listener] foo\n"
    assert basic_output_filter(["["], ["rc"])(output) == "pid 5\n"


def test_expectations_are_read_from_files(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("one\ntwo")
    (tmp_path / "b.regex").write_text("o.e\n")
    assert expected_output_from_file(str(tmp_path / "a")) == ["one", "two"]
    assert [each.pattern for each in expected_output_from_file(path=str(tmp_path / "b"))] == ["o.e"]
    with pytest.raises(RuntimeError, match="could not find output check file"):
        expected_output_from_file(str(tmp_path / "c"))
