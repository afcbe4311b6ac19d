"""Checks of a system reached over Zenoh, on this machine or through a robot's router."""

from __future__ import annotations

import json
import time
from pathlib import Path

from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.domain.roll_call import await_answers
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session, with_environment
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.tui.cli.doctor.finding import DoctorFinding, Level
from bot_console.tui.cli.doctor.graph_checks import node_findings
from bot_console.tui.cli.doctor.wire import to_capture, watch_wire, wire_findings
from bot_console.tui.session.embedded.connecting import connect
from bot_console.tui.session.embedded.domain import domain, take_part
from bot_console.tui.session.embedded.hooks import DomainTypes

FAR_MS = 300
PROBES = 3


def examine(config: ClientConfig | None, seconds: float, capture: Path | None, made_with: str) -> list[DoctorFinding]:
    """Check the link, the wire and the nodes; raises `SessionError`, and `OSError` if the capture cannot be written."""
    session = open_session(domain()) if config is None else open_network_session(domain(), with_environment(config))
    try:
        await_answers(session, session.timeout_s)
        delay = answer_time(session)
        wire = watch_wire(session, seconds)
    finally:
        session.close()
    findings = [] if config is None else [link_finding(str(config), delay)]
    findings += wire_findings(wire, delay or 0.0)
    if capture is not None:
        capture.write_text(json.dumps(to_capture(wire, [made_with]), indent=1) + "\n", encoding="utf-8")
        text = f"{len(wire.tokens)} tokens and {sum(map(len, wire.samples.values()))} attachments are in {capture}"
        findings.append(DoctorFinding(Level.OK, "capture", text))
    if config is None:
        take_part()
    else:
        connect(config)
    return [*findings, *node_findings(_can_learn)]


def _can_learn(type_name: str) -> bool:
    """Whether a node can be asked for the definition of a type."""
    return bool(DomainTypes().inquiries(domain(), type_name))


def answer_time(session: Session) -> float | None:
    """The shortest round-trip time to the other end (s); None without any answer."""
    times: list[float] = []
    for _ in range(PROBES):
        began = time.monotonic()
        if session.answers_ping(1.0):
            times.append(time.monotonic() - began)
    return min(times, default=None)


def link_finding(to: str, delay: float | None) -> DoctorFinding:
    """The latency of the link to the router."""
    if delay is None:
        return DoctorFinding(
            Level.FAIL, "link", f"{to} can be reached, but does not answer", "is it a Zenoh 1.x router?"
        )
    text = f"{to} answers after {delay * 1000:.1f} ms"
    if delay * 1000 > FAR_MS:
        return DoctorFinding(
            Level.WARN, "link", text, "drive slowly, since what you see is that old, or run the console over SSH"
        )
    return DoctorFinding(Level.OK, "link", text)
