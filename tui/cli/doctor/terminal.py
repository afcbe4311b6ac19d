"""Checks of the terminal: size, characters and colours, and its latency."""

from __future__ import annotations

import contextlib
import locale
import os
import re
import select
import shutil
import sys
import time
from collections.abc import Generator, Mapping

from bot_console.tui.cli.doctor.finding import DoctorFinding, Level

ABOUT = "terminal"
ASK, ANSWER = b"\x1b[6n", re.compile(rb"\x1b\[\d+;\d+R")
ANSWER_TIMEOUT_S = 3.0
"""Seconds to wait for the terminal's answer."""
BURST = b"\x1b[0m" * 4096
"""16 kB of output that shows nothing."""
SLOW_DELAY_MS, SLOW_KB_S = 300, 20
MAX_MEASURABLE_KB_S = 3000
"""The highest rate that the burst can measure; beyond it, the burst takes less time than answers vary by."""


def terminal_findings(environment: Mapping[str, str]) -> list[DoctorFinding]:
    """All checks of the terminal that a console would use."""
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        return [DoctorFinding(Level.NOTE, ABOUT, "this is not a terminal: size, colours and delay were not checked")]
    found = [size_finding(*shutil.get_terminal_size()), characters_finding(), colours_finding(environment)]
    if os.name != "nt":
        found.append(terminal_link_finding(*_measure()))
    return found


def size_finding(columns: int, lines: int) -> DoctorFinding:
    """Whether the terminal is large enough."""
    if columns < 60 or lines < 20:
        return DoctorFinding(
            Level.FAIL, ABOUT, f"{columns}x{lines} is too small", "make it 60x20 or more; 80x24 is usual"
        )
    more = "" if columns >= 100 and lines >= 30 else "; from 100x30, several panes are shown at once"
    return DoctorFinding(Level.OK, ABOUT, f"{columns}x{lines}{more}")


def characters_finding(encoding: str = "") -> DoctorFinding:
    """Whether the terminal's locale can show lines and braille."""
    encoding = encoding or locale.getpreferredencoding(False)
    if encoding.lower().replace("-", "") == "utf8":
        return DoctorFinding(Level.OK, ABOUT, "UTF-8")
    return DoctorFinding(
        Level.WARN,
        ABOUT,
        f"its locale is {encoding}, so lines and curves are drawn in ASCII",
        "export LANG=C.UTF-8 before starting the console",
    )


def colours_finding(environment: Mapping[str, str]) -> DoctorFinding:
    """The number of colours that the terminal's name promises."""
    term = environment.get("TERM", "")
    if environment.get("COLORTERM", "") in ("truecolor", "24bit"):
        return DoctorFinding(Level.OK, ABOUT, f"{term}, 16 million colours")
    if "256color" in term or "kitty" in term or "direct" in term:
        return DoctorFinding(Level.OK, ABOUT, f"{term}, 256 colours")
    hint = "export TERM=xterm-256color, if the terminal is compatible (tmux: TERM=tmux-256color)"
    return DoctorFinding(Level.WARN, ABOUT, f"TERM={term or '(empty)'} promises only few colours", hint)


def terminal_link_finding(delay: float | None, bytes_per_s: float | None) -> DoctorFinding:
    """The terminal's delay (s) and throughput; None where they could not be measured."""
    if delay is None or bytes_per_s is None:
        return DoctorFinding(
            Level.NOTE, ABOUT, f"it did not report its cursor position within {ANSWER_TIMEOUT_S:g} s: delay unknown"
        )
    rate = (
        f"{bytes_per_s / 1000:,.0f}"
        if bytes_per_s <= MAX_MEASURABLE_KB_S * 1000
        else f"more than {MAX_MEASURABLE_KB_S:,}"
    )
    text = f"answers after {delay * 1000:.0f} ms, takes {rate} kB/s"
    if delay * 1000 > SLOW_DELAY_MS or bytes_per_s < SLOW_KB_S * 1000:
        return DoctorFinding(
            Level.WARN, ABOUT, text, "over a slow link, show one pane: `bot-console --pane parameters`"
        )
    return DoctorFinding(Level.OK, ABOUT, text)


def _measure() -> tuple[float | None, float | None]:
    with _raw():
        delay = _answer_to(ASK)
        if delay is None:
            return None, None
        whole = _answer_to(BURST + ASK)
    if whole is None:
        return delay, None
    return delay, len(BURST) / max(whole - delay, 1e-4)


def _answer_to(question: bytes) -> float | None:
    """Seconds from a query to the terminal's answer; None if there was none."""
    began = time.monotonic()
    os.write(sys.stdout.fileno(), question)
    answer = b""
    while not ANSWER.search(answer):
        left = ANSWER_TIMEOUT_S - (time.monotonic() - began)
        if left <= 0 or not select.select([sys.stdin], [], [], left)[0]:
            return None
        answer += os.read(sys.stdin.fileno(), 64)
    return time.monotonic() - began


@contextlib.contextmanager
def _raw() -> Generator[None]:
    import termios
    import tty

    sys.stdout.flush()
    before = termios.tcgetattr(sys.stdin)
    try:
        tty.setcbreak(sys.stdin)
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSANOW, before)
