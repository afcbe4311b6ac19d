"""Output of processes: marked logger lines become records, prints become lines, nothing shows twice."""

from bot_console.tui.console.process_output import MARKED_FORMAT, Once, OutputReader, Printed
from hypothesis import given
from hypothesis import strategies as st


def marked(message: str, stamp: int = 5, severity: str = "WARN") -> str:
    fields = {"{severity}": severity, "{time_as_nanoseconds}": str(stamp), "{name}": "n", "{file_name}": "f.py",
              "{function_name}": "g", "{line_number}": "7", "{message}": message}  # fmt: skip
    text = MARKED_FORMAT
    for token, value in fields.items():
        text = text.replace(token, value)
    return text + "\n"


def read(*pieces: str) -> tuple[list[tuple[object, ...]], list[str]]:
    records: list[tuple[object, ...]] = []
    printed: list[str] = []
    reader = OutputReader(lambda *record: records.append(record), printed.append)
    for piece in pieces:
        reader.feed(piece)
    reader.close()
    return records, printed


def test_a_logger_line_among_prints() -> None:
    records, printed = read("hello\n" + marked("two\nlines") + "no end")
    assert records == [(5, 30, "n", "two\nlines", ("f.py", "g", 7))]
    assert printed == ["hello", "no end"]


def test_a_print_without_an_end_before_a_logger_line() -> None:
    assert read("prompt> " + marked("x"))[1] == ["prompt> "]


def test_a_record_comes_once_by_either_way() -> None:
    got: list[str] = []
    once = Once(lambda stamp, severity, name, text, site: got.append(text))
    for stamp, text in [(1, "a"), (1, "a"), (2, "a"), (2, "a"), (3, "b")]:
        once.record(stamp, 20, "n", text, ("", "", 0))
    assert got == ["a", "a", "b"]


@given(st.data(), st.lists(st.one_of(st.just("print\n"), st.builds(marked, st.text("ab\n ", max_size=5))), max_size=8))
def test_pieces_do_not_matter(data: st.DataObject, parts: list[str]) -> None:
    text = "".join(parts)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=6)))
    pieces = [text[a:b] for a, b in zip([0, *cuts], [*cuts, len(text)], strict=True)]
    assert read(*pieces) == read(text)


def test_a_traceback_is_one_error() -> None:
    got: list[tuple[int, str, str]] = []
    printed = Printed("node-1", lambda *each: got.append(each), stderr=True)
    for line in [
        "before",
        "Traceback (most recent call last):",
        '  File "a.py", line 3, in f',
        "    x",
        "KeyError: 1",
        "after",
    ]:
        printed.line(line)
    printed.line("Traceback (most recent call last):")
    printed.close()
    assert [(severity, text.splitlines()[-1]) for severity, _, text in got] == [
        (30, "before"), (40, "KeyError: 1"), (30, "after"), (40, "Traceback (most recent call last):")]  # fmt: skip
    assert "line 3" in got[1][2]
