"""Filter terms for lines like a given one: by its node, severity, text or place."""

from __future__ import annotations

import re
from collections.abc import Iterator

from bot_console.tui.console.model import LogRecord
from bot_console.tui.widgets.prompt.question import Option

NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?")
ANY_NUMBER = r"[-+.\d]+"


def options_like(record: LogRecord, node: str, typed: str) -> list[Option]:
    """The criteria for similar lines, narrowed to those that contain the typed text."""
    options = [Option(what, words, words) for what, words in similarities(record, node)]
    return [each for each in options if typed.lower() in f"{each.title} {each.about}".lower()]


def similarities(record: LogRecord, node: str) -> Iterator[tuple[str, str]]:
    """Descriptions of what similar lines have in common, each with the filter that finds them; `node` is the name."""
    level = record.severity.name.lower()
    of_node = f"node:{_quoted(f'={node}')}" if node else ""
    if of_node:
        yield "this node", of_node
        yield "this node and severity", f"{of_node} sev:{level}"
    yield "this severity", f"sev:{level}"
    first = record.text.partition("\n")[0]
    if NUMBER.search(first):
        yield "this text, whatever the numbers", _pattern(first)
    if first.strip():
        yield "this text", _literal(first)
    if record.file:
        yield "this place", f"at:{_quoted(f'{record.file}:{record.line}')}"


def _quoted(text: str) -> str:
    """The text as a word of the filter grammar, quoted if needed, and cut before the first quotation mark."""
    plain = text.partition('"')[0]
    return f'"{plain}"' if re.search(r"\s", plain) else plain


def _literal(text: str) -> str:
    return f're:"^{_escaped(text)}$"' if '"' in text else f'"{text}"'


def _pattern(text: str) -> str:
    parts = (_escaped(each) for each in NUMBER.split(text))
    return f're:"^{ANY_NUMBER.join(parts)}$"'


def _escaped(text: str) -> str:
    """A text as a regular expression without quotation marks, which would end a word of the grammar."""
    safe = (
        character if character.isalnum() or character == " " or not character.isascii() else f"\\x{ord(character):02x}"
        for character in text
    )
    return "".join(safe)
