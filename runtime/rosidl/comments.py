"""The comments of a definition file, sorted by what they describe, for editors."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from bot_console.runtime.rosidl.parse import LINE, without_comment


class Comments(NamedTuple):
    """The comments on one part of an interface, without `#`."""

    whole: str
    """The comment above the first field, separated from it by a blank line."""
    members: Mapping[str, str]
    """For each field or constant: the lines directly above it, beside it, and indented below it."""


def comments(text: str) -> Sequence[Comments]:
    """Return the comments of each part of a valid definition file."""
    parts: list[list[str]] = [[]]
    for line in text.splitlines():
        if line.strip() == "---":
            parts.append([])
        else:
            parts[-1].append(line)
    return [_of_part(each) for each in parts]


def _of_part(lines: Sequence[str]) -> Comments:
    whole: list[str] = []
    above: list[str] = []
    members: dict[str, list[str]] = {}
    newest: list[str] | None = None
    for line in lines:
        bare = without_comment(line)
        comment = line[len(bare) :].removeprefix("#").strip()
        match = LINE.match(bare.strip())
        if match is not None:
            newest = members[match["name"]] = [*above, *([comment] if comment else [])]
            above = []
        elif not line.strip():
            if not members:
                whole += [*above, ""]
            above, newest = [], None
        elif newest is not None and line[0].isspace():
            newest.append(comment)
        else:
            above.append(comment)
    return Comments(_joined(whole), {name: _joined(rows) for name, rows in members.items()})


def _joined(rows: Sequence[str]) -> str:
    return textwrap.dedent("\n".join(rows)).strip("\n")
