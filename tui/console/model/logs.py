"""The log as the panes see it: records, filters, and counts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from types import MappingProxyType


class Severity(IntEnum):
    """Log severities with the codes of `rcl_interfaces/msg/Log`."""

    UNSET = 0
    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One log line; `seq` counts from 0 and never repeats."""

    seq: int
    stamp: int
    severity: Severity
    node: str
    text: str
    file: str = ""
    function: str = ""
    line: int = 0


@dataclass(frozen=True, slots=True)
class LogFilter:
    """Which records to show: those of the severities selected that match the words, and how.

    `words`, like every text of `hidden` and `only`, follows one grammar in every pane: blanks mean AND, `!word`
    excludes, `re:regex`, `node:name`, `sev:>=warn`, `at:file.py:12`, `time:14:03..14:05`.
    """

    minimum: Severity = Severity.UNSET
    words: str = ""
    hidden: tuple[str, ...] = ()
    """Records that pass one of these filters are hidden."""
    only: tuple[str, ...] = ()
    """Records that pass none of these filters are hidden; empty: all are shown."""
    folded: bool = False
    """Whether a run of equal records is shown as one, its newest."""


@dataclass(frozen=True, slots=True)
class LogState:
    """The log as a whole: records `first` to `end` - 1 are kept, `dropped` are gone, `counts` are per severity.

    Errors of processes that were being ended on purpose are not counted.
    """

    first: int = 0
    end: int = 0
    dropped: int = 0
    counts: Mapping[Severity, int] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True, slots=True)
class LoggerLevel:
    """The lowest severity that a logger logs; UNSET means that it inherits its parent's level."""

    node: str
    logger: str
    severity: Severity


def logger_of(node: str) -> str:
    """The name of a node's own logger: `arm.left` for `/arm/left`."""
    return node.strip("/").replace("/", ".")
