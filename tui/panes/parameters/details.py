"""The details of the parameter at the cursor, as text."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.model import ParameterInfo, SetOutcome, Value
from bot_console.tui.console.parameters.descriptor_faults import NO_DESCRIPTION, faults
from bot_console.tui.console.parameters.safety import risky_change
from bot_console.tui.format import command_of, range_text
from bot_console.tui.text.refusals import in_detail
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text
from rich.text import Text


def details(
    parameter: ParameterInfo,
    refused: SetOutcome | None,
    staged: Value = None,
    marks: Sequence[str] = (),
    late: Value = None,
) -> Text:
    """The details, in order: a pending value, a refusal, a mark, the description, safety, facts, and the command.

    `marks` explains the marks of the row; `late` is a value that the node has not answered yet.
    """
    text = Text(no_wrap=False, overflow="fold")
    if late is not None:
        text.append(
            f"{sanitize(value_text(late))} was sent, and {sanitize(parameter.node)} has not answered yet\n", "bold"
        )
    if refused is not None:
        text.append(f"{in_detail(refused)}\n", "bold")
    if staged is not None:
        text.append(f"→ {sanitize(value_text(staged))} is marked; a applies it, x removes the mark\n", "bold")
    text.append(sanitize(parameter.description) or "No description.")
    if risk := risky_change(parameter):
        text.append(f"\n⚠ {risk}", "bold")
    facts = [parameter.kind.word, range_text(parameter.range, parameter.kind), sanitize(parameter.constraints)]
    facts.append("read only" if parameter.read_only else "")
    facts.append(_default(parameter))
    facts.append(sanitize(parameter.origin))
    facts += marks
    facts += [each for each in faults(parameter) if each != NO_DESCRIPTION]
    text.append("\n" + " · ".join(each for each in facts if each), "dim")
    text.append("\n" + sanitize(command_of(parameter, parameter.value)), "dim italic")
    return text


def _default(parameter: ParameterInfo) -> str:
    """The declared value and where it was declared; if unknown, the start value where it has changed since."""
    value = sanitize(value_text(parameter.default))
    if parameter.declared_at:
        return f"declared {value} in {sanitize(short_place(parameter.declared_at))}"
    return f"start value {value}" if parameter.changed else ""


def short_place(place: str) -> str:
    """Shorten a path to `folder/file.py:12`, which tells files of the same name apart."""
    return "/".join(place.replace("\\", "/").split("/")[-2:])
