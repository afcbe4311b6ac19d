"""Writes `docs/bot-console.1`, the manual page, from the parser's options and the table in `docs/command-line.md`.

    python tools/man_page.py

A test compares the page with the code; run this script after changing an option or a command.
"""

from __future__ import annotations

import argparse
import re
from pathlib import Path

from bot_console.tui.cli.arguments import option_parser

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGE = DOCS / "bot-console.1"
_COMMAND_ROW = re.compile(r"^\| (.+) \| (.+) \|$", re.MULTILINE)


def manual_page() -> str:
    """The page in the `man` macros of roff."""
    parser = option_parser()
    sections = [
        '.TH BOT\\-CONSOLE 1 "" "bot\\-console" "User Commands"',
        ".SH NAME\nbot\\-console \\- rqt for the terminal, with the robot included",
        f".SH SYNOPSIS\n{_roff(_synopsis(parser))}\n.br\n.B bot\\-console\n.I command\n[\\fIargument\\fR ...]",
        f".SH DESCRIPTION\n{_roff(DESCRIPTION)}",
        ".SH COMMANDS\n" + "\n".join(f".TP\n.B {_roff(name)}\n{_roff(text)}" for name, text in _commands()),
        ".SH OPTIONS\n" + "\n".join(_option(action) for action in parser._actions if action.option_strings),
        ".SH EXIT STATUS\n0 on success, 1 on failure (one line says why), 2 for wrong usage.",
        f".SH ENVIRONMENT\n.TP\n.B ROS_DOMAIN_ID\n{_roff(DOMAIN)}\n.TP\n.B NO_COLOR\n{_roff(NO_COLOR)}",
    ]
    return "\n".join(sections) + "\n"


DESCRIPTION = """\
Shows the parameters, log, node graph, plots, map, steering and launch files of a ROS 2 system in the terminal.
Without a command, it starts a simulated robot and opens the console on it. Press ? for the keys of the current pane,
! to stop the robot, and q to quit. No ROS 2 installation is needed."""
DOMAIN = "The domain that the system runs in; terminals with the same domain share one system."
NO_COLOR = "If set, the console uses no colours."


def _synopsis(parser: argparse.ArgumentParser) -> str:
    return " ".join(parser.format_usage().removeprefix("usage:").split())


def _commands() -> list[tuple[str, str]]:
    table = (DOCS / "command-line.md").read_text(encoding="utf-8").partition("\n## ")[0]
    rows = _COMMAND_ROW.findall(table)[2:]
    return [(_plain(names), _plain(text)) for names, text in rows]


def _plain(markdown: str) -> str:
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", markdown).replace("`", "")


def _option(action: argparse.Action) -> str:
    names = ", ".join(f"\\fB{_roff(each)}\\fR" for each in action.option_strings)
    choices = "{" + ",".join(map(str, action.choices)) + "}" if action.choices else ""
    value = "" if action.nargs == 0 else f" \\fI{_roff(action.metavar or choices or action.dest.upper())}\\fR"
    return f".TP\n{names}{value}\n{_roff(action.help or '')}"


def _roff(text: object) -> str:
    """Escape text for roff, in which a line must not begin with a control character."""
    escaped = str(text).replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^(?=[.'])", r"\\&", escaped, flags=re.MULTILINE)


if __name__ == "__main__":
    PAGE.write_text(manual_page(), encoding="utf-8")
