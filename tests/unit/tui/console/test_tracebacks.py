"""A traceback in the log: the exception first, then the user's own frames, with library frames folded."""

import sysconfig

from bot_console.tui.console.logs.tracebacks import TRACEBACK, PrintedLines, Traceback

LIBRARY = sysconfig.get_path("stdlib")
LINES = [
    TRACEBACK,
    f'  File "{LIBRARY}/runpy.py", line 88, in _run_code',
    "    exec(code, run_globals)",
    '  File "/home/u/ws/robot/node.py", line 40, in main',
    "    rclpy.spin(node)",
    f'  File "{LIBRARY}/threading.py", line 9, in run',
    "    self._target()",
    f'  File "{LIBRARY}/queue.py", line 10, in get',
    '  File "/home/u/ws/robot/node.py", line 12, in on_scan',
    "    speed = table['speed']",
    "            ~~~~~^^^^^^^^^",
    "KeyError: 'speed'",
]


def log_records(lines: list[str]) -> list[tuple[int, str]]:
    got: list[tuple[int, str]] = []
    stream = PrintedLines("node-1", lambda severity, label, text: got.append((severity, text)), stderr=True)
    for line in lines:
        stream.line(line)
    stream.close()
    return got


def test_the_exception_is_first_and_the_users_frames_follow() -> None:
    assert log_records(["before", *LINES, "after"]) == [
        (30, "before"),
        (40, "KeyError: 'speed'\n"
             '  File "/home/u/ws/robot/node.py", line 12, in on_scan\n'
             "    speed = table['speed']\n"
             "  (2 calls in libraries)\n"
             '  File "/home/u/ws/robot/node.py", line 40, in main\n'
             "    rclpy.spin(node)\n"
             "  (1 call in libraries)"),
        (30, "after"),
    ]  # fmt: skip


def test_the_reason_names_the_users_line() -> None:
    assert Traceback(LINES).reason == "KeyError: 'speed' (node.py:12)"


def test_all_frames_are_shown_if_none_is_the_users() -> None:
    found = Traceback([LINES[0], *LINES[1:3], "OSError: no"])
    assert found.reason == "OSError: no"
    assert "runpy.py" in found.text()


def test_a_syntax_error_is_shown_with_its_place() -> None:
    text = Traceback(
        [TRACEBACK, '  File "/home/u/a.py", line 3', "    def x(", "         ^", "SyntaxError: bad"]
    ).text()
    assert text.startswith("SyntaxError: bad\n")
    assert 'File "/home/u/a.py", line 3' in text


def test_a_chained_exception_names_its_cause() -> None:
    link = "During handling of the above exception, another exception occurred:"
    (_, first), (_, second) = log_records([*LINES, link, TRACEBACK, *LINES[3:5], "ValueError: bad"])
    assert first.startswith("KeyError")
    assert second.splitlines()[:2] == ["ValueError: bad", "  while handling KeyError: 'speed'"]


def test_a_fault_is_the_last_thing_printed() -> None:
    stream = PrintedLines("node-1", lambda *each: None, stderr=True)
    for line in LINES:
        stream.line(line)
    assert stream.fault == "KeyError: 'speed' (node.py:12)"
    stream.line("went on")
    assert not stream.fault


def test_a_truncated_traceback_is_shown_as_far_as_it_came() -> None:
    (severity, text), = log_records(LINES[:5])  # fmt: skip
    assert severity == 40
    assert "rclpy.spin(node)" in text


def test_an_invalid_line_number_is_treated_as_text() -> None:
    [(_, text)] = log_records([TRACEBACK, f'  File "a.py", line {"9" * 5000}, in f', "ValueError: bad"])
    assert "ValueError: bad" in text
