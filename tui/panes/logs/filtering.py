"""What narrows the log: filter, rules and folding; filter and rules can be suspended and resumed."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from bot_console.tui.console.model import LogFilter, Severity
from bot_console.tui.panes.logs.rules import RuleBook
from bot_console.tui.text.counted import counted

LEVELS = (Severity.UNSET, Severity.INFO, Severity.WARN, Severity.ERROR, Severity.FATAL)


@dataclass
class Filtering:
    """The user's choices, and the filter that results from them."""

    rules: RuleBook
    words: str = ""
    minimum: Severity = Severity.UNSET
    only_highlighted: bool = False
    folded: bool = True
    """Whether consecutive equal lines are shown as one."""
    off: bool = field(default=False)
    """Whether the filter is suspended; the choices are kept."""

    def log_filter(self) -> LogFilter:
        """The filter that results from the choices."""
        if self.off:
            return LogFilter(folded=self.folded)
        only = self.rules.highlighted if self.only_highlighted else ()
        return LogFilter(self.minimum, self.words, self.rules.hidden, only, self.folded)

    def narrowed_to(self, words: str, minimum: Severity) -> LogFilter:
        """The filter narrowed to lines that also match these words, and with repeats not folded."""
        which = self.log_filter()
        both = " ".join(each for each in (which.words, words) if each)
        return replace(which, words=both, minimum=max(minimum, which.minimum), folded=False)

    def next_level(self) -> None:
        """Go to the next minimum severity; after the last one, to the first."""
        at = LEVELS.index(self.minimum) if self.minimum in LEVELS else 0
        self.minimum, self.off = LEVELS[(at + 1) % len(LEVELS)], False

    def toggle_warnings(self) -> None:
        """Switch between warnings and worse, and everything."""
        self.minimum, self.off = (Severity.UNSET if self.minimum is Severity.WARN else Severity.WARN), False

    def clear(self) -> None:
        """Clear words and severity; rules stay, since they are meant to last."""
        self.words, self.minimum, self.only_highlighted, self.off = "", Severity.UNSET, False, False

    def texts(self) -> list[str]:
        """Descriptions of everything that narrows the log."""
        hidden = len(self.rules.hidden)
        parts = [
            f"/{self.words}" if self.words else "",
            f">= {self.minimum.name}" if self.minimum else "",
            "highlighted only" if self.only_highlighted else "",
            f"{counted(hidden, 'rule')} {'hides' if hidden == 1 else 'hide'}" if hidden else "",
        ]
        reported = [each for each in parts if each]
        if self.off and reported:
            reported = [f"filters off, t restores them ({', '.join(reported)})"]
        return reported
