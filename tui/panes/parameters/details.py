"""What is known of the parameter at the cursor, in words."""

from __future__ import annotations

from bot_console.tui.console.model import ParameterInfo, SetOutcome
from bot_console.tui.format import command_of, harmless, range_text, value_text
from rich.text import Text

REFUSED_BY = {"descriptor": "by its descriptor", "callback": "by the node", "console": "here"}


def details(parameter: ParameterInfo, refused: SetOutcome | None) -> Text:
    """A refusal first, then description, facts, and the command that does the same."""
    text = Text(no_wrap=False, overflow="fold")
    if refused is not None:
        by = REFUSED_BY.get(refused.refused_by, "")
        head = f"✗ {harmless(value_text(refused.value))} refused{f' {by}' if by else ''}: "
        text.append(f"{head}{harmless(refused.reason)}\n", "bold")
    text.append(harmless(parameter.description) or "(no description)")
    facts = [parameter.kind.word, range_text(parameter.range, parameter.kind), harmless(parameter.constraints)]
    facts.append("read only" if parameter.read_only else "")
    facts.append(f"start value {harmless(value_text(parameter.default))}" if parameter.changed else "")
    facts.append(harmless(parameter.origin))
    text.append("\n" + " · ".join(each for each in facts if each), "dim")
    text.append("\n" + harmless(command_of(parameter, parameter.value)), "dim italic")
    return text
