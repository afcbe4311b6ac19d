"""`bot-console router`: runs a Zenoh router, for a robot without one or to reach this machine's programs."""

from __future__ import annotations

import argparse
import signal
import sys
import threading
from collections.abc import Sequence
from types import FrameType

from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession
from bot_console.runtime.rmw.zenoh.network.reachability import PORT, Tls, place_of
from bot_console.runtime.rmw.zenoh.network.router import Router
from bot_console.runtime.rmw.zenoh.session import Session, SessionError
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.tui.cli.interruptible_wait import wait_interruptibly
from bot_console.tui.session.embedded.domain import domain

HERE = f"tcp/127.0.0.1:{PORT}"
LOOPBACK = ("127.", "localhost", "::1")
OPEN = (
    "WARNING: anyone who can reach {} can drive this robot, set its parameters and read all its messages; {}. Use it "
    "only on a network where everybody may do so; otherwise use tls/ with --tls-ca, and an access list "
    "(docs/your-robot.md)."
)


def run(words: Sequence[str]) -> int:
    """Route messages until Ctrl-C, SIGTERM or SIGHUP; returns 1 if it cannot listen."""
    parser = _parser()
    given = parser.parse_args(words)
    serving = parse_serving(parser, given.listen or [HERE], given)
    warning = exposure_warning(serving)
    if warning:
        print(warning, file=sys.stderr, flush=True)
    try:
        session = _open(serving, given.config, mesh=given.mesh)
    except (SessionError, RuntimeError) as error:
        print(error, file=sys.stderr)
        return 1
    over = threading.Event()

    def end(number: int, frame: FrameType | None) -> None:
        over.set()

    for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(each, end)
    what = "the programs in this ROS domain can be reached" if given.mesh else "a router for nodes of rmw_zenoh"
    how = "; Ctrl-C ends it" if sys.stdin.isatty() else ""  # `up --serve` has no terminal
    print(f"{what} at {', '.join(serving.endpoints)}{how}", flush=True)
    wait_interruptibly(over)
    session.close()
    return 0


def add_serving_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for serving over TLS; see `parse_serving`."""
    add = parser.add_argument
    add("--tls-certificate", default="", metavar="FILE", help="certificate to present")
    add("--tls-key", default="", metavar="FILE", help="its private key")
    add("--tls-ca", default="", metavar="FILE", help="accept only clients with a certificate of this authority")


def parse_serving(parser: argparse.ArgumentParser, endpoints: Sequence[str], given: argparse.Namespace) -> Serving:
    """The endpoints to listen on, with TLS; exits with code 2 if they are invalid."""
    tls = Tls(given.tls_ca, given.tls_certificate, given.tls_key)
    if problem := tls.problem():
        parser.error(problem)
    for each in endpoints:
        try:
            protocol, _, _ = place_of(each)
        except ValueError as error:
            parser.error(str(error))
        if protocol in ("tls", "quic") and not tls.certificate:
            parser.error(f"{each} needs --tls-certificate and --tls-key")
    return Serving(tuple(endpoints), tls.as_listener())


def exposure_warning(serving: Serving) -> str:
    """A warning about the risk of listening there; empty if only this machine can connect."""
    outside = [each for each in serving.endpoints if not place_of(each)[1].startswith(LOOPBACK)]
    if not outside:
        return ""
    mutual = serving.tls.get("enable_mtls") and all(place_of(each)[0] == "tls" for each in outside)
    asked = "clients need a certificate of your authority" if mutual else "clients need no credentials"
    return OPEN.format(", ".join(outside), asked)


def _open(serving: Serving, config: str, *, mesh: bool) -> Session:
    if mesh:
        session = MeshSession(domain(), serving)
        session.watch()
        return session
    return Router(serving, config)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "bot-console router",
        description="Run a Zenoh router, for nodes of rmw_zenoh and for `attach --connect`.",
    )
    add = parser.add_argument
    add(
        "--listen",
        action="append",
        metavar="ENDPOINT",
        help=f"endpoint to listen on; may be repeated (default: {HERE}, for this machine alone)",
    )
    add(
        "--mesh",
        action="store_true",
        help="also connect the programs of this machine's ROS domain, which listen on no port",
    )
    add("--config", default="", metavar="FILE", help="Zenoh configuration, for instance with an access list")
    add_serving_options(parser)
    return parser
