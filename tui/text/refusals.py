"""The wording of refusals: beside a row, in a parameter's detail, and as a message."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.model import Change, SetOutcome
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text

BY = {"descriptor": "by its descriptor", "callback": "by the node", "console": "here"}
"""Who refused, in the words of the detail."""


def verdict(outcome: SetOutcome) -> str:
    """Whether a value was refused, or not set since its node did not answer or lacks the parameter."""
    return "not set" if outcome.refused_by == "node" else "refused"


def verdict_of_change(change: Change) -> str:
    """The same for an entry of the journal; empty if the value was accepted."""
    return "" if change.accepted else "refused" if change.answered else "not set"


def beside_row(refused: SetOutcome) -> str:
    """The requested value, and why it was refused."""
    return f"✗ {sanitize(value_text(refused.value))}: {sanitize(refused.reason)}"


def in_detail(refused: SetOutcome) -> str:
    """The same, with who refused it."""
    by = BY.get(refused.refused_by, "")
    by_whom = f"{verdict(refused)}{f' {by}' if by else ''}"
    return f"✗ {sanitize(value_text(refused.value))} {by_whom}: {sanitize(refused.reason)}"


def of_one(refused: SetOutcome) -> str:
    """A message about one value that was refused."""
    return f"{refused.node} {refused.name} = {value_text(refused.value)} was {verdict(refused)}: {refused.reason}"


def of_many(outcomes: Sequence[SetOutcome]) -> str:
    """A message about values none of which was set because one was refused; empty if all were accepted.

    The value that a node refused comes before those that the console then held back.
    """
    refused = [each for each in outcomes if not each.accepted]
    why = next((each for each in refused if each.refused_by != "console"), refused[0] if refused else None)
    return f"Nothing was set: {of_one(why)}" if why is not None else ""
