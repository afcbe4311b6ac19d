"""`bag info`: prints what a bag contains."""

from __future__ import annotations

import argparse
from collections import Counter
from datetime import datetime
from typing import Any

from bot_console.tui.cli.bags.play import report_repaired
from bot_console.tui.cli.bags.record_arguments import SERVICE_EVENTS
from bot_console.tui.text.sanitize import sanitize


def info(given: argparse.Namespace) -> int:
    """Print the contents of a bag; returns 0."""
    from bot_console.tui.console.bags.reader import Bag

    bag = Bag(given.bag)
    report_repaired(bag)
    services = {name for name, topic in bag.topics.items() if is_service(name, topic.type)}
    if given.topic_name:
        print("\n".join(sanitize(each) for each in sorted(bag.topics.keys() - services)))
        return 0
    about = bag.metadata
    rows = [
        ("Files", ", ".join(each.name for each in bag.files)),
        ("Bag size", _size(sum(each.stat().st_size for each in bag.files))),
        ("Storage id", bag.storage),
        ("Duration", f"{(about.end - about.begin) / 1e9:.9f}s"),
        ("Start", _time(about.begin)),
        ("End", _time(about.end)),
        ("Messages", str(about.count)),
    ]
    if about.custom:
        rows.append(("Custom data", ", ".join(f"{key}={value}" for key, value in about.custom.items())))
    lines = [f"{name + ':':<19}{value}" for name, value in rows]
    lines += _under("Topic information:", [_topic(bag.topics[name]) for name in sorted(bag.topics.keys() - services)])
    if services:
        counts = _calls(bag, services) if given.verbose else {}
        shown = [_service(bag.topics[name], counts.get(name)) for name in sorted(services)]
        lines += [f"{'Services:':<19}{len(services)}", *_under("Service information:", shown)]
    print("\n".join(sanitize(line) for line in lines))
    return 0


def is_service(name: str, type_name: str) -> bool:
    """Whether a topic carries the events of a service."""
    return name.endswith(SERVICE_EVENTS) and "/srv/" in type_name and type_name.endswith("_Event")


def _under(title: str, rows: list[str]) -> list[str]:
    width = max(19, len(title) + 1)
    return [f"{title if not at else '':<{width}}{row}" for at, row in enumerate(rows)]


def _topic(topic: Any) -> str:
    return f"Topic: {topic.name} | Type: {topic.type} | Count: {topic.count} | Serialization Format: {topic.encoding}"


def _service(topic: Any, calls: Counter[str] | None) -> str:
    name, kind = topic.name.removesuffix(SERVICE_EVENTS), topic.type.removesuffix("_Event")
    count = f"Event Count: {topic.count}"
    if calls is not None:
        count = f"Request Count: {calls['requests']} | Response Count: {calls['responses']}"
    return f"Service: {name} | Service Type: {kind} | {count} | Serialization Format: {topic.encoding}"


def _calls(bag: Any, services: set[str]) -> dict[str, Counter[str]]:
    """Count sent and received requests and responses, by topic; the kind of an event follows the CDR header."""
    found = {name: Counter[str]() for name in services}
    for entry in bag.messages(services):
        code = entry.data[4] if len(entry.data) > 4 else 0
        found[entry.topic]["requests" if code in (0, 1) else "responses"] += 1
    return found


def _size(count: int) -> str:
    value, unit = float(count), "B"
    for unit in ("B", "KiB", "MiB", "GiB"):
        if value < 1024 or unit == "GiB":
            break
        value /= 1024
    return f"{value:.1f} {unit}" if unit != "B" else f"{count} B"


def _time(stamp: int) -> str:
    when = datetime.fromtimestamp(stamp // 10**9)
    return f"{when:%b %d %Y %H:%M:%S}.{stamp % 10**9:09} ({stamp // 10**9}.{stamp % 10**9:09})"
