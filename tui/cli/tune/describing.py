"""The result of a tuning, for people and for programs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bot_console.tui.console.model import Kind, ParameterInfo
from bot_console.tui.format import counted, value_text
from bot_console.tui.tuning.dial import Dial
from bot_console.tui.tuning.question import Question
from bot_console.tui.tuning.study import Judged, Progress


def dials_of(system: Mapping[str, Any]) -> list[Dial]:
    """The tunable parameters among those a probe has found: numbers and booleans that are not read-only."""
    found: list[Dial] = []
    for node, parameters in system.items():
        if not node.startswith("/"):
            continue
        for name, said in parameters.items():
            value = said["value"]
            if said["read_only"] or not isinstance(value, (bool, int, float)) or name == "use_sim_time":
                continue
            kind = {bool: "bool", int: "integer", float: "double"}[type(value)]
            low, high = (0, 1) if kind == "bool" else said["range"] or (-math.inf, math.inf)
            unit = ParameterInfo(node, name, Kind.DOUBLE, value, said["description"]).unit
            found.append(Dial(node, name, kind, low, high, value, unit))
    return found


def line_of(question: Question, judged: Judged) -> str:
    """A setting and its score on one line."""
    values = "  ".join(
        f"{dial.name} {value_text(value)}" for dial, value in zip(question.dials, judged.setting, strict=True)
    )
    if judged.problem:
        return f"  failed  {values}  {judged.problem}"
    bumps = f"  {counted(judged.collisions, 'collision')}" if judged.collisions else ""
    return f"{judged.score:8.3f}  {values}{bumps}"


def gain(before: Judged, after: Judged) -> str:
    """How much better one is than the other, in words."""
    if not (math.isfinite(before.score) and math.isfinite(after.score)):
        return ""
    share = (after.score - before.score) / abs(before.score) if before.score else math.inf
    return f"{share:+.0%}" if math.isfinite(share) else ""


def result_of(question: Question, progress: Progress) -> dict[str, Any]:
    """The result for programs; `text` holds it as lines for people."""
    rows, best = progress.rows, progress.best
    result: dict[str, Any] = {
        "profile": question.profile,
        "worlds": [each for each in question.worlds if each],
        "score": question.score.text,
        "search": question.search,
        "runs": progress.done,
        "seconds": round(progress.elapsed, 3),
        "complete": progress.ended and not progress.problem,
        "settings": [_plain(question, each) for each in rows],
        "text": [],
    }
    if best is None:
        return result
    worst = min(rows, key=lambda each: each.score)
    result |= {name: _plain(question, each) for name, each in (("now", rows[0]), ("best", best), ("worst", worst))}
    lines = [f"now   {line_of(question, rows[0])}", f"best  {line_of(question, best)}  {gain(rows[0], best)}"]
    if progress.held_out:
        before, after = progress.held_out
        result["held_out"] = {"now": _plain(question, before), "best": _plain(question, after)}
        seeds = counted(len(before.scores), "other seed")
        lines.append(f"on {seeds}: {before.score:.3f} → {after.score:.3f}  {gain(before, after)}")
        if after.score <= before.score and best is not rows[0]:
            lines.append("on seeds that it was not chosen by it is no better: more --seeds, or stay with what is")
    result["text"] = lines
    return result


def _plain(question: Question, judged: Judged) -> dict[str, Any]:
    values = {dial.label: value for dial, value in zip(question.dials, judged.setting, strict=True)}
    told: dict[str, Any] = {"values": values, "score": judged.score if math.isfinite(judged.score) else None}
    told |= {"scores": list(judged.scores), "collisions": judged.collisions}
    return told | ({"problem": judged.problem} if judged.problem else {})
