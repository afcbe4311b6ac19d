"""The licenses that `pkg create` knows, and their texts."""

from __future__ import annotations

import os

KNOWN = (
    "Apache-2.0",
    "BSL-1.0",
    "BSD-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "GPL-3.0-only",
    "LGPL-3.0-only",
    "MIT",
    "MIT-0",
)
"""SPDX identifiers that ament knows."""

FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "licenses")


def text(identifier: str) -> str:
    """The text of a license; empty for those that are not included, such as the GPL's."""
    path = os.path.join(FOLDER, f"{identifier}.txt")
    if identifier not in KNOWN or not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as file:
        return file.read()
