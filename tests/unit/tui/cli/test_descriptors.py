"""Output to descriptors 1 and 2 that bypasses Python becomes log lines; the screen uses duplicates of them."""

import os
import subprocess
import sys
import threading

from bot_console.tui.cli.foreground.descriptors import captured_descriptors

PROGRAM = """
import os, sys
from bot_console.tui.cli.foreground.descriptors import captured_descriptors

reported = []
with captured_descriptors(lambda severity, label, text: reported.append((label, text))):
    os.write(2, b"a warning of a library\\nhalf")
    os.write(2, b" a line\\n\\n")
    os.system("echo from a child")
    sys.__stderr__.write("<screen>")
    sys.__stdout__.write("<out>")
    print("is a screen:", os.isatty(sys.__stdout__.fileno()), file=sys.__stdout__)
os.write(2, b"<after>")
print(reported)
"""


def test_lines_are_reported_and_only_the_screen_writes_to_the_screen() -> None:
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, timeout=240, check=True)
    assert done.stderr == "<screen><after>"
    out, reported = done.stdout.split("\n", 1)
    assert out == "<out>is a screen: False"
    lines = [text for _, text in eval(reported)]
    assert sorted(lines) == ["a warning of a library", "from a child", "half a line"]
    assert {label for label, _ in eval(reported)} == {"stderr"}


def test_notice_of_the_runtime_does_not_go_to_the_screen() -> None:
    imports = "from bot_console.runtime.process import MAIN\nfrom bot_console.runtime.process.notices import notify\n"
    program = imports + PROGRAM.replace('os.system("echo from a child")', 'notify(MAIN, "a message was dropped")')
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=240, check=True)
    assert done.stderr == "<screen><after>"
    assert "[WARN] [main]: a message was dropped" in done.stdout


def test_child_that_outlives_the_console_does_not_block_its_end() -> None:
    program = PROGRAM.replace('"echo from a child"', '"sleep 150 &"')
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=240, check=True)
    assert b"half a line" in done.stdout


def test_lines_written_before_the_end_are_reported_however_slow_the_log_is() -> None:
    reported: list[str] = []
    begun = threading.Event()

    def report(severity: int, label: str, text: str) -> None:
        if not reported:
            begun.set()
            threading.Event().wait(0.6)
        reported.append(text)

    with captured_descriptors(report):
        os.write(1, b"the first\n")
        assert begun.wait(240)
        os.write(1, b"written later\n" * 4000)
        subprocess.Popen(["sh", "-c", "while echo more; do :; done"], stderr=subprocess.DEVNULL)
    assert reported[:4001] == ["the first"] + ["written later"] * 4000


def test_descriptors_are_restored() -> None:
    before = [os.fstat(number)[:3] for number in (1, 2)], sys.__stdout__, sys.__stderr__
    with captured_descriptors(lambda *line: None):
        assert [os.fstat(number)[:3] for number in (1, 2)] != before[0]
    assert ([os.fstat(number)[:3] for number in (1, 2)], sys.__stdout__, sys.__stderr__) == before
