"""Scripts are parsed as a whole; a mistake is reported with its line and the expected form."""

from __future__ import annotations

import pytest
from bot_console.tui.cli.check.script import ScriptError, read
from hypothesis import given
from hypothesis import strategies as st


def test_lines_become_steps_with_numbers_arguments_and_time_limits() -> None:
    steps = read(
        "# a comment\n\nset /n speed 0.5\nexpect-refused /n speed 9 must be\n  expect /odom.x > 1 within 500 ms\n"
        'assert-rate /scan >= 10 for 2 s\nwait 1 min\nexpect /n:name == "a b"\nexpect-log sev:>=warn hot within 3 s\n'
    )
    assert [(each.line, each.verb, each.words, each.seconds) for each in steps] == [
        (3, "set", ("/n", "speed", "0.5"), 5.0),
        (4, "expect-refused", ("/n", "speed", "9", "must be"), 5.0),
        (5, "expect", ("/odom.x > 1",), 0.5),
        (6, "assert-rate", ("/scan", ">=", "10"), 2.0),
        (7, "wait", (), 60.0),
        (8, "expect", ("/n:name", "==", '"a b"'), 5.0),
        (9, "expect-log", ("sev:>=warn hot",), 3.0),
    ]


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "no step"),
        ("wait 1 s\njump high", "line 2: 'jump' is not one of set"),
        ("set speed 1", "line 1: write set /node parameter value"),
        ("expect-refused /n speed", "write expect-refused"),
        ('expect-refused /n speed "9', "quote values"),
        ("expect 1 < 2", "name a field"),
        ("expect /a/b", "compares nothing"),
        ("assert-rate /scan", "write assert-rate"),
        ("assert-rate /scan >= many", "write assert-rate"),
        ("wait long", "is not a duration"),
        ("wait 2 h", "is not a duration"),
        ("expect-node /a within 9999 s", "a line may take at most"),
        ("expect-log", "write expect-log"),
        ("call /reset", "write call"),
    ],
)
def test_mistake_is_reported_with_its_line(text: str, why: str) -> None:
    with pytest.raises(ScriptError, match=why):
        read(text)


@given(st.text("setxpcwai-/. \n:=><0123459\"'[]", max_size=60))
def test_any_text_is_parsed_or_refused_with_a_message(text: str) -> None:
    try:
        assert read(text)
    except ScriptError as error:
        assert str(error)
