"""Command lines and environments of any bytes: each input starts the program in a fork of a loaded process."""

from __future__ import annotations

import base64
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path
from typing import IO, Any, cast

from files import FOLDER

SEPARATOR = "\x1f"
"""Separates the words of a command line, or each `NAME=value` of an environment and the command."""
SAFE = ("stop", "release", "status", "bag", "lint", "param", "node", "interface", "run", "launch")
"""Commands that end by themselves where no system runs, and write nothing; other words are replaced by one of them."""
MEMORY_BYTES, CPU_S, END_S = 4 << 30, 20, 300
"""Limits of one start; `END_S` only ends a start that hangs."""


def command_line(text: str) -> None:
    """Run the program with these words."""
    words = text.split(SEPARATOR)
    if words[0] not in SAFE:
        words[0] = SAFE[0]
    _start(words, {})


def environment(text: str) -> None:
    """Run the program with these variables; the last line is the command."""
    *pairs, command = text.split(SEPARATOR)
    variables = dict(each.partition("=")[::2] for each in pairs)
    _start([command if command in SAFE else "status"], {name: value for name, value in variables.items() if name})


def _start(words: list[str], variables: dict[str, str]) -> None:
    """Start the program; raise unless it exits by itself and without a traceback."""
    starter = _starter()
    request = [[_text(each) for each in words], [[_text(name), _text(value)] for name, value in variables.items()]]
    cast("IO[bytes]", starter.stdin).write(json.dumps(request).encode() + b"\n")
    cast("IO[bytes]", starter.stdin).flush()
    answer = cast("IO[bytes]", starter.stdout).readline()
    assert answer, "the starter has ended"
    status, printed = json.loads(answer)
    assert os.WIFEXITED(status), f"ended by signal {os.WTERMSIG(status)}: {printed[-1500:]}"
    assert "Traceback" not in printed, printed[-1500:]
    assert os.WEXITSTATUS(status) in (0, 1, 2), f"code {os.WEXITSTATUS(status)}: {printed[-500:]}"


def _text(text: str) -> str:
    """Convert a text for JSON: characters below 256 become single bytes, and the end of a C string is left out."""
    data = text.encode("latin-1") if all(ord(each) < 256 for each in text) else text.encode("utf-8", "surrogatepass")
    return base64.b64encode(data.replace(b"\0", b"")).decode()


@cache
def _starter() -> subprocess.Popen[bytes]:
    sockets = Path(tempfile.mkdtemp(prefix="bcs", dir=FOLDER))
    own = {
        "BOT_CONSOLE_USER_DIR": str(FOLDER / "user"), "BOT_CONSOLE_SOCKET_DIR": str(sockets), "HOME": str(FOLDER),
        "ROS_DOMAIN_ID": "79", "ROS_LOG_DIR": str(FOLDER / "logs"),
    }  # fmt: skip
    line = [sys.executable, str(Path(__file__)), "serve"]
    return subprocess.Popen(line, stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=FOLDER, env={**os.environ, **own})


def serve() -> None:
    """Answer each line (the words and the variables of a start) with its status and its stderr."""
    import bot_console.tui.cli.main
    import bot_console.tui.cli.verbs.background
    import bot_console.tui.cli.verbs.stop  # noqa: F401 -- so that the forks need not load them

    for line in sys.stdin.buffer:
        words, variables = json.loads(line)
        with tempfile.TemporaryFile() as printed:
            child = os.fork()
            if not child:
                _run([_bytes(each) for each in words], [(_bytes(a), _bytes(b)) for a, b in variables], printed)
            _, status = os.waitpid(child, 0)
            printed.seek(0)
            answer = [status, printed.read().decode("utf-8", "replace")]
        sys.stdout.write(json.dumps(answer) + "\n")
        sys.stdout.flush()


def _bytes(text: str) -> bytes:
    return base64.b64decode(text)


def _run(words: list[bytes], variables: list[tuple[bytes, bytes]], printed: Any) -> None:
    """Become the program; never return."""
    import traceback

    try:
        os.setsid()
        signal.alarm(END_S)
        resource.setrlimit(resource.RLIMIT_CPU, (CPU_S, CPU_S))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        nowhere = os.open(os.devnull, os.O_RDWR)
        os.dup2(nowhere, 0)
        os.dup2(nowhere, 1)
        os.dup2(printed.fileno(), 2)
        for name, value in variables:
            if b"=" not in name:
                os.environb[name] = value
        sys.argv = ["bot-console", *(os.fsdecode(each) for each in words)]
        from bot_console.tui.cli.main import program

        program()
    except SystemExit as end:
        os._exit(end.code if isinstance(end.code, int) else 1)
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)
    os._exit(0)


if __name__ == "__main__":
    serve()
