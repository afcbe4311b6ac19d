"""Patterns with google-re2, and without it: then only words are found."""

from __future__ import annotations

import pytest
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.logs import patterns
from bot_console.tui.console.logs.patterns import Pattern
from bot_console.tui.console.logs.re2_engine import within_lines
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.view import SearchedView
from bot_console.tui.console.model import LogFilter


@pytest.fixture
def without_re2(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(patterns, "re2", None)


def searched(store: LogStore, words: str) -> SearchedView:
    view = SearchedView(store, LogFilter(words=words))
    while view.work():
        pass
    return view


def test_the_engine_here_is_re2() -> None:
    assert patterns.re2 is not None


@pytest.mark.usefixtures("without_re2")
def test_regular_expressions_are_refused_with_a_hint_and_words_still_work() -> None:
    store = LogStore()
    for number in range(100):
        store.add(number, 20, "n", f"a{number}")
    found = searched(store, "re:9$").poll()
    assert found.complete and not found.numbers and "google-re2" in found.problem and "use words" in found.problem
    with pytest.raises(ValueError, match="google-re2"):
        parse("re:9$")
    assert len(searched(store, "a9").poll().numbers) == 11


@pytest.mark.parametrize("wrong", ["(", "[z-a]", "a{2,1}", "(?P<n>", "*"])
def test_an_invalid_pattern_is_refused_with_its_reason(wrong: str) -> None:
    with pytest.raises(ValueError, match="regular expression"):
        Pattern(wrong)


@pytest.mark.usefixtures("without_re2")
@pytest.mark.parametrize("word", ["ÄÖ", "a.c", "(", "%"])
def test_plain_words_need_no_library(word: str) -> None:
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
