"""Formats rates, sizes and times in a few cells. Pure."""

from __future__ import annotations

STEADY = 0.03
"""Relative difference from the shown number at which it is updated."""


def steady(shown: float | None, now: float | None) -> float | None:
    """The number to show: the previous one while the new one is about the same, so that it does not flicker."""
    if shown is None or now is None or shown == 0 or now == 0:
        return now
    return shown if abs(now - shown) <= STEADY * abs(shown) else now


def rate_text(rate: float | None, *, provisional: bool = False) -> str:
    """A rate in Hz with at most three digits; a provisional one begins with `~`."""
    if rate is None:
        return ""
    if rate == 0:
        return "0"
    text = f"{rate:.2f}" if rate < 1 else f"{rate:.1f}" if rate < 20 else f"{rate:.0f}"
    return f"~{text}" if provisional else text


def coarse_rate(rate: float | None) -> str:
    """A rate with its unit, rounded so coarsely that small changes cause no redraw."""
    if rate is None:
        return ""
    if rate == 0:
        return "0 Hz"
    return f"{rate:.1f} Hz" if rate < 9.5 else f"{rate:.2g} Hz" if rate < 95 else f"{rate:.0f} Hz"


def amount_text(amount: float | None) -> str:
    """An amount of bytes per second, in powers of a thousand."""
    if amount is None:
        return ""
    for unit in ("B", "kB", "MB"):
        if amount < 999.5:
            return f"{amount:.0f} {unit}" if unit == "B" or amount >= 9.95 else f"{amount:.1f} {unit}"
        amount /= 1000
    return f"{amount:.1f} GB"


def age_text(age: float | None) -> str:
    """An age in seconds, minutes or hours; less than a second is `now`."""
    if age is None:
        return ""
    if age < 1:
        return "now"
    if age < 60:
        return f"{age:.0f} s"
    return f"{age / 60:.0f} min" if age < 5400 else f"{age / 3600:.0f} h"


def span_text(seconds: float | None) -> str:
    """A short duration in microseconds, milliseconds or seconds, with two or three digits."""
    if seconds is None:
        return ""
    size = abs(seconds)
    if size < 1e-3:
        return f"{seconds * 1e6:.0f} µs"
    if size < 1:
        return f"{seconds * 1e3:.1f} ms" if size < 0.01 else f"{seconds * 1e3:.0f} ms"
    return f"{seconds:.1f} s"
