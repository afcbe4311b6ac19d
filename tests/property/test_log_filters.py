"""The filter grammar compared with a naive model, one record at a time; the log finds the same in its text blocks."""

import time
from itertools import groupby

import pytest
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.logs import patterns, view
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.view import SearchedView
from bot_console.tui.console.model import LogFilter, LogRecord, Severity
from hypothesis import given
from hypothesis import strategies as st

LEVELS = [each for each in Severity if each is not Severity.UNSET]
WORDS = ["ab", "b", "AB", "ba", "zoo"]
TESTS = {
    "a.b": lambda text: any(
        line[i : i + 1] == "a" and line[i + 2 : i + 3] == "b" for line in text.split("\n") for i in range(8)
    ),
    "^a": lambda text: any(line.startswith("a") for line in text.split("\n")),
    "b$": lambda text: any(line.endswith("b") for line in text.split("\n")),
    r"a\sb": lambda text: "a b" in text or "a\nb" in text,
    "[^b]a": lambda text: any(text[i] != "b" and text[i + 1 : i + 2] == "a" for i in range(len(text))),
    r"b\W": lambda text: "b " in text or "b\n" in text,
}
NODES = ["arm.left.zoo", "/arm/left/zoo", "bat", "zoo-1"]
SITES = [("", "", 0), ("ws/arm.py", "spin", 7), ("ws/arm.py", "Stop", 70), ("bat.py", "arm", 7)]
HOUR = 3600
MIDNIGHT = int(time.mktime((2026, 11, 22, 0, 0, 0, 0, 0, -1)))
MOMENTS = [0, 14 * HOUR, 14 * HOUR + 59.5, 14 * HOUR + 60, 23 * HOUR + 59, 24 * HOUR, 38 * HOUR + 30]
"""Seconds after midnight."""
texts = st.text("ab \n", max_size=8).map(str.lower)
lines = st.tuples(
    st.sampled_from(LEVELS), st.sampled_from(NODES), texts, st.sampled_from(SITES), st.sampled_from(MOMENTS)
)
records = st.lists(lines, max_size=40)


def plain(word):
    return word, lambda level, node, text, *_: word.lower() in text or dotted(word).strip(".") in dotted(node)


def dotted(name):
    return "." + name.lower().replace("/", ".").lstrip(".")


def node_word(part):
    return f"node:{part}", lambda level, node, *_: part.replace("/", ".") in dotted(node)


def whole_node(name):
    return f"node:={name}", lambda level, node, *_: dotted(name) == dotted(node)


def severity_word(sign, level):
    compare = {"": level.__eq__, ">=": level.__le__, "<": level.__gt__, "<=": level.__ge__, ">": level.__lt__}[sign]
    return f"sev:{sign}{level.name.lower()}", lambda found, *_: compare(found)


def severity_set(levels):
    return f"sev:{','.join(each.name for each in sorted(levels))}", lambda found, *_: found in levels


def place_word(part, line):
    written = f"at:{part}" + (f":{line}" if line is not None else "")

    def holds(level, node, text, site, moment):
        return (part.lower() in site[0].lower() or part.lower() in site[1].lower()) and line in (None, site[2])

    return written, holds


def time_word(written, holds):
    return f"time:{written}", lambda level, node, text, site, moment: holds(moment)


def pattern(written):
    return f're:"{written}"', lambda level, node, text, *_: TESTS[written](text)


TIMES = {
    "14:00": lambda at: at % (24 * HOUR) // 60 == 14 * 60,
    "14:00:59.5": lambda at: at % (24 * HOUR) == 14 * HOUR + 59.5,
    ">=14:01": lambda at: at % (24 * HOUR) >= 14 * HOUR + 60,
    "<14:00:59": lambda at: at % (24 * HOUR) < 14 * HOUR + 59,
    "14:00:59..14:01": lambda at: 14 * HOUR + 59 <= at % (24 * HOUR) < 14 * HOUR + 120,
    "23:00..00:30": lambda at: at % (24 * HOUR) >= 23 * HOUR or at % (24 * HOUR) < 1860,
    "2026-11-22": lambda at: at < 24 * HOUR,
    ">2026-11-22T23:59": lambda at: at >= 24 * HOUR,
    "..2026-11-22T14:00": lambda at: at < 14 * HOUR + 60,
    f"@{MIDNIGHT}": lambda at: at == 0,
}

without_pattern = st.one_of(
    st.sampled_from(WORDS).map(plain),
    st.sampled_from(["left.zoo", "left/zoo", "/arm", "bat"]).map(node_word),
    st.sampled_from(["arm.left.zoo", "zoo", "/BAT"]).map(whole_node),
    st.builds(severity_word, st.sampled_from(["", ">=", "<", "<=", ">"]), st.sampled_from(LEVELS)),
    st.sets(st.sampled_from(LEVELS), min_size=1).map(severity_set),
    st.builds(place_word, st.sampled_from(["arm", "ARM.py", "stop", "cat"]), st.sampled_from([None, 7, 70])),
    st.sampled_from(sorted(TIMES)).map(lambda written: time_word(written, TIMES[written])),
)
word = without_pattern | st.sampled_from(sorted(TESTS)).map(pattern)
filters = st.lists(st.tuples(word, st.booleans()), max_size=4)


def typed(words):
    return " ".join(("!" if turned else "") + written for (written, _), turned in words)


def holds_all(words, line):
    return all(bool(holds(*line)) is not turned for (_, holds), turned in words)


words_and_lines = given(records, filters, st.integers(1, 4))


@words_and_lines
def test_log_search_finds_exactly_the_lines_that_match_the_filter(lines, words, times):
    the_log_finds(lines, words, times)


@given(records, st.lists(st.tuples(without_pattern, st.booleans()), max_size=4), st.integers(1, 4))
def test_log_search_finds_the_same_words_without_re2(lines, words, times):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(patterns, "re2", None)
        the_log_finds(lines, words, times)


def stamp(moment):
    return (MIDNIGHT * 10 + int(moment * 10)) * 10**8


def stored(lines, capacity=2000):
    store = LogStore(capacity)
    for level, node, text, site, moment in lines:
        store.add(stamp(moment), level, node, text, site)
    return store


def the_log_finds(lines, words, times):
    lines = lines * times * 3
    wanted = [number for number, line in enumerate(lines) if holds_all(words, line)]
    assert matching(stored(lines), LogFilter(words=typed(words))) == wanted


@given(lines, filters)
def test_a_single_line_passes_as_in_a_search(line, words):
    level, node, text, site, moment = line
    record = LogRecord(0, stamp(moment), level, node, text, *site)
    assert parse(typed(words)).passes(record) is holds_all(words, line)


some_filters = st.lists(filters.filter(len), max_size=2)


@given(records, filters, some_filters, some_filters, st.sampled_from(LEVELS))
def test_rules_hide_and_show_lines(lines, words, hidden, only, minimum):
    which = LogFilter(minimum, typed(words), tuple(map(typed, hidden)), tuple(map(typed, only)))
    wanted = [
        number
        for number, line in enumerate(lines)
        if line[0] >= minimum
        and holds_all(words, line)
        and not any(holds_all(each, line) for each in hidden)
        and (not only or any(holds_all(each, line) for each in only))
    ]
    assert matching(stored(lines), which) == wanted


@given(st.lists(st.sampled_from("aab"), max_size=60), st.integers(2, 40), st.integers(1, 5), st.data())
def test_runs_of_equal_lines_are_folded_in_whatever_order_they_arrive(message, capacity, slice_of, data):
    """Older lines are found piece by piece, newer ones arrive meanwhile, and a small store drops the oldest."""
    store, searched = LogStore(capacity), None
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(view, "FIRST_SLICE_RECORDS", slice_of)
        for text in message:
            store.add(0, Severity.INFO, "bat", text)
            if searched is None and data.draw(st.integers(0, 9)) == 0:
                searched = SearchedView(store, LogFilter(folded=True, words="!zoo"))
            if searched is not None and data.draw(st.booleans()):
                searched.work()
        searched = searched or SearchedView(store, LogFilter(folded=True))
        while searched.work():
            pass
    kept = [(number, message[number]) for number in range(store.state.first, store.state.end)]
    rows = [[number for number, _ in row] for _, row in groupby(kept, lambda each: each[1])]
    numbers = searched.poll().numbers
    assert [numbers[index] for index in range(len(numbers))] == [row[-1] for row in rows]
    assert [numbers.count(index) for index in range(len(numbers))] == [len(row) for row in rows]
    assert [numbers.place(number) for row in rows for number in row] == [
        index for index, row in enumerate(rows) for _ in row
    ]
