"""Reports where a node's parameters come from: what was declared, in which line, and which override won."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from bot_console.runtime.process.facts import anybody_listens, report_fact
from bot_console.runtime.process.frames import line_outside
from rclpy.parameter import Parameter

IN_CODE = "parameter_overrides of its program"


def report_declared(
    node: str, declared: Iterable[tuple[str, Sequence[Any]]], values: Iterable[Any], sources: Mapping[str, str]
) -> None:
    """Report the declarations (full name, tuple) of a node with the resulting values, if anybody listens.

    `sources` are those of overrides. A default that is not a plain value, such as a type, is reported as None.
    """
    if not anybody_listens():
        return
    place = line_outside(sys._getframe(1))  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
    report_fact(
        "declared",
        node=node,
        parameters=[
            [name, _plain(words[1] if len(words) > 1 else None), place, sources.get(name, ""), _plain(value)]
            for (name, words), value in zip(declared, values, strict=True)
        ],
    )


def _plain(value: Any) -> Any:
    """A value for JSON: a scalar, or a list of scalars; bytes, which JSON lacks, as `{"byte": 0 .. 255}`; else None."""
    if isinstance(value, (bool, int, float, str)) or value is None:
        return value
    if isinstance(value, Parameter.Type):
        return None
    plain = getattr(value, "tolist", None)
    try:
        items = plain() if plain is not None else list(value)
    except TypeError:
        return None
    items = [{"byte": each[0]} if isinstance(each, bytes) and each else each for each in items]
    return items if all(isinstance(each, (bool, int, float, str, dict)) for each in items) else None
