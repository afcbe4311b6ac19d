"""Which part of the log is shown: filter, rules, folding; all of it can be suspended and resumed."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from bot_console.tui.console.model import LogFilter, Severity
from bot_console.tui.format import counted
from bot_console.tui.panes.logs.rules import RuleBook

LEVELS = (Severity.UNSET, Severity.INFO, Severity.WARN, Severity.ERROR, Severity.FATAL)


@dataclass
class Filtering:
    """The choices of a person, and the filter that they make."""

    rules: RuleBook
    words: str = ""
    minimum: Severity = Severity.UNSET
    only_highlighted: bool = False
    folded: bool = False
    compact: bool = False
    """Whether there is so little room that equal lines in a row are one anyway."""
    off: bool = field(default=False)
    """Whether everything is shown for now; the choices stay."""

    def which(self) -> LogFilter:
        """The filter."""
        if self.off:
            return LogFilter(folded=self.folded or self.compact)
        only = self.rules.highlighted if self.only_highlighted else ()
        return LogFilter(self.minimum, self.words, self.rules.hidden, only, self.folded or self.compact)

    def narrowed_to(self, words: str = "", minimum: Severity = Severity.UNSET) -> LogFilter:
        """The lines shown that pass these words as well, each for itself."""
        which = self.which()
        both = " ".join(each for each in (which.words, words) if each)
        return replace(which, words=both, minimum=max(minimum, which.minimum), folded=False)

    def next_level(self) -> None:
        """The next least severity, around the end."""
        at = LEVELS.index(self.minimum) if self.minimum in LEVELS else 0
        self.minimum, self.off = LEVELS[(at + 1) % len(LEVELS)], False

    def warnings(self) -> None:
        """Warnings and worse, or everything."""
        self.minimum, self.off = (Severity.UNSET if self.minimum is Severity.WARN else Severity.WARN), False

    def everything(self) -> None:
        """Forget words and severity; rules stay, since they were made to stay."""
        self.words, self.minimum, self.only_highlighted, self.off = "", Severity.UNSET, False, False

    def texts(self) -> list[str]:
        """What narrows the log, in words."""
        hidden = len(self.rules.hidden)
        parts = [
            f"/{self.words}" if self.words else "",
            f">= {self.minimum.name}" if self.minimum else "",
            "highlighted only" if self.only_highlighted else "",
            f"{counted(hidden, 'rule')} {'hides' if hidden == 1 else 'hide'}" if hidden else "",
        ]
        reported = [each for each in parts if each]
        if self.off and reported:
            reported = [f"filters off, t puts them back ({', '.join(reported)})"]
        return [*reported, *(["folded"] if self.folded else [])]
