"""Changes from one SGR style to the next in the fewest bytes (ECMA-48, 8.3.117). Pure."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

RESET = "\x1b[m"
OFF = {"1": "22", "2": "22", "3": "23", "4": "24", "5": "25", "6": "25", "7": "27", "8": "28", "9": "29", "21": "24"}
"""The code that ends each attribute."""


LINES = frozenset(("4", "7", "9", "21", "53"))
"""The attributes that are visible on a blank too: lines and exchanged colours."""


class SgrStyle(NamedTuple):
    """A parsed style: attributes, foreground and background, each as SGR codes; empty for the default."""

    attributes: frozenset[str]
    foreground: str
    background: str


@lru_cache(maxsize=4096)
def parse_style(codes: str) -> SgrStyle:
    """Parse SGR codes such as `1;38;2;1;2;3`."""
    attributes: set[str] = set()
    grounds = ["", ""]
    numbers = codes.split(";") if codes else []
    at = 0
    while at < len(numbers):
        number = numbers[at]
        length = 1
        if number in ("38", "48"):
            length = 5 if numbers[at + 1 : at + 2] == ["2"] else 3
        colour = ";".join(numbers[at : at + length])
        value = int(number or "0")
        if value in (38, *range(30, 38), *range(90, 98)):
            grounds[0] = colour
        elif value in (48, *range(40, 48), *range(100, 108)):
            grounds[1] = colour
        elif number in OFF or value > 9:
            attributes.add(number)
        at += length
    attributes -= {"39", "49"}
    return SgrStyle(frozenset(attributes), grounds[0], grounds[1])


@lru_cache(maxsize=4096)
def style_change(before: str | None, after: str) -> str:
    """The sequence that turns one style into another; `None` is an unknown style."""
    whole = f"\x1b[0;{after}m" if after else RESET
    if before is None:
        return whole
    old, new = parse_style(before), parse_style(after)
    ended = old.attributes - new.attributes
    if not ended <= OFF.keys():
        return whole
    stops = sorted({OFF[each] for each in ended})
    # Bold and faint share one end code, which ends both.
    kept = {each for each in old.attributes & new.attributes if OFF.get(each) not in stops}
    codes = [*stops, *sorted(new.attributes - kept)]
    if new.foreground != old.foreground:
        codes.append(new.foreground or "39")
    if new.background != old.background:
        codes.append(new.background or "49")
    if not codes:
        return ""
    short = f"\x1b[{';'.join(codes)}m"
    return short if len(short) < len(whole) else whole


@lru_cache(maxsize=4096)
def codes_on_blank(codes: str) -> str:
    """The part of a style that is visible on a blank: the background, or all of it with lines or exchanged colours."""
    style = parse_style(codes)
    return codes if style.attributes & LINES else style.background


@lru_cache(maxsize=4096)
def codes_for_blank(before: str, on_blank: str) -> str:
    """The style nearest to the one before in which a blank looks as in `on_blank`."""
    old, new = parse_style(before), parse_style(on_blank)
    if (old.attributes | new.attributes) & LINES:
        return on_blank
    return ";".join(filter(None, (*sorted(old.attributes), old.foreground, new.background)))
