"""`bot-console stop` and `bot-console release`: use the robot's emergency stop without a screen."""

from __future__ import annotations

import argparse
import sys
import time
from typing import TYPE_CHECKING

from bot_console.runtime.importer import install
from bot_console.runtime.programs.exit_messages import ended_code, place_fault
from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.console.robot.stop_holders import mark_gone
from bot_console.tui.session.embedded.reaching import reach_system
from bot_console.tui.session.reached_stop import ReachedStop
from bot_console.tui.text.sanitize import sanitize

if TYPE_CHECKING:
    from bot_console.tui.console.robot.stop_link import StopInfo

DONE = {"stop": "stopped", "release": "released"}
HOLDER_TIMEOUT_S = 3.0
"""Seconds to find out who holds a robot, and to stop a robot that is about to be ended anyway."""
MAX_ROBOT_POLLS = 30
"""Number of polls for a robot, every 0.1 s; not a time limit, within which a busy machine might make only few polls."""
ANSWER_TIMEOUT_S = 15.0
"""Seconds from the start within which a robot that was found may answer; the request is repeated until then."""


def stop(words: list[str]) -> int:
    """Lock every robot that is found; returns 0 if all have acknowledged it, else 1."""
    return run("stop", words)


def release(words: list[str]) -> int:
    """Release every robot that is found; returns 0 if all are released, else 1."""
    return run("release", words)


def run(verb: str, words: list[str]) -> int:
    """Run `bot-console VERB`, where `verb` is `stop` or `release`; returns the exit code."""
    what = f"{verb.capitalize()} the robot, and wait for its acknowledgement."
    parser = argparse.ArgumentParser(f"bot-console {verb}", description=what)
    if verb == "stop":
        parser.add_argument("reason", nargs="*", help="why, shown to others (default: ALL STOP)")
    else:
        parser.add_argument("--all", action="store_true", help="also release what others have stopped")
    # Whatever the words are, a robot that drives is stopped instead of refusing them.
    is_reason = verb == "stop" and words[:1] not in (["-h"], ["--help"])
    given = argparse.Namespace(reason=" ".join(words) or "ALL STOP") if is_reason else parser.parse_args(words)
    alone = reach_system()
    if alone:
        print(alone, file=sys.stderr)
        return 1
    try:
        done, info = ask(verb, getattr(given, "reason", ""), everybody=getattr(given, "all", False))
    except BaseException as error:
        if ended_code(error):
            print(f"bot-console {verb} was ended before a robot answered", file=sys.stderr)
        elif why := place_fault(error):
            print(f"bot-console {verb}: no robot was {DONE[verb]}: {why}", file=sys.stderr)
            return 1
        raise
    return _report(verb, done, info)


def ask(
    verb: str, reason: str, *, everybody: bool = False, kept: bool = True, answers_s: float = ANSWER_TIMEOUT_S
) -> tuple[bool, StopInfo]:
    """Ask every robot that is found to lock or release; with `everybody`, a release covers the stops of others too.

    A stop that is not `kept` ends with the robot's nodes. Returns whether all robots did so, and their state. A robot
    that was found may answer within `answers_s` from the start.
    """
    install()
    from bot_console.tui.console.robot.stop_link import user

    # The same key for all commands of this person, so that one command releases what another has stopped.
    who, key = f"bot-console {verb} of {user()}", f"bot-console stop of {user()}"
    with ReachedStop("_bot_console_stop", who, key) as reached:
        link = reached.link
        if verb == "stop":
            link.stop(reason, kept=kept)
        polls, until, done = 0, time.monotonic() + answers_s, False
        while not done and (polls < MAX_ROBOT_POLLS or (link.info.locks and time.monotonic() < until)):
            polls += 1
            reached.follow()
            if verb == "release" and not link.releasing and (wanted := _to_release(link.info, everybody)):
                link.release([each.key for each in wanted])
            link.repeat()
            reached.hear()
            left = not link.info.confirmed if verb == "stop" else _to_release(link.info, everybody)
            done = link.info.locks > 0 and link.has_reported and not left
        if verb == "stop" and kept and done and (topics := reached.unlocked()):
            text = f"warning: nothing stops the robots of {' '.join(topics)}: they have no emergency stop"
            print(sanitize(text), file=sys.stderr)
    return done, link.info


def holders(to_find: float = 1.0, to_hear: float = HOLDER_TIMEOUT_S) -> list[str] | None:
    """Who holds the robots that are found, each with a reason; None if a robot with a lock did not answer.

    `to_find` and `to_hear` are the seconds to find a robot, and to receive the state of one that was found.
    """
    install()
    with ReachedStop("_bot_console_status") as reached:
        link, begun = reached.link, time.monotonic()
        while not (link.info.locks and link.has_reported):
            if time.monotonic() - begun > (to_hear if link.info.locks else to_find):
                break
            reached.follow()
            reached.hear()
    return _holder_lines(link.info) if link.has_reported else None


def _holder_lines(info: StopInfo) -> list[str]:
    """Who holds the robot and why, each reason once, with all its holders."""
    holders: dict[str, list[str]] = {}
    for each in mark_gone(info.stops):
        holders.setdefault(each.reason, []).append(each.who)
    return [f"{', '.join(who)}: {reason}" for reason, who in holders.items()]


def _to_release(info: StopInfo, everybody: bool) -> list[RobotStop]:
    """The stops that a release applies to: those of this person and of the nodes, or everybody's."""
    return [each for each in info.stops if each.here or each.by_node or everybody]


def _report(verb: str, done: bool, info: StopInfo) -> int:
    if done and verb == "release" and info.stopped:
        others = "; ".join(_holder_lines(info))
        print(f"still held by {sanitize(others)} (`bot-console release --all` also releases this)", file=sys.stderr)
        return 1
    if done:
        print("held: the robot is locked until a person releases it" if verb == "stop" else "released")
        return 0
    why = "it did not answer" if info.locks else "no robot with an emergency stop was found (see docs/safety.md)"
    if verb == "release" and any(each.by_node for each in info.stops):
        why = f"still held by {sanitize('; '.join(_holder_lines(info)))}"
    sent = "stop sent, not confirmed" if verb == "stop" else "not released"
    print(f"{sent}: {why}", file=sys.stderr)
    return 1
