"""Parses times in filters of the log: `14:03..14:05`, `>=14:03:20.5`, `2026-11-22T14:03`, `-5m`, `@12.5`.

A time without a date applies to every day, in local time, because a log may be read on a later day.
"""

from __future__ import annotations

import re
import time
from dataclasses import dataclass

SECOND_NS = 10**9
DAY_NS = 86_400 * SECOND_NS
LATEST_NS = 2**63 - 1
EXAMPLES = (
    "14:03, 14:03:20.5, 2026-11-22T14:03, -5m (before now), @12.5 (seconds since the epoch), 14:03..14:05, >=14:03"
)
_CLOCK = re.compile(
    r"(?:(?P<date>\d{4}-\d\d-\d\d)(?:[Tt](?=\d)|$))?(?:(?P<clock>\d{1,2}:\d\d(?::\d\d)?)(?:\.(?P<part>\d{1,9}))?)?"
)
_AGO = re.compile(r"-(\d{1,9}(?:\.\d{1,9})?)(ms|s|min|m|h|d)")
_EPOCH = re.compile(r"@(\d{1,10})(?:\.(\d{1,9}))?")
_UNITS = {
    "ms": SECOND_NS // 1000,
    "s": SECOND_NS,
    "m": 60 * SECOND_NS,
    "min": 60 * SECOND_NS,
    "h": 3600 * SECOND_NS,
    "d": DAY_NS,
}


@dataclass(frozen=True, slots=True)
class Span:
    """From `begin` up to but not including `end`, in ns since the epoch or, if `daily`, since local midnight."""

    begin: int
    end: int
    daily: bool = False

    def holds(self, stamp: int) -> bool:
        """Whether the span contains a time (ns since the epoch); a daily span may cross midnight."""
        at = (stamp + utc_offset(stamp)) % DAY_NS if self.daily else stamp
        if self.begin > self.end:
            return at >= self.begin or at < self.end
        return self.begin <= at < self.end


@dataclass(frozen=True, slots=True)
class _Point:
    """A time with the precision with which it was written: `14:03` is a whole minute."""

    begin: int
    end: int
    daily: bool = False
    ago: bool = False


def utc_offset(stamp: int) -> int:
    """The offset (ns) of local time from UTC at a time (ns since the epoch)."""
    return time.localtime(stamp // SECOND_NS).tm_gmtoff * SECOND_NS


def parse_span(text: str, now: int) -> Span:
    """Parse a span; `-5m` counts back from `now` (ns since the epoch). Raises `ValueError`."""
    first, dots, last = text.partition("..")
    if dots:
        begin, end = (_point(each, now) if each else None for each in (first, last))
        known = [each for each in (begin, end) if each is not None]
        if not known or len({each.daily for each in known}) > 1:
            raise ValueError(f"time '{text}': give both ends a date, or neither; for instance {EXAMPLES}")
        return _between(begin.begin if begin else None, end.end if end else None, known[0].daily)
    sign = next((each for each in (">=", "<=", ">", "<", "=") if text.startswith(each)), "")
    point = _point(text[len(sign) :], now)
    if sign in ("", "=") and not point.ago:
        return Span(point.begin, point.end, point.daily)
    if sign.startswith("<"):
        return _between(None, point.end if sign == "<=" else point.begin, point.daily)
    return _between(point.end if sign == ">" else point.begin, None, point.daily)


def _between(begin: int | None, end: int | None, daily: bool) -> Span:
    return Span(0 if begin is None else begin, (DAY_NS if daily else LATEST_NS) if end is None else end, daily)


def _point(text: str, now: int) -> _Point:
    ago = _AGO.fullmatch(text)
    if ago:
        moment = now - int(float(ago[1]) * _UNITS[ago[2]])
        return _Point(moment, moment, ago=True)
    epoch = _EPOCH.fullmatch(text)
    if epoch:
        return _point_with_decimals(int(epoch[1]) * SECOND_NS, epoch[2] or "")
    found = _CLOCK.fullmatch(text)
    if not found or not (found["date"] or found["clock"]):
        raise ValueError(f"time '{text}' is not valid; for instance {EXAMPLES}")
    try:
        return _parse_clock_time(found["date"], found["clock"], found["part"] or "")
    except (ValueError, OverflowError):
        raise ValueError(f"time '{text}' does not exist; for instance {EXAMPLES}") from None


def _point_with_decimals(begin: int, part: str, whole: int = SECOND_NS) -> _Point:
    """A time with the decimals `part` of a second; `whole` is its precision (ns) if there are none."""
    return _Point(
        begin + int(part.ljust(9, "0")), begin + int(part.ljust(9, "0")) + (10 ** (9 - len(part)) if part else whole)
    )


def _parse_clock_time(date: str | None, clock: str | None, part: str) -> _Point:
    hours, minutes, *seconds = (int(each) for each in (clock or "0:00").split(":"))
    if hours > 23 or minutes > 59 or (seconds and seconds[0] > 59) or (part and not seconds):
        raise ValueError
    of_day = (hours * 3600 + minutes * 60 + (seconds[0] if seconds else 0)) * SECOND_NS
    unit = SECOND_NS if seconds else 60 * SECOND_NS
    if date is None:
        point = _point_with_decimals(of_day, part, unit)
        return _Point(point.begin, point.end, daily=True)
    day = time.strptime(date, "%Y-%m-%d")
    begin = int(time.mktime((*day[:3], hours, minutes, seconds[0] if seconds else 0, 0, 0, -1))) * SECOND_NS
    if clock:
        return _point_with_decimals(begin, part, unit)
    year, month, number = day[:3]
    # a day has 23 to 25 hours
    return _Point(begin, int(time.mktime((year, month, number + 1, 0, 0, 0, 0, 0, -1))) * SECOND_NS)
