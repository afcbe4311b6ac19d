"""Finds command lines in the documents, and what is wrong with them."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from pathlib import Path

from bot_console.runtime.ros2cli.command_line import add_command, load, top_parser
from bot_console.tui.cli import arguments
from bot_console.tui.cli import main as program
from bot_console.tui.cli.serve import run as serve
from bot_console.tui.cli.tune import run as tune
from bot_console.tui.cli.verbs import bag, ros2
from bot_console.tui.cli.verbs import run as console_run
from launch.launch_description_sources import get_launch_description_from_any_launch_file

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```bash\n(.*?)^```", re.MULTILINE | re.DOTALL)
INLINE = re.compile(
    r"(?<!`)`((?:NO_COLOR=1 )?bot-console [^`\s]+ [^`]+|ros2 [^`\s]+ [^`\s]+ [^`]+|python tools/[^`]+)`"
)
"""A command in a sentence; a shorter one is only the name of a command."""
OWN = set(
    [
        "stop",
        "release",
        "reset",
        "check",
        "up",
        "down",
        "status",
        "attach",
        "doctor",
        "router",
        "lint",
        "graph",
        "learn",
    ]
)
"""Our own commands whose arguments are not checked."""
ELSEWHERE = {"source", "mkdir", "python3", "pip", "eval", "pytest", "tmux", "cd", "export", "set"}
PACKAGE, SYSTEM = "bot_console_robot", "robot_system.launch.py"
ENVIRONMENT = re.compile(r"[A-Z_]+=.*")


def commands(text: str) -> list[str]:
    """The lines of all shell blocks, and the commands in sentences that contain neither `...` nor placeholders in
    capitals."""
    lines = [line for block in BLOCK.findall(text) for line in block.splitlines() if line.strip()]
    inline = (each.replace("\n", " ") for each in INLINE.findall(text) if "..." not in each)
    return lines + [each for each in inline if not re.search(r"\b[A-Z]{3,}\b(?!_)", each)]


def fault(line: str) -> str:
    """Why a line is not valid; empty if it is."""
    for part in re.split(r"&&|\|\|", line):
        words = shlex.split(part, comments=True)
        while words and ENVIRONMENT.fullmatch(words[0]):
            words = words[1:]
        words = words[: next((at for at, word in enumerate(words) if word in (">", "2>", "|")), len(words))]
        wrong = _fault(words) if words else ""
        if wrong:
            return wrong
    return ""


def _fault(words: list[str]) -> str:
    program, rest = words[0].removeprefix(".venv/bin/"), words[1:]
    if program == "tmux" and "bot-console" in rest:
        return _fault(rest[rest.index("bot-console") :])
    if program == "bot-console":
        return _quietly(lambda: _console(rest))
    if program == "ros2":
        return _quietly(lambda: _ros2(rest))
    if program in ("python", "python3", "pytest"):
        paths = [each for each in rest if each.startswith(("tests/", "tools/", "docs/"))]
        return next((f"there is no {each}" for each in paths if not (ROOT / each).exists()), "")
    known = program in ELSEWHERE or (program.startswith(".") and (ROOT / program).exists())
    return "" if known else f"unknown program {program}"


def _quietly(parse) -> str:
    """The error message of an argparse parser."""
    message = io.StringIO()
    with contextlib.redirect_stderr(message), contextlib.redirect_stdout(io.StringIO()):
        try:
            return parse() or ""
        except SystemExit as stop:
            return message.getvalue() or f"ends with {stop.code}" if stop.code else ""


def _console(words: list[str]) -> str:
    name = words[0] if words else ""
    if name == "run":
        console_run._parser().parse_args(words[1 : 1 + console_run._operand(words[1:])])
        return "" if len(words) > 1 else "names nothing to run"
    if name == "export":
        return "" if len(words) == 2 else "wants one folder"
    if name == "bag":
        bag.parser().parse_args(words[1:])
        return ""
    if name == "ros2":
        return _console(words[1:])
    if name == "serve":
        _, console = serve.command_parser().parse_known_args(words[1:])
        if console[:1] != ["attach"]:
            arguments.parse(console)
        return ""
    if name == "tune":
        tune.command_parser().parse_args(words[1:])
        return ""
    if name == "colcon":
        return ""
    if name == "setup":
        return "" if set("|".join(words[1:]).split("|")) <= {"bash", "zsh", "fish", "editor"} else "is no shell"
    if name in OWN:
        return "" if name in program._COMMANDS else f"there is no command {name}"
    if name in ros2.VERBS or name in program._COMMANDS:
        return _ros2(words)
    given = arguments.parse(words)
    return "" if given.launch else _undeclared(SYSTEM, given.launch_arguments)


def _ros2(words: list[str]) -> str:
    command = load(words[0])
    if command is None:
        return f"there is no command {words[0]}"
    parser = top_parser()
    add_command(parser, command, words)
    given = parser.parse_args(words)
    if words[0] == "launch" and given.package_name == PACKAGE:
        pairs = dict(each.split(":=", 1) for each in given.launch_arguments)
        return _undeclared(given.launch_file_name, pairs) if given.launch_file_name or not given.show_args else ""
    return "" if command.main or len(words) > 1 else "names no verb"


def _undeclared(file: str, given: dict[str, str]) -> str:
    path = ROOT / "launch" / file
    if not path.is_file():
        return f"there is no {path.name}"
    declared = {each.name for each in get_launch_description_from_any_launch_file(str(path)).get_launch_arguments()}
    return ", ".join(f"{file} has no argument {each}" for each in set(given) - declared)
