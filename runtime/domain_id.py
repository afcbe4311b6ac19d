"""The ROS domain ID from the environment."""

from __future__ import annotations

import os
import re

VARIABLE = "ROS_DOMAIN_ID"
DEFAULT_DOMAIN = 2**64 - 1
"""The value that means "not given" to rcl, so that -1 in the environment means domain 0."""
MAX_DOMAIN = 10**10 - 1
"""Far above the limit of DDS (232), but short enough for the path of a socket."""
_NUMBER = re.compile(r"[ \t\n\v\f\r]*([+-]?)(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)")


def domain_id() -> int:
    """Return the domain ID from the environment, 0 if none is set; raises `ValueError` for an invalid one."""
    text = os.environ.get(VARIABLE, "")
    found = parse_domain(text)
    if found is None:
        raise ValueError(f"{VARIABLE} is '{text[:40]}', not a number")
    return found


def parse_domain(text: str) -> int | None:
    """Parse a domain ID as rcl does with `strtoul`: `0x5` and `5 a` are 5; None if it is not a number or too large.

    An empty text means domain 0, and so does -1.
    """
    if not text:
        return 0
    found = _NUMBER.match(text)
    if found is None:
        return None
    sign, digits = found.groups()
    base = 16 if digits[:2] in ("0x", "0X") else 8 if digits[0] == "0" else 10
    try:
        number = int(digits, base)
    except ValueError:  # thousands of digits
        return None
    if number == 0 and found.end() < len(text):
        return None
    if sign == "-":
        number = -number % (DEFAULT_DOMAIN + 1)
    if number == DEFAULT_DOMAIN:
        return 0
    return number if number <= MAX_DOMAIN else None
