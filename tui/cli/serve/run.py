"""The `serve` command and its options."""

from __future__ import annotations

import argparse
import ipaddress
import sys
from collections.abc import Sequence

from bot_console.tui.child_command import child_command
from bot_console.tui.cli.arguments import parse
from bot_console.tui.cli.attach_options import parse as parse_attach
from bot_console.tui.cli.main import is_command
from bot_console.tui.cli.numbers import integer, port

SERVABLE = ("attach",)
"""Commands whose console can be served; without a command, it is the console with its own robot."""
MAX_SESSIONS = 100
"""Maximum number of addresses that a server prints."""
EPILOG = """\
The address that is printed opens one console at a time, in one browser: its token is exchanged for a cookie. The
console ends when its tab is closed. ! works in every console; --control allows the rest.

examples:
  bot-console serve attach                          watch and stop what runs here
  bot-console serve --control                       a robot of its own for each browser that opens the address
  bot-console serve --sessions 20                   twenty addresses, for a class
  ssh -L 8000:localhost:8000 robot bot-console serve attach --ros
"""
MISSING = (
    "bot-console serve needs an extra that is not installed ({}): "
    "pip install 'bot-console[serve]' (in a clone: pip install '.[serve]')"
)
EXPOSED_WARNING = (
    "WARNING: {} is reachable from other machines, without encryption: anyone who can read the network traffic gets "
    "in. A tunnel is safer: ssh -L {}:localhost:{} HOST"
)


def run(words: Sequence[str]) -> int:
    """Serve until Ctrl-C; returns 1 if an extra is missing or the port is taken."""
    parser = command_parser()
    given, rest = parser.parse_known_args(words)
    host = _address(parser, given.host)
    console = _console(parser, rest, control=given.control)
    try:
        from bot_console.tui.cli.serve.server import Server, serve
    except ImportError as error:
        print(MISSING.format(error.name), file=sys.stderr)
        return 1
    server = Server(console, host, sessions=given.sessions)
    if not ipaddress.ip_address(host).is_loopback:
        print(EXPOSED_WARNING.format(host, given.port, given.port), file=sys.stderr)
    try:
        return serve(server, given.port)
    except OSError as error:
        print(f"cannot listen on {host}, port {given.port}: {error.strerror}", file=sys.stderr)
        return 1


def command_parser() -> argparse.ArgumentParser:
    """The parser of the options of `serve`; other words are arguments of the console."""
    parser = argparse.ArgumentParser(
        "bot-console serve",
        usage="bot-console serve [--port N] [--host ADDRESS] [--sessions N] [--control] [attach] [OPTION ...]",
        description="Show the console in a browser tab, read-only unless --control is given.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    add = parser.add_argument
    add("--port", type=port, default=8000, metavar="N", help="port to listen on; 0: any free one (default: 8000)")
    add(
        "--host",
        default="127.0.0.1",
        metavar="ADDRESS",
        help="address of this machine to listen on (default: 127.0.0.1)",
    )
    add(
        "--sessions",
        type=integer(1, MAX_SESSIONS),
        default=1,
        metavar="N",
        help="addresses to print, each for one browser (default: 1)",
    )
    add("--control", action="store_true", help="also let the browser set parameters, drive, and start and end programs")
    return parser


def _address(parser: argparse.ArgumentParser, text: str) -> str:
    try:
        address = ipaddress.ip_address("127.0.0.1" if text == "localhost" else text)
    except ValueError:
        parser.error(f"--host: '{text}' is not an address such as 127.0.0.1")
    if address.is_unspecified:
        parser.error(f"--host: {text} means every network; name the address that browsers reach")
    return str(address)


def _console(parser: argparse.ArgumentParser, words: Sequence[str], *, control: bool) -> list[str]:
    """The command that opens a console with these arguments; exits with code 2 if they open none."""
    if words and is_command(words[0]) and words[0] not in SERVABLE:
        parser.error(f"'{words[0]}' does not open a console; the command that can be served is {', '.join(SERVABLE)}")
    opened = [*words] if control else [*words, "--read-only"]
    if words[:1] == ["attach"]:
        parse_attach(opened[1:])
    elif parse(opened).headless:
        parser.error("--headless has no screen to serve")
    return [*child_command("bot_console.tui"), *opened]
