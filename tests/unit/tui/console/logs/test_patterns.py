"""Patterns where google-re2 is missing: searched in another process with a time limit, so that none can freeze the
console.
"""

from __future__ import annotations

import time

import pytest
from bot_console.tui.console.logs import patterns, regex_process
from bot_console.tui.console.logs.patterns import Pattern
from bot_console.tui.console.logs.re2_engine import within_lines
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.view import SearchedView
from bot_console.tui.console.model import LogFilter
from bot_console.tui.console.query import parse

ENDLESS = r"(.|\w)*%%"


@pytest.fixture
def without_re2(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(patterns, "re2", None)
    monkeypatch.setattr(regex_process, "_costly", {})


def searched(store: LogStore, words: str) -> SearchedView:
    view = SearchedView(store, LogFilter(words=words))
    while view.work():
        pass
    return view


def test_the_engine_here_is_re2() -> None:
    assert patterns.re2 is not None


@pytest.mark.usefixtures("without_re2")
def test_a_pattern_that_takes_too_long_is_refused_and_others_still_work() -> None:
    store = LogStore()
    for number in range(100):
        store.add(number, 20, "n", "a" * 40 + str(number))
    began = time.thread_time()
    found = searched(store, f"re:{ENDLESS}").poll()
    assert time.thread_time() - began < 0.2, "nothing of it is searched here"
    assert found.complete and "too costly without google-re2" in found.problem
    with pytest.raises(ValueError, match="too costly"):
        parse(f"re:{ENDLESS}")
    assert len(searched(store, "re:9$").poll().numbers) == 10


@pytest.mark.usefixtures("without_re2")
def test_a_costly_pattern_delays_a_list_only_once() -> None:
    query = parse(f"re:{ENDLESS}")
    began = time.monotonic()
    assert not any(query.matches("a" * 40 + str(number)) for number in range(1000))
    assert time.monotonic() - began < 20 * regex_process.LIMIT, "one wait in all, on however busy a machine"


@pytest.mark.usefixtures("without_re2")
@pytest.mark.parametrize("wrong", ["(", "[z-a]", "a{2,1}", "(?P<n>", "*"])
def test_an_invalid_pattern_is_refused_with_its_reason(wrong: str) -> None:
    with pytest.raises(ValueError, match="regular expression"):
        Pattern(wrong)


@pytest.mark.usefixtures("without_re2")
def test_the_process_is_restarted_after_it_has_ended() -> None:
    assert Pattern("a.c").search("xabc")
    process = regex_process.PROCESS._process
    assert process is not None
    process.kill()
    process.wait()
    assert Pattern("a.d").search("xabd")


@pytest.mark.usefixtures("without_re2")
@pytest.mark.parametrize("word", ["ÄÖ", "a.c", "(", "%"])
def test_plain_words_need_no_process(word: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(regex_process.PROCESS, "ask", None)
    store = LogStore()
    store.add(1, 20, "n", f"x{word.lower()}y\nz")
    store.add(2, 20, "n", "nothing")
    assert len(searched(store, word).poll().numbers) == 1 and Pattern(word, literal=True).search(word.upper())


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (r"a\sb", r"a[\t\f\r ]b"),
        ("[^]a]b", r"[^]a\n]b"),
        (r"\[^x", r"\[^x"),
        (r"\S+[\]^a]", r"\S+[\]^a]"),
        (r"x\W", r"x[^\w\n]"),
        ("(?i:a)", "(?i:a)"),
        ("(?s)a.b", None),
        ("(?is:a.b)", None),
        (r"[a\s]", None),
        (r"\x0a", None),
        ("a\nb", None),
        ("[[:space:]]", None),
        (r"\pN", None),
    ],
)
def test_patterns_are_rewritten_to_match_within_lines(body: str, expected: str | None) -> None:
    assert within_lines(body) == expected
