"""Describes the result of a tuning job, for people and for programs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bot_console.tui.console.model import Kind, ParameterInfo, Range
from bot_console.tui.text.counted import counted
from bot_console.tui.text.value_text import value_text
from bot_console.tui.tuning.job import Progress, SettingResult
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Tunable


def tunables_of(system: Mapping[str, Any]) -> list[Tunable]:
    """The tunable parameters among those that a probe has found: numbers and booleans that are not read-only."""
    found: list[Tunable] = []
    for node, parameters in system.items():
        if not node.startswith("/"):
            continue
        for name, message in parameters.items():
            value = message["value"]
            if message["read_only"] or not isinstance(value, (bool, int, float)) or name == "use_sim_time":
                continue
            kind = {bool: "bool", int: "integer", float: "double"}[type(value)]
            allowed = Range(*message["range"]) if message["range"] and kind != "bool" else None
            low, high = (allowed.low, allowed.high) if allowed else (0, 1) if kind == "bool" else (-math.inf, math.inf)
            unit = ParameterInfo(node, name, Kind.DOUBLE, value, message["description"]).unit
            found.append(Tunable(node, name, kind, low, high, value, unit, allowed))
    return found


def result_line(specification: TuningSpecification, result: SettingResult) -> str:
    """A setting and its score on one line."""
    values = "  ".join(
        f"{tunable.name} {value_text(value)}"
        for tunable, value in zip(specification.tunables, result.setting, strict=True)
    )
    if result.problem:
        return f"  failed  {values}  {result.problem}"
    bumps = f"  {counted(result.collisions, 'collision')}" if result.collisions else ""
    return f"{result.score:8.3f}  {values}{bumps}"


def gain(before: SettingResult, after: SettingResult) -> str:
    """The relative gain of one result over another, as text; empty if it cannot be computed."""
    if not (math.isfinite(before.score) and math.isfinite(after.score)):
        return ""
    share = (after.score - before.score) / abs(before.score) if before.score else math.inf
    return f"{share:+.0%}" if math.isfinite(share) else ""


def result_data(specification: TuningSpecification, progress: Progress) -> dict[str, Any]:
    """The result as JSON data; its entry `text` has the lines for people."""
    rows, best = progress.rows, progress.best
    result: dict[str, Any] = {
        "profile": specification.profile,
        "worlds": [each for each in specification.worlds if each],
        "score": specification.score.text,
        "search": specification.search,
        "runs": progress.done,
        "seconds": round(progress.elapsed, 3),
        "complete": progress.ended and not progress.problem,
        "settings": [_plain(specification, each) for each in rows],
        "text": [],
    }
    if best is None:
        return result
    worst = min(rows, key=lambda each: each.score)
    result |= {name: _plain(specification, each) for name, each in (("now", rows[0]), ("best", best), ("worst", worst))}
    lines = [
        f"now   {result_line(specification, rows[0])}",
        f"best  {result_line(specification, best)}  {gain(rows[0], best)}",
    ]
    if progress.held_out:
        before, after = progress.held_out
        result["held_out"] = {"now": _plain(specification, before), "best": _plain(specification, after)}
        seeds = counted(len(before.scores), "other seed")
        lines.append(f"on {seeds}: {before.score:.3f} → {after.score:.3f}  {gain(before, after)}")
        if after.score <= before.score and best is not rows[0]:
            lines.append("on other seeds it is no better: use more --seeds, or keep the present values")
    result["text"] = lines
    return result


def _plain(specification: TuningSpecification, result: SettingResult) -> dict[str, Any]:
    values = {tunable.label: value for tunable, value in zip(specification.tunables, result.setting, strict=True)}
    reported: dict[str, Any] = {"values": values, "score": result.score if math.isfinite(result.score) else None}
    reported |= {"scores": list(result.scores), "collisions": result.collisions}
    return reported | ({"problem": result.problem} if result.problem else {})
