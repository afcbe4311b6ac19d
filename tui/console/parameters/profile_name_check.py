"""Checks the names of profiles. Standard library only."""

from __future__ import annotations

import re

_NAME = re.compile(r"[\w][\w .+-]*")


def profile_name_problem(name: str) -> str:
    """Why a text cannot be the name of a profile; empty if it can."""
    return "" if _NAME.fullmatch(name) else f"'{name}' is not a valid profile name: letters, digits, blanks, . + - _"
