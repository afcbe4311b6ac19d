"""The log store: numbering, the ring, and every kind of filter."""

import pytest
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.model import LogFilter, Severity
from hypothesis import given
from hypothesis import strategies as st


def filled_store(capacity: int = 100) -> LogStore:
    store = LogStore(capacity)
    store.add(1, 20, "robot_navigator", "Max Speed: 1.0 m/s", ("robot_node.py", "__init__", 12))
    store.add(2, 30, "safety_monitor", "Obstacle at 0.31m\nsecond line")
    store.add(3, 40, "robot_navigator", "Speed must be 0.1-5.0, got 10.0")
    store.add(4, 10, "safety_monitor", "détail ⚠")
    return store


def test_a_record_is_read_back_as_it_was_added() -> None:
    record = filled_store().record(0)
    assert record is not None
    assert (record.seq, record.stamp, record.severity, record.node) == (0, 1, Severity.INFO, "robot_navigator")
    assert (record.text, record.file, record.function, record.line) == (
        "Max Speed: 1.0 m/s", "robot_node.py", "__init__", 12)  # fmt: skip
    assert filled_store().record(1).text == "Obstacle at 0.31m\nsecond line"  # type: ignore[union-attr]
    assert filled_store().record(4) is None


@pytest.mark.parametrize(
    ("which", "found"),
    [
        (LogFilter(), [0, 1, 2, 3]),
        (LogFilter(minimum=Severity.WARN), [1, 2]),
        (LogFilter(words="speed"), [0, 2]),
        (LogFilter(words="speed !must"), [0]),
        (LogFilter(words="SPEED got"), [2]),
        (LogFilter(words="safety"), [1, 3]),
        (LogFilter(words="node:safety"), [1, 3]),
        (LogFilter(words="!node:safety"), [0, 2]),
        (LogFilter(words="sev:>=warn"), [1, 2]),
        (LogFilter(words="sev:debug"), [3]),
        (LogFilter(words=r"re:\d+\.\d+m$"), [1]),
        (LogFilter(words="re:^second"), [1]),
        (LogFilter(words="⚠"), [3]),
        (LogFilter(words="DÉTAIL"), [3]),
        (LogFilter(words="at:robot_node.py:12"), [0]),
        (LogFilter(words="at:__init__ at::12"), [0]),
        (LogFilter(words="!at:robot_node.py:1"), [0, 1, 2, 3]),
        (LogFilter(hidden=("node:=safety_monitor",)), [0, 2]),
        (LogFilter(hidden=("node:=safety", "sev:info")), [1, 2, 3]),
        (LogFilter(only=("détail", "must")), [2, 3]),
    ],
)
def test_filters_select_the_matching_records(which: LogFilter, found: list[int]) -> None:
    assert matching(filled_store(), which) == found


def test_filtering_resumes_where_it_stopped() -> None:
    store = filled_store()
    assert matching(store, LogFilter(words="speed"), after=1) == [2]
    assert matching(store, LogFilter(), limit=2) == [2, 3]


@pytest.mark.parametrize("words", ["re:(", "sev:loud", "!re:*", "time:25:00", "time:noon", "time:14:00..2026-11-22"])
def test_an_invalid_filter_is_refused_with_the_reason(words: str) -> None:
    with pytest.raises(ValueError, match=r"regular expression|severity|time"):
        matching(filled_store(), LogFilter(words=words))


def test_the_oldest_half_is_dropped_and_counted() -> None:
    store = LogStore(4)
    for number in range(7):
        store.add(number, 20, "n", f"line {number}")
    assert (store.state.first, store.state.end, store.state.dropped) == (4, 7, 4)
    assert store.record(3) is None
    assert matching(store, LogFilter(words="line")) == [4, 5, 6]


def test_clear_discards_records_but_numbering_continues() -> None:
    store = filled_store()
    store.clear()
    assert (store.state.first, store.state.end) == (4, 4)
    store.add(9, 20, "n", "again")
    assert matching(store, LogFilter()) == [4]


def test_the_state_is_one_object_until_something_changes() -> None:
    store = filled_store()
    before = store.state
    assert store.state is before
    assert before.counts == {Severity.INFO: 1, Severity.WARN: 1, Severity.ERROR: 1, Severity.DEBUG: 1}
    store.add(5, 20, "n", "x")
    assert store.state is not before


@given(st.lists(st.tuples(st.sampled_from([0, 10, 15, 20, 30, 40, 50, 99]), st.text(max_size=20)), max_size=60))
def test_the_ring_keeps_the_newest_and_any_text(records: list[tuple[int, str]]) -> None:
    store = LogStore(20)
    for number, (severity, text) in enumerate(records):
        store.add(number, severity, "n", text)
    state = store.state
    assert state.end == len(records)
    assert state.first + (state.end - state.first) == state.end
    assert state.end - state.first <= 20
    assert state.dropped == state.first
    for seq in range(state.first, state.end):
        record = store.record(seq)
        assert record is not None
        assert record.text == records[seq][1].encode("utf-8", "replace").decode()
