"""The two lists of the profiles pane: the profiles, and what one of them would change."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from textwrap import wrap

from bot_console.tui.console.model import Profile, ProfileDifference, SetOutcome, Value
from bot_console.tui.panes.profiles.dry_run import DryRun
from bot_console.tui.text.counted import counted
from bot_console.tui.text.refusals import verdict
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.item_list import ItemList
from rich.cells import cell_len
from rich.segment import Segment

MIN_NAME_CELLS = 16
"""Minimum cells of the profile column."""
MIN_PARAMETER_CELLS = 26
"""Minimum cells of the parameter column, if there is room for that."""
VALUE_CELLS = 12
"""Cells of the present value; the new one may be twice as long."""
NOTE_CELLS = 12
"""Cells reserved for the note about a change."""
REASON_INDENT_CELLS = 4
"""Indentation (cells) of a reason."""


class ProfileRows(ItemList[Profile]):
    """The profiles by name; a dot marks the active one, with the number of values that have changed since."""

    def __init__(self) -> None:
        super().__init__()
        self.active = ""
        self.changes = 0

    def key(self, item: Profile) -> object:
        """The profile's name."""
        return item.name

    def show(self, profiles: Sequence[Profile], active: str, changes: int) -> bool:
        """Show profiles; returns whether any was added or removed, or has become the active one.

        The cursor follows the active profile, so that Enter never applies another one by accident.
        """
        new = profiles != self.rows or active != self.active
        if new:
            at, before = self.current, self.active
            self.active = active
            self.exchange(profiles)
            names = [each.name for each in profiles]
            if (at is None or at.name == before) and active in names:
                self.cursor = names.index(active)
        if new or changes != self.changes:
            self.changes = changes
            self.refresh()
        return new

    def row(self, index: int, width: int) -> list[Segment]:
        """Mark, name, number of changed values, and title or problem."""
        profile = self.rows[index]
        mark = "●" if profile.name == self.active else " "
        longest = max(cell_len(sanitize(each.name)) for each in self.rows) + 4
        room = min(max(longest, MIN_NAME_CELLS), max(MIN_NAME_CELLS, width // 2))
        name = cut(f"{mark} {sanitize(profile.name)}", room - 2)
        style = self.row_style("warn" if profile.problem else "dim")
        changed = f"{self.changes} changed  " if self.changes and profile.name == self.active else ""
        return [
            Segment(name + " " * (room - cell_len(name))),
            Segment(changed, self.row_style("strong")),
            Segment(sanitize(profile.problem or profile.title), style),
        ]


@dataclass(frozen=True)
class Entry:
    """A line of the differences: a node, one of its values, or the reason of a refusal below either.

    `outcome` is the result of applying the value; `message` is the note beside a node, with its style.
    """

    node: str
    difference: ProfileDifference | None = None
    outcome: SetOutcome | None = None
    reason: str = ""
    message: tuple[str, str] = ("", "dim")


class DifferenceRows(ItemList[Entry]):
    """The changes that a profile would make, by node."""

    can_focus = False

    def row(self, index: int, width: int) -> list[Segment]:
        """A node, or `name  now → then` with a note."""
        entry = self.rows[index]
        change = entry.difference
        if entry.reason:
            return [Segment(" " * REASON_INDENT_CELLS + entry.reason, self.row_style("error"))]
        if change is None:
            message, style = entry.message
            return [
                Segment(f"{sanitize(entry.node)}  ", self.row_style("head")),
                Segment(message, self.row_style(style)),
            ]
        longest = max(cell_len(sanitize(each.difference.name)) for each in self.rows if each.difference) + 4
        names = max(min(max(longest, MIN_PARAMETER_CELLS), width - NOTE_CELLS - 3 * VALUE_CELLS), 12)
        now = cut(sanitize(value_text(change.now)), VALUE_CELLS) if change.now is not None else "?"
        then = cut(sanitize(value_text(change.then)), 2 * VALUE_CELLS)
        note, style = _note(entry, change)
        return [
            Segment(cut(f"  {sanitize(change.name)}", names - 2, pad=True) + "  "),
            Segment(" " * (VALUE_CELLS - cell_len(now)) + now + " → ", self.row_style("dim")),
            Segment(then + " " * (VALUE_CELLS - cell_len(then)), self.row_style("strong")),
            Segment(f"  {note}", self.row_style(style)),
        ]


def _note(entry: Entry, change: ProfileDifference) -> tuple[str, str]:
    outcome = entry.outcome
    if outcome is not None:
        return ("✓ accepted", "good") if outcome.accepted else (f"✗ {verdict(outcome)}", "error")
    if change.unknown:
        return "unknown to its node, left out", "dim"
    if change.refusal:
        return "✗ would be refused", "error"
    if change.unsafe:
        return f"⚠ {change.unsafe}", "warn"
    return ("needs a world reset", "dim") if change.needs_reset else ("", "dim")


def outcome_text(name: str, outcomes: Sequence[SetOutcome], unknown: int) -> str:
    """The outcome of applying a profile; `unknown` counts the values that were left out."""
    taken = sum(each.accepted for each in outcomes)
    if not outcomes:
        return f"{name}: nothing to set" + (f", its {counted(unknown, 'value')} are unknown here" if unknown else "")
    parts = [f"{taken} accepted"]
    failed = Counter(verdict(each) for each in outcomes if not each.accepted)
    parts += [f"{count} {why}" for why, count in failed.items()]
    parts += [f"{unknown} unknown here, left out"] if unknown else []
    return f"{name}: {', '.join(parts)}"


def entries(
    differences: Sequence[ProfileDifference],
    outcomes: Mapping[tuple[str, str], SetOutcome],
    asking: DryRun,
    width: int = 80,
) -> tuple[Entry, ...]:
    """The lines: each node once, followed by its values. The nodes' checks are shown until the profile is applied.

    A reason is wrapped to a width (cells), since nothing else shows it before the profile is applied.
    """
    refusals: Mapping[str, str] = {} if outcomes else asking.refusals()
    found: list[Entry] = []
    node: Value = None
    for each in sorted(differences, key=lambda one: (one.node, one.name)):
        if each.node != node:
            node = each.node
            found.append(Entry(each.node, message=("", "dim") if outcomes else asking.words(each.node)))
            found += _wrapped_reason(each.node, refusals.get(each.node, ""), width)
        outcome = outcomes.get((each.node, each.name))
        found.append(Entry(each.node, each, outcome))
        reason = each.refusal if outcome is None else outcome.reason
        if reason and not each.unknown and not (outcome and outcome.accepted):
            found += _wrapped_reason(each.node, reason, width)
    return tuple(found)


def _wrapped_reason(node: str, reason: str, width: int) -> list[Entry]:
    return [Entry(node, reason=line) for line in wrap(sanitize(reason), max(20, width - REASON_INDENT_CELLS))]
