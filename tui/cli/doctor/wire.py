"""Checks of rmw_zenoh's traffic on the wire, by observing tokens and message attachments for a while."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field

from bot_console.runtime.rmw.zenoh.declarations import Declaration
from bot_console.runtime.rmw.zenoh.network.other_domains import other_domains
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.attachment import unpack
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError, data_key
from bot_console.runtime.rmw.zenoh.wire.tokens import (
    ENTITY_PARTS,
    Token,
    TokenNode,
    all_tokens,
    entity_token,
    parse_token,
)
from bot_console.tui.cli.doctor.clock import clock_findings
from bot_console.tui.cli.doctor.finding import DoctorFinding, Level
from bot_console.tui.text.counted import counted

MAX_ATTACHMENTS_PER_KEY = 3
"""Maximum number of attachments that are kept per key."""
GRAPH_TIMEOUT_S = 5.0
NAME = "_bot_console_doctor"
_numbers = itertools.count(1)


@dataclass
class Wire:
    """The observed traffic: tokens as text, and (attachment, size in bytes, arrival time in ns) by key."""

    domain: int
    domains_with_nodes: str = ""
    """The domains that have nodes, if this one has none."""
    tokens: list[str] = field(default_factory=list[str])
    samples: dict[str, list[tuple[bytes | None, int, int]]] = field(
        default_factory=dict[str, "list[tuple[bytes | None, int, int]]"]
    )

    def parsed(self) -> tuple[list[Token], list[str]]:
        """The tokens that follow the format, and those that do not."""
        good: list[Token] = []
        bad: list[str] = []
        for each in self.tokens:
            try:
                good.append(parse_token(each))
            except FormatError:
                bad.append(each)
        return good, bad


def watch_wire(session: Session, seconds: float) -> Wire:
    """Collect all tokens, and listen to every topic of the domain for `seconds`; returns what arrived."""
    wire = Wire(session.domain)
    wire.tokens = _tokens(session)
    good, _ = wire.parsed()
    listening = [_listen(session, wire, each) for each in _publishers(good)]
    threading.Event().wait(seconds)
    for each in listening:
        each.undeclare()
    # Again, since not all tokens of a system that has just started or is busy had reached the router before.
    wire.tokens = sorted({*wire.tokens, *_tokens(session)})
    wire.domains_with_nodes = other_domains(session)
    return wire


def _tokens(session: Session) -> list[str]:
    found, _ = session.collect_tokens(all_tokens(session.domain), GRAPH_TIMEOUT_S)
    return sorted({each for each in found if session.zid not in each})


def _publishers(tokens: Sequence[Token]) -> list[Token]:
    """The publishers, one per topic."""
    return list({each.topic: each for each in tokens if each.kind == "MP"}.values())


def _listen(session: Session, wire: Wire, publisher: Token) -> Declaration:
    """Subscribe as a node would, with a token, because some publishers send only to subscribers that they discover."""
    kept = wire.samples.setdefault(publisher.topic, [])

    def keep(payload: bytes, attachment: bytes | None) -> None:
        if len(kept) < MAX_ATTACHMENTS_PER_KEY:
            kept.append((attachment, len(payload), time.time_ns()))

    domain, topic = session.domain, publisher.topic
    names = publisher.type_name, publisher.type_hash
    listening = session.declare_subscriber(data_key(domain, topic, *names), keep, reliable=False)
    me, qos = TokenNode(session.zid, 0, "", "/", NAME), publisher.key.split("/")[ENTITY_PARTS - 1]
    session.declare_token(entity_token(domain, me, next(_numbers), "MS", topic, *names, qos))
    return listening


def wire_findings(wire: Wire, delay: float) -> list[DoctorFinding]:
    """The faults on the wire; `delay` (s) is the round-trip time of the link."""
    good, bad = wire.parsed()
    nodes = sum(each.kind == "NN" for each in good)
    text = f"{counted(nodes, 'node')}, {counted(len(good) - nodes, 'endpoint')}"
    findings = [DoctorFinding(Level.OK if nodes else Level.WARN, "graph", text)]
    if wire.domains_with_nodes:
        hint = "consoles and other tools do not count"
        findings = [DoctorFinding(Level.WARN, "graph", wire.domains_with_nodes, hint)]
    elif not nodes:
        hint = "does it use the same ROS_DOMAIN_ID, and RMW_IMPLEMENTATION=rmw_zenoh_cpp?"
        findings = [DoctorFinding(Level.WARN, "graph", f"no node is visible in ROS domain {wire.domain}", hint)]
    if bad:
        hint = "another version of rmw_zenoh, or another program: `--capture FILE` saves them for a report"
        findings.append(
            DoctorFinding(Level.WARN, "graph", f"{len(bad)} tokens do not follow the format: {bad[0][:120]}", hint)
        )
    return [*findings, *_attachment_findings(wire), *clock_findings(wire.samples, delay)]


def _attachment_findings(wire: Wire) -> list[DoctorFinding]:
    texts: dict[str, list[str]] = {}
    for topic, samples in sorted(wire.samples.items()):
        for attachment, _, _ in samples:
            try:
                unpack(attachment)
            except FormatError as error:
                texts.setdefault(str(error), []).append(topic)
                break
    return [
        DoctorFinding(Level.FAIL, "messages", f"{', '.join(topics[:4])}: {text}", "update the middleware on that side")
        for text, topics in texts.items()
    ]


def to_capture(wire: Wire, made_with: Sequence[str]) -> dict[str, object]:
    """Everything observed, in the format of the tests."""
    return {
        "format": 1,
        "made_with": list(made_with),
        "domain": wire.domain,
        "tokens": wire.tokens,
        "samples": [
            {"topic": topic, "attachment": None if each is None else each.hex(), "bytes": size, "arrived_ns": arrived}
            for topic, samples in sorted(wire.samples.items())
            for each, size, arrived in samples
        ],
    }
