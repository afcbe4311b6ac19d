"""Rates, sizes and times in a few cells: each unit, and the borders between them."""

import pytest
from bot_console.tui.text.figures import age_text, amount_text, rate_text, span_text, steady


@pytest.mark.parametrize(
    ("rate", "text"),
    [(None, ""), (0.0, "0"), (0.254, "0.25"), (1.0, "1.0"), (19.94, "19.9"), (20.0, "20"), (1234.4, "1234")],
)
def test_a_rate_has_at_most_three_digits_while_it_is_small(rate: float | None, text: str) -> None:
    assert rate_text(rate) == text


@pytest.mark.parametrize(
    ("amount", "text"),
    [
        (None, ""),
        (0.0, "0 B"),
        (999.4, "999 B"),
        (999.5, "1.0 kB"),
        (9_940.0, "9.9 kB"),
        (9_960.0, "10 kB"),
        (999_500.0, "1.0 MB"),
        (3.2e9, "3.2 GB"),
        (4.5e12, "4500.0 GB"),
    ],
)
def test_amount_uses_powers_of_a_thousand(amount: float | None, text: str) -> None:
    assert amount_text(amount) == text


@pytest.mark.parametrize(
    ("age", "text"),
    [(None, ""), (0.99, "now"), (1.0, "1 s"), (59.4, "59 s"), (60.0, "1 min"), (5399.0, "90 min"), (5400.0, "2 h")],
)
def test_an_age_is_in_seconds_minutes_or_hours(age: float | None, text: str) -> None:
    assert age_text(age) == text


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (None, ""),
        (0.0, "0 µs"),
        (0.00025, "250 µs"),
        (-0.00025, "-250 µs"),
        (0.0042, "4.2 ms"),
        (0.042, "42 ms"),
        (1.25, "1.2 s"),
    ],
)
def test_a_short_time_has_the_unit_that_fits(seconds: float | None, text: str) -> None:
    assert span_text(seconds) == text


@pytest.mark.parametrize(
    ("shown", "now", "next_shown"),
    [(None, 5.0, 5.0), (10.0, None, None), (10.0, 10.2, 10.0), (10.0, 10.4, 10.4), (0.0, 0.1, 0.1), (10.0, 0.0, 0.0)],
)
def test_a_figure_stays_until_it_differs_noticeably(
    shown: float | None, now: float | None, next_shown: float | None
) -> None:
    assert steady(shown, now) == next_shown
