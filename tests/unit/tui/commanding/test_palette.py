"""What the palette lists first."""

from __future__ import annotations

from bot_console.tui.commanding.palette import Command, options_for


def test_what_begins_with_the_typed_words_comes_before_what_only_has_them() -> None:
    texts = {"line": "Command line: set, plot, layout, record", "record": "Record all topics", "arrange": "Arrange"}
    commands = {id: Command(text, "", lambda: None) for id, text in texts.items()}

    def found(typed: str) -> list[str]:
        return [each.value for each in options_for(commands, lambda line: "", typed)]

    assert found("rec")[:2] == ["record", "line"]
    assert found("line") == ["line"] and found("") == list(texts)
