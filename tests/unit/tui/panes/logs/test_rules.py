"""Rules of the log: their file, and which lines are similar."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.model import LogRecord, Severity
from bot_console.tui.panes.logs.rules import COLOURS, Rule, RuleBook, rule_of
from bot_console.tui.panes.logs.similar_lines import similarities
from hypothesis import given
from hypothesis import strategies as st


def line(text: str, node: str = "robot", file: str = "", number: int = 0) -> LogRecord:
    return LogRecord(0, 0, Severity.WARN, node, text, file, "spin", number)


def test_rules_are_stored_in_an_editable_file(tmp_path: Path) -> None:
    path = tmp_path / "rules.txt"
    path.write_text("# mine\n\nred sev:error\noff hide node:=/talker\npink noise\n")
    book = RuleBook(path)
    book.read()
    assert book.rules == (Rule("sev:error", "red"), Rule("node:=/talker", "", on=False))
    assert book.problems == [f"{path}:5: a rule begins with hide, {', '.join(COLOURS)}, not with 'pink'"]
    assert book.hidden == () and book.highlighted == ("sev:error",)
    assert book.add("at:nav.py", hide=False) == (Rule("at:nav.py", "violet"), "")
    again = RuleBook(path)
    again.read()
    assert again.rules == book.rules and "pink noise" in path.read_text(), "lines that are not understood stay"


def test_new_rule_gets_an_unused_colour(tmp_path: Path) -> None:
    book = RuleBook(tmp_path / "rules.txt")
    colours = [book.add(f"word{number}", hide=False)[0].colour for number in range(len(COLOURS) + 1)]
    assert colours == [*COLOURS, COLOURS[0]]
    assert book.colour_of(line("has word1")) == COLOURS[1] and book.colour_of(line("none")) == ""


@pytest.mark.parametrize("text", ["hide", "off red", "blue re:(", "green time:25:00"])
def test_rule_without_words_is_rejected(text: str) -> None:
    with pytest.raises(ValueError):
        rule_of(text)


def test_unwritable_file_is_reported(tmp_path: Path) -> None:
    (tmp_path / "rules.txt").mkdir()
    assert "the rules are not saved" in RuleBook(tmp_path / "rules.txt").change([Rule("a")])


@given(
    st.text(max_size=30),
    st.sampled_from(["robot", "/arm/left zoo", 'a"b', "robot_node.py-1"]),
    st.sampled_from(["", "ws/my node.py", "nav.py"]),
)
def test_every_similarity_matches_the_line_itself(text: str, node: str, file: str) -> None:
    record = line(text, node, file, 7)
    for what, words in similarities(record, node):
        assert rule_of(f"hide {words}").words == words.strip(), what
        if '"' not in node or "node" not in what:
            assert parse(words).passes(record), (what, words)


def test_text_similarity_ignores_numbers() -> None:
    found = dict(similarities(line("Obstacle at 0.31 m (-2)"), "/robot"))
    query = parse(found["this text, whatever the numbers"])
    assert query.passes(line("Obstacle at 12 m (4.5)")) and not query.passes(line("An obstacle at 12 m (4.5)"))
