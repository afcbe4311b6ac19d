"""A finding of `lint`."""

from __future__ import annotations

from dataclasses import dataclass

from bot_console.tui.console.parameters.descriptor_faults import HINTS


@dataclass(frozen=True, order=True)
class LintFinding:
    """A fault, its location, and the parameter or key concerned."""

    place: str
    """The file or the running node."""
    line: int
    """The line in the file; 0 if it concerns no particular line."""
    fault: str
    subject: str
    known: str = ""
    """How to fix this finding, if something better is known than the hint for its kind of fault."""

    @property
    def hint(self) -> str:
        """How to fix it."""
        return self.known or HINTS[self.fault]

    def text(self) -> str:
        """The finding on one line."""
        where = f"{self.place}:{self.line}" if self.line else self.place
        return f"{where}: {self.subject}: {self.fault}; {self.hint}"
