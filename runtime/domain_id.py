"""The ROS domain ID from the environment."""

from __future__ import annotations

import os

VARIABLE = "ROS_DOMAIN_ID"
MAX_DIGITS = 10


def domain_id() -> int:
    """Return the domain ID from the environment, 0 if none is set; raises `ValueError` for an invalid one."""
    text = os.environ.get(VARIABLE, "")
    if not is_domain(text):
        raise ValueError(f"{VARIABLE} is '{text[:40]}', not a number")
    return int(text or 0)


def is_domain(text: str) -> bool:
    """Whether a text is a domain ID; an empty one means domain 0."""
    return not text or (text.isascii() and text.isdecimal() and len(text) <= MAX_DIGITS)
