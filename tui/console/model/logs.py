"""The log as the panes see it: records, filters and counts."""

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
    """Which records to show, and how: those with at least the severity `minimum` that match `words`.

    `words` and the texts in `hidden` and `only` follow the grammar of all panes: blanks mean AND, `!word` excludes,
    `re:regex`, `node:name`, `sev:>=warn`, `at:file.py:12`, `time:14:03..14:05`.
    """

    minimum: Severity = Severity.UNSET
    words: str = ""
    hidden: tuple[str, ...] = ()
    """Filters; records that pass one of them are hidden."""
    only: tuple[str, ...] = ()
    """Filters; records that pass none of them are hidden. Empty: all are shown."""
    folded: bool = False
    """Whether a run of equal records is shown as one, the newest."""


@dataclass(frozen=True, slots=True)
class LogState:
    """The state of the log: records `first` to `end` - 1 are kept, `dropped` have been discarded, `counts` are by
    severity.

    Errors of processes whose end had been requested are not counted.
    """

    first: int = 0
    end: int = 0
    dropped: int = 0
    counts: Mapping[Severity, int] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True, slots=True)
class LoggerLevel:
    """The lowest severity that a logger logs; UNSET means that it inherits the level of its parent."""

    node: str
    logger: str
    severity: Severity


def logger_of(node: str) -> str:
    """The name of a node's own logger: `arm.left` for `/arm/left`."""
    return node.strip("/").replace("/", ".")
