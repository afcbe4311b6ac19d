"""The wording of refusals: beside a row, in a parameter's detail, and as a message."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.model import Change, SetOutcome
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text

BY = {"descriptor": "by its descriptor", "callback": "by the node", "console": "here"}
"""The words of `in_detail` for who refused a value."""


def verdict(outcome: SetOutcome) -> str:
    """Return "refused", or "not set" if the node did not answer or lacks the parameter."""
    return "not set" if outcome.refused_by == "node" else "refused"


def verdict_of_change(change: Change) -> str:
    """As `verdict`, for an entry of the journal; empty if the value was accepted."""
    return "" if change.accepted else "refused" if change.answered else "not set"


def beside_row(refused: SetOutcome) -> str:
    """The text beside a parameter's row: the requested value, and why it was refused."""
    return f"✗ {sanitize(value_text(refused.value))}: {sanitize(refused.reason)}"


def in_detail(refused: SetOutcome) -> str:
    """The text in a parameter's detail: the requested value, who refused it, and why."""
    by = BY.get(refused.refused_by, "")
    by_whom = f"{verdict(refused)}{f' {by}' if by else ''}"
    return f"✗ {sanitize(value_text(refused.value))} {by_whom}: {sanitize(refused.reason)}"


def of_one(refused: SetOutcome) -> str:
    """A message about one value that was refused."""
    return f"{refused.node} {refused.name} = {value_text(refused.value)} was {verdict(refused)}: {refused.reason}"


def of_many(outcomes: Sequence[SetOutcome]) -> str:
    """A message about values that were not set because one of them was refused; empty if all were accepted.

    It names a value that a node refused rather than one that the console then did not send.
    """
    refused = [each for each in outcomes if not each.accepted]
    why = next((each for each in refused if each.refused_by != "console"), refused[0] if refused else None)
    return f"Nothing was set: {of_one(why)}" if why is not None else ""
