"""The two lists of the profiles pane: the profiles, and what one of them would change."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.console.model import ConsoleSnapshot, Profile, ProfileDifference, SetOutcome, Value
from bot_console.tui.format import harmless, value_text
from bot_console.tui.widgets.row_list import RowList
from rich.segment import Segment
from rich.style import Style

NAMES = 26
VALUES = 12


class ProfileRows(RowList):
    """The profiles by name; a dot marks the active one, with the number of its values that the robot does not have."""

    def __init__(self) -> None:
        super().__init__()
        self.profiles: Sequence[Profile] = ()
        self.active = ""
        self.changes = 0

    @property
    def current(self) -> Profile | None:
        """The profile at the cursor."""
        return self.profiles[self.cursor] if self.cursor < len(self.profiles) else None

    def show(self, snapshot: ConsoleSnapshot) -> bool:
        """Take new profiles in; whether any came, went or became the active one.

        The cursor goes along with the active profile, so that Enter never means another one by chance.
        """
        new = snapshot.profiles is not self.profiles or snapshot.active_profile != self.active
        if new:
            at = self.current
            along = at is None or at.name == self.active
            self.profiles, self.active = snapshot.profiles, snapshot.active_profile
            self.rows_changed()
            wanted = self.active if along else at.name if at else ""
            names = [each.name for each in self.profiles]
            self.cursor = names.index(wanted) if wanted in names else min(self.cursor, max(0, len(names) - 1))
        if new or snapshot.profile_changes != self.changes:
            self.changes = snapshot.profile_changes
            self.refresh()
        return new

    def row_count(self) -> int:
        """How many profiles there are."""
        return len(self.profiles)

    def row(self, index: int, width: int) -> list[Segment]:
        """Mark, name, title or problem."""
        profile = self.profiles[index]
        mark = "●" if profile.name == self.active else " "
        name = f"{mark} {harmless(profile.name)}"
        style = self.get_component_rich_style("row-list--warn" if profile.problem else "row-list--dim", partial=True)
        changed = f"{self.changes} changed  " if self.changes and profile.name == self.active else ""
        return [
            Segment(name[:22].ljust(min(16, width))),
            Segment(changed, self.get_component_rich_style("row-list--strong", partial=True)),
            Segment(harmless(profile.problem or profile.title), style),
        ]


@dataclass(frozen=True)
class Entry:
    """A line of the differences: a node, one value of it, or below that the reason of a refusal.

    `outcome` is what became of the value when it was applied.
    """

    node: str
    difference: ProfileDifference | None = None
    outcome: SetOutcome | None = None
    reason: str = ""


class DifferenceRows(RowList):
    """What a profile would change, by node."""

    can_focus = False

    def __init__(self) -> None:
        super().__init__()
        self.entries: Sequence[Entry] = ()

    def show(self, entries: Sequence[Entry]) -> None:
        """Show these lines from the top."""
        if entries != self.entries:
            self.entries = entries
            self.rows_changed()

    def row_count(self) -> int:
        """How many lines there are."""
        return len(self.entries)

    def _style(self, name: str) -> Style:
        return self.get_component_rich_style(f"row-list--{name}", partial=True)

    def row(self, index: int, width: int) -> list[Segment]:
        """A node, or `name  now → then` with what is to be said about it."""
        entry = self.entries[index]
        change = entry.difference
        if entry.reason:
            return [Segment(f"    {harmless(entry.reason)}", self._style("error"))]
        if change is None:
            return [Segment(harmless(entry.node), self._style("head"))]
        names = min(NAMES, max(12, width // 3))
        now = harmless(value_text(change.now))[:VALUES] if change.now is not None else "?"
        then = harmless(value_text(change.then))
        note, style = _note(entry, change)
        return [
            Segment(f"  {harmless(change.name)}"[: names - 1].ljust(names)),
            Segment(f"{now:>{VALUES}} → ", self._style("dim")),
            Segment(then[: VALUES * 2].ljust(VALUES), self._style("strong")),
            Segment(f"  {note}", self._style(style)),
        ]


def _note(entry: Entry, change: ProfileDifference) -> tuple[str, str]:
    outcome = entry.outcome
    if outcome is not None:
        return ("✓ taken", "good") if outcome.accepted else ("✗ refused", "error")
    if change.refusal:
        return "✗ would be refused", "error"
    if change.unsafe:
        return f"⚠ {change.unsafe}", "warn"
    return ("needs a world reset", "dim") if change.needs_reset else ("", "dim")


def entries(
    differences: Sequence[ProfileDifference], outcomes: Mapping[tuple[str, str], SetOutcome]
) -> tuple[Entry, ...]:
    """The lines, each node once and its values below it."""
    found: list[Entry] = []
    node: Value = None
    for each in sorted(differences, key=lambda one: (one.node, one.name)):
        if each.node != node:
            node = each.node
            found.append(Entry(each.node))
        outcome = outcomes.get((each.node, each.name))
        found.append(Entry(each.node, each, outcome))
        reason = each.refusal if outcome is None else outcome.reason
        if reason and not (outcome and outcome.accepted):
            found.append(Entry(each.node, reason=reason))
    return tuple(found)
