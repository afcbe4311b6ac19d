"""Output of processes: a mark distinguishes a logger's lines, which are added only if `/rosout` lacks them."""

import pytest
from bot_console.tui.console.launch.process_output import (
    ENVELOPE,
    ENVELOPE_VARIABLE,
    FORMAT_VARIABLE,
    ROSOUT_TIMEOUT_S,
    OutputReader,
    ProcessOutput,
    UndecidedLines,
    marking_variables,
)
from hypothesis import given
from hypothesis import strategies as st

RED, RESET = "\x1b[31m", "\x1b[0m"


def marked_line(message: str, on_rosout: str = "0", usual: str = "", stamp: int = 5) -> str:
    fields = {"{severity}": "WARN", "{time_as_nanoseconds}": str(stamp), "{name}": "n", "{file_name}": "f.py",
              "{function_name}": "g", "{line_number}": "7", "{on_rosout}": on_rosout, "{line}": usual,
              "{message}": message}  # fmt: skip
    text = ENVELOPE
    for token, value in fields.items():
        text = text.replace(token, value)
    return text + "\n"


def read(*pieces: str) -> tuple[list[tuple[object, ...]], list[str]]:
    records: list[tuple[object, ...]] = []
    printed: list[str] = []
    reader = OutputReader(lambda record, on_rosout: records.append((*record, on_rosout)), printed.append)
    for piece in pieces:
        reader.feed(piece)
    reader.close()
    return records, printed


def test_a_logger_line_is_recognised_among_prints() -> None:
    records, printed = read("hello\n" + marked_line("two\nlines") + "no end")
    assert records == [(5, 30, "n", "two\nlines", ("f.py", "g", 7), False)]
    assert printed == ["hello", "no end"]


@pytest.mark.parametrize("number", ["\u00b2", "9" * 5000, "9" * 19, "-1", "", "x"])
def test_a_mark_forged_by_a_node_is_harmless(number: str) -> None:
    line = marked_line("x").replace("\x1d5\x1d", f"\x1d{number}\x1d")
    records, printed = read(line, marked_line("after"))
    assert number in line and [record[3] for record in records] == ["after"] and len(printed) == 1
    records, _ = read(marked_line("x").replace("\x1d7\x1d", f"\x1d{number}\x1d"))
    assert [record[3:5] for record in records] == [("x", ("f.py", "g", 0))]


@pytest.mark.parametrize("begin", [pytest.param("", marks=pytest.mark.slow), "\x1e"])
def test_output_without_an_end_is_passed_on_in_parts(begin: str) -> None:
    _, printed = read(begin, *["x" * 65536] * 32)
    assert len(printed) == 2 and sum(map(len, printed)) == 32 * 65536 + len(begin)


def test_a_print_without_newline_before_a_logger_line_is_separate() -> None:
    assert read("prompt> " + marked_line("x"))[1] == ["prompt> "]


def test_colours_around_a_marked_line_are_not_printed_text() -> None:
    records, printed = read(RED + marked_line("x").rstrip("\n") + RESET + "\n" + "after\n")
    assert [record[3] for record in records] == ["x"]
    assert printed == ["after"]


@pytest.mark.parametrize("text", ["has \x1f in it", "has \x1d in it", "ends so \x1f"])
def test_a_message_may_contain_mark_characters(text: str) -> None:
    records, printed = read(marked_line(text, usual=f"[n] {text.split(maxsplit=1)[0]}"))
    assert [record[3] for record in records] == [text]
    assert not printed


@given(
    st.data(), st.lists(st.one_of(st.just("print\n"), st.builds(marked_line, st.text("ab\n ", max_size=5))), max_size=8)
)
def test_the_division_into_pieces_does_not_matter(data: st.DataObject, parts: list[str]) -> None:
    text = "".join(parts)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=6)))
    pieces = [text[a:b] for a, b in zip([0, *cuts], [*cuts, len(text)], strict=True)]
    assert read(*pieces) == read(text)


def test_only_lines_missing_from_rosout_are_added() -> None:
    taken: list[str] = []
    output = ProcessOutput("n-1", lambda *record: taken.append(record[3]), lambda *line: taken.append(line[2]))
    output.feed(marked_line("on both", "1") + marked_line("here alone", "0") + "a print\n", stderr=False)
    output.feed(marked_line("on both", "1"), stderr=True)
    assert taken == ["here alone", "a print"]


def test_a_real_loggers_line_is_added_if_rosout_never_brings_that_logger() -> None:
    now, heard, taken = [0.0], {"n"}, []
    undecided = UndecidedLines(lambda *record: taken.append(record[2]), heard.__contains__, lambda: now[0])
    for name in ("n", "late", "nodeless"):
        undecided.wait((1, 20, name, "x", ("", "", 0)))
    assert not taken
    heard.add("late")
    now[0] = ROSOUT_TIMEOUT_S + 0.1
    undecided.settle()
    assert taken == ["nodeless"]
    undecided.wait((2, 20, "last words", "x", ("", "", 0)))
    undecided.settle(ended=True)
    assert taken == ["nodeless", "last words"]


def test_a_real_logger_prints_the_unknown_field_verbatim() -> None:
    assert read(marked_line("x", "{on_rosout}"))[0][0][-1] is None


def test_a_format_set_by_the_user_stays_inside_the_mark() -> None:
    variables = marking_variables({FORMAT_VARIABLE: "{name}> {message}"})
    assert variables[FORMAT_VARIABLE] == ENVELOPE.replace("{line}", "{name}> {message}")
    assert variables[ENVELOPE_VARIABLE] == ENVELOPE
