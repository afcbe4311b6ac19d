"""The conditions of a step, one per line: a verb and its words. Parsed here, checked by `condition_check.py`. Pure."""

from __future__ import annotations

import re
import shlex
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from bot_console.tui.pane_table import PANES


class Verb(NamedTuple):
    """The form of a condition: its usage, and the least and most words that it takes."""

    usage: str
    least: int
    most: int
    once: bool
    """True for something that was done, which stays done; False for a state, which can be lost again."""


VERBS: Mapping[str, Verb] = {
    "saw-node": Verb("saw-node NAME|* [with PARAMETER] [as WORD]", 1, 5, True),
    "saw-parameter": Verb("saw-parameter NAME [described] [limited] [== VALUE]", 1, 5, True),
    "saw-set": Verb("saw-set PARAMETER [VALUE]", 1, 2, True),
    "saw-refused": Verb("saw-refused PARAMETER [part of the reason]", 1, 2, True),
    "saw-command": Verb(
        "saw-command WORD ... (those that the command line has to contain, in this order)", 1, 12, True
    ),
    "saw-failure": Verb(
        "saw-failure WORD ... (of a command line that ended with an exit code that is not 0)", 1, 12, True
    ),
    "saw-launch": Verb("saw-launch FILE [NAME:=VALUE|NAME:=*] [contains TEXT]", 1, 4, True),
    "saw-topic": Verb("saw-topic NAME", 1, 1, True),
    "saw-pane": Verb("saw-pane PANE", 1, 1, True),
    "saw-curve": Verb("saw-curve TEXT (part of its path)", 1, 1, True),
    "saw-layout": Verb("saw-layout NAME|*", 1, 1, True),
    "saw-profile": Verb("saw-profile NAME|*", 1, 1, True),
    "saw-steering": Verb("saw-steering", 0, 0, True),
    "saw-move": Verb("saw-move METRES", 1, 1, True),
    "expect-file": Verb("expect-file PATTERN [contains TEXT|lacks TEXT]", 1, 3, False),
    "expect-entry-point": Verb("expect-entry-point NAME|*", 1, 1, False),
    "expect-installed": Verb("expect-installed PATTERN (of files that data_files has to install)", 1, 1, False),
    "expect-parameter-file": Verb("expect-parameter-file PATTERN [PARAMETER [VALUE]]", 1, 3, False),
    "expect-no-findings": Verb("expect-no-findings PATTERN (of lint)", 1, 1, False),
}
"""The verbs of conditions: `saw-` for something that was done, `expect-` for a state of the workspace."""
PANE_WORDS = frozenset(("overview", *(each.id for each in PANES)))
PLUGIN_PREFIX = "plugin_"
"""The prefix of the name of a pane from another package."""


@dataclass(frozen=True)
class Condition:
    """One line: its verb and words, and `hint`, which is added to what is missing while it does not hold."""

    verb: str
    words: tuple[str, ...]
    text: str
    line: int = 0
    hint: str = ""

    @property
    def once(self) -> bool:
        """Whether it stays fulfilled once it has been."""
        return VERBS[self.verb].once


def read_condition(text: str, line: int = 0) -> Condition:
    """Parse `VERB WORD ... [-- hint]`; raises `ValueError`, with the line number, for anything else."""
    before, _, hint = text.partition(" -- ")
    try:
        words = shlex.split(before)
    except ValueError as error:
        raise ValueError(f"{line}: {error}; put words that contain blanks or quotes into quotes") from None
    verb = VERBS.get(words[0])
    if verb is None:
        raise ValueError(f"{line}: '{words[0][:40]}' is not one of {', '.join(VERBS)}")
    given = tuple(words[1:])
    if not verb.least <= len(given) <= verb.most:
        raise ValueError(f"{line}: write {verb.usage}")
    if why := _wrong(words[0], given):
        raise ValueError(f"{line}: write {verb.usage} ({why})")
    return Condition(words[0], given, before.strip(), line, hint.strip())


def _wrong(verb: str, words: tuple[str, ...]) -> str:
    """The expected form of the words after a verb if they are wrong; empty if they are valid."""
    if verb == "saw-move":
        return "" if re.fullmatch(r"\d+(\.\d+)?", words[0]) else "a length in m"
    if verb == "saw-pane":
        own = words[0].startswith(PLUGIN_PREFIX)
        return "" if own or words[0] in PANE_WORDS else f"one of {', '.join(sorted(PANE_WORDS))}, {PLUGIN_PREFIX}NAME"
    if verb == "expect-file" and len(words) > 1:
        return "" if words[1] in ("contains", "lacks") and len(words) == 3 else "contains TEXT, lacks TEXT"
    if verb == "saw-launch" and len(words) > 1:
        rest = words[2:] if ":=" in words[1] else words[1:]
        return "" if not rest or (rest[0] == "contains" and len(rest) == 2) else "NAME:=VALUE, contains TEXT"
    if verb == "saw-node":
        rest = words[1:]
        return "" if len(rest) % 2 == 0 and set(rest[::2]) <= {"with", "as"} else "with PARAMETER, as WORD"
    if verb == "saw-parameter":
        rest = [each for each in words[1:] if each not in ("described", "limited")]
        return "" if not rest or (rest[0] == "==" and len(rest) == 2) else "described, limited, == VALUE"
    return ""
