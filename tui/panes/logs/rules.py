"""Rules that hide or highlight log lines: one per line in filter syntax, stored in the user's folder."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from bot_console.tui.console.filter_syntax import Query, parse
from bot_console.tui.console.model import LogRecord
from bot_console.tui.files.folders import config_folder
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.files.store_file import read_store

COLOURS = ("violet", "green", "blue", "lime", "orange", "red")
HIDE, OFF = "hide", "off"
MAX_FILE_BYTES = 100_000
"""Maximum size of a rule file in bytes; a larger one is ignored."""
HEAD = f"""\
# Rules of the log, one per line: `{HIDE}` or a colour ({", ".join(COLOURS)}), then the words of a filter.
# `{OFF}` in front of a rule switches it off. `F` in the Logs pane shows and changes them.
"""


@dataclass(frozen=True)
class Rule:
    """A rule that hides matching lines, or shows them in a colour."""

    words: str
    colour: str = ""
    """One of `COLOURS`; empty to hide the lines."""
    on: bool = True

    @property
    def text(self) -> str:
        """The rule as a line of the file."""
        return f"{'' if self.on else f'{OFF} '}{self.colour or HIDE} {self.words}"


def rule_of(line: str) -> Rule:
    """Parse a line of the file; raises `ValueError` for an invalid rule."""
    off, _, rest = line.strip().partition(" ")
    kind, _, words = (rest.strip() if off == OFF else line.strip()).partition(" ")
    words = words.strip()
    if kind != HIDE and kind not in COLOURS:
        raise ValueError(f"a rule begins with {HIDE}, {', '.join(COLOURS)}, not with '{kind[:40]}'")
    if not words:
        raise ValueError(f"the rule '{kind}' has no words")
    parse(words)
    return Rule(words, "" if kind == HIDE else kind, off != OFF)


class RuleBook:
    """All rules, and the file in which they are stored."""

    def __init__(self, path: Path | None = None) -> None:
        self.path = path or config_folder() / "log-rules.txt"
        self.rules: tuple[Rule, ...] = ()
        self.problems: list[str] = []
        self._invalid_lines: list[str] = []
        """Invalid lines of the file; they are written back, so that a typo does not lose a rule."""
        self._marks: tuple[tuple[Query, str], ...] = ()

    def read(self) -> None:
        """Read the file. Never raises; `problems` lists what could not be read."""
        try:
            content = read_store(self.path, MAX_FILE_BYTES)
        except FileNotFoundError:
            return
        except OSError as error:
            self.problems = [f"{self.path}: {error.strerror or error}"]
            return
        found: list[Rule] = []
        for number, line in enumerate(content.decode("utf-8", "replace").splitlines(), 1):
            if line.strip() and not line.startswith("#"):
                try:
                    found.append(rule_of(line))
                except ValueError as error:
                    self._invalid_lines.append(line)
                    self.problems.append(f"{self.path}:{number}: {error}")
        self._take(found)

    def change(self, rules: Sequence[Rule]) -> str:
        """Replace and store the rules; returns why they could not be stored, or an empty text."""
        self._take(rules)
        lines = [HEAD, *(f"{each.text}\n" for each in rules), *(f"{each}\n" for each in self._invalid_lines)]
        try:
            save_file(self.path, "".join(lines))
        except NotSaved as error:
            return f"the rules are not saved: {error}"
        return ""

    def add(self, words: str, *, hide: bool) -> tuple[Rule, str]:
        """Add a rule, in the least used colour if it highlights; returns it with the message of `change`."""
        used = [each.colour for each in self.rules]
        colour = "" if hide else min(COLOURS, key=used.count)
        rule = Rule(words, colour)
        same = [each for each in self.rules if each.words != words or bool(each.colour) is hide]
        return rule, self.change([*same, rule])

    def _take(self, rules: Sequence[Rule]) -> None:
        self.rules = tuple(rules)
        self._marks = tuple((parse(each.words), each.colour) for each in rules if each.on and each.colour)

    @property
    def hidden(self) -> tuple[str, ...]:
        """The filters of hidden lines."""
        return tuple(each.words for each in self.rules if each.on and not each.colour)

    @property
    def highlighted(self) -> tuple[str, ...]:
        """The filters of highlighted lines."""
        return tuple(each.words for each in self.rules if each.on and each.colour)

    def colour_of(self, record: LogRecord) -> str:
        """The colour of a line by the first rule that it matches; empty if none does."""
        return next((colour for query, colour in self._marks if query.passes(record)), "")


def with_next_colour(rule: Rule) -> Rule:
    """The same rule in the next colour; after the last colour, it hides."""
    kinds = (*COLOURS, "")
    return replace(rule, colour=kinds[(kinds.index(rule.colour) + 1) % len(kinds)])
