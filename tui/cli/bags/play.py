"""`bag play` and `bag burst`: publish the messages of bags; keys pause, step, seek and change the rate."""

from __future__ import annotations

import argparse
import sys
import threading
from collections.abc import Callable
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any

from bot_console.tui.cli.bags.common import generic_types, make_node, report_unused, service_types, spin
from bot_console.tui.cli.bags.keyboard import read_keys
from bot_console.tui.cli.bags.play_arguments import (
    NOT_NEEDED,
    bag_paths,
    chosen_topics,
    end_time,
    play_problem,
    span_problem,
)
from bot_console.tui.console.bags.damage import BagError
from bot_console.tui.console.bags.definitions import class_of
from bot_console.tui.console.bags.playing.control_topics import left_out_warning
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize

if TYPE_CHECKING:
    from bot_console.tui.console.bags.playing.player import Player
    from rclpy.node import Node

PROGRESS_S = 0.1
"""Seconds between two updates of the progress line."""
SEEK_S = 5.0
"""Seconds of the bag by which a key seeks."""
RATE_FACTOR = 1.1
KEYS_HELP = "space pause  → next message  ←/pgup -5 s  pgdn +5 s  home begin  ↑↓ rate  l loop  q quit"


def play(given: argparse.Namespace) -> int:
    """Play bags; 0 done, 1 failed, 2 wrong options."""
    prepared = _prepare(given)
    if isinstance(prepared, int):
        return prepared
    node, player = prepared
    _offer_services(node, player)
    stopped = threading.Event()
    shown = not given.disable_keyboard_controls and sys.stderr.isatty()
    keys = nullcontext(False) if given.disable_keyboard_controls else read_keys(lambda key: press(player, key, stopped))

    def run() -> None:
        player.await_subscriptions(stopped)
        if not stopped.wait(given.delay):
            player.run(stopped)

    with keys as readable:
        if readable and shown:
            print(KEYS_HELP, file=sys.stderr)
            node.create_timer(PROGRESS_S, lambda: print(f"\r{progress_line(player)}\x1b[K", end="", file=sys.stderr))
        problem = _run(node, run, stopped)
    if readable and shown:
        print(f"\r{progress_line(player)}\x1b[K", file=sys.stderr)
    if given.wait_for_all_acked is not None and node.context.ok():  # an interrupt also ends the waiting
        player.wait_for_acknowledgements(given.wait_for_all_acked)
    return _report(player, problem)


def burst(given: argparse.Namespace) -> int:
    """Publish messages as fast as possible; 0 done, 1 failed, 2 wrong options."""
    given = argparse.Namespace(
        **vars(given), rate=1.0, loop=False, start_paused=True, clock=0.0, clock_topics=[], clock_topics_all=False,
        playback_duration=-1.0, playback_until_sec=-1.0, playback_until_nsec=-1,
    )  # fmt: skip
    prepared = _prepare(given)
    if isinstance(prepared, int):
        return prepared
    node, player = prepared
    stopped = threading.Event()

    def run() -> None:
        player.await_subscriptions(stopped)
        if not stopped.is_set():
            player.burst(given.num_messages)

    return _report(player, _run(node, run, stopped))


def press(player: Player, key: str, stopped: threading.Event) -> None:
    """Carry out a key pressed while a bag is playing."""
    if key == "space":
        player.paused = not player.paused
    elif key == "right":
        player.step()
    elif key in ("left", "pageup", "pagedown"):
        player.seek(player.position + int((SEEK_S if key == "pagedown" else -SEEK_S) * 1e9))
    elif key == "home":
        player.seek(player.begin)
    elif key in ("up", "down"):
        player.rate *= RATE_FACTOR if key == "up" else 1 / RATE_FACTOR
    elif key == "l":
        player.loop = not player.loop
    elif key == "q":
        stopped.set()


def progress_line(player: Player) -> str:
    """The state of a player on one line."""
    return player.state.text()


def _prepare(given: argparse.Namespace) -> tuple[Node, Player] | int:
    """Create a node and a player; if that fails, print why and return the exit code."""
    from bot_console.tui.console.bags.merged_bags import MergedBags
    from bot_console.tui.console.bags.playing.player import PlaybackOptions, Player
    from bot_console.tui.console.bags.qos import read_overrides
    from bot_console.tui.console.bags.reader import Bag
    from rclpy.logging import LoggingSeverity

    if wrong := play_problem(given):
        print(sanitize(wrong), file=sys.stderr)
        return 2
    report_unused(given, NOT_NEEDED)
    bags = [Bag(each) for each in bag_paths(given)]
    for each in bags:
        report_repaired(each)
    bag = MergedBags(bags)
    if wrong := span_problem(given, *bag.span):
        print(wrong, file=sys.stderr)
        return 2
    overrides = given.qos_profile_overrides_path
    try:
        qos = read_overrides(overrides.read_text(encoding="utf-8")) if overrides else {}
    except (OSError, ValueError) as error:
        print(sanitize(f"{overrides}: {error}"), file=sys.stderr)
        return 1
    node = make_node("rosbag2_player", machine=given.ros)
    if node is None:
        return 1
    node.get_logger().set_level(LoggingSeverity[given.log_level.upper()])
    named, chosen = chosen_topics(given)
    how = PlaybackOptions(
        rate=given.rate,
        offset=given.start_offset,
        end=end_time(given, bag.span[0]),
        loop=given.loop,
        paused=given.start_paused,
        topics=named,
        chosen=chosen,
        remaps=dict(each.split(":=", 1) for each in given.remap),
        qos=qos,
        clock=given.clock,
        clock_topics=None if given.clock_topics_all else given.clock_topics,
    )
    player = Player(node, bag, how, class_of, generic_types(machine=given.ros))
    for name in player.absent:
        node.get_logger().warning(f"Topic '{name}' is not in the bag")
    for name, why in player.unknown.items():
        node.get_logger().warning(f"Topic '{name}' is not played: {why}")
    if player.left_out:
        print(sanitize(f"warning: {left_out_warning(player.left_out)}"), file=sys.stderr)
    return node, player


def _run(node: Node, work: Callable[[], None], stopped: threading.Event) -> str:
    """Run `work` in a thread and spin the node meanwhile, until it is done or stopped; returns what went wrong."""
    problem: list[str] = []

    def guarded() -> None:
        try:
            work()
        except BagError as error:
            problem.append(str(error))
        except Exception as error:  # the outermost frame of the thread: nobody else would report it
            problem.append(f"{type(error).__name__}: {error}")
        finally:
            stopped.set()

    thread = threading.Thread(target=guarded, name="player", daemon=True)
    thread.start()
    spin(node, None, stopped)
    stopped.set()
    thread.join(5.0)
    return problem[0] if problem else ""


def _report(player: Player, problem: str) -> int:
    print(f"{counted(player.published, 'message')} published", file=sys.stderr)
    if problem:
        print(sanitize(problem), file=sys.stderr)
    return int(bool(problem))


def report_repaired(bag: Any) -> None:
    """Print which files of a bag were unfinished and have been repaired."""
    for each in bag.repaired:
        print(sanitize(each), file=sys.stderr)


def _offer_services(node: Node, player: Player) -> None:
    """Offer the services of rosbag2's player, if their types are available."""
    kinds = service_types()

    def offer(kind: str, name: str, do: Callable[[Any, Any], object]) -> None:
        def answer(request: Any, response: Any) -> Any:
            do(request, response)
            return response

        if kinds is not None:
            node.create_service(getattr(kinds, kind), f"~/{name}", answer)

    def pause(paused: bool | None) -> Callable[[Any, Any], None]:
        def do(request: Any, response: Any) -> None:
            player.paused = not player.paused if paused is None else paused

        return do

    def is_paused(_: Any, response: Any) -> None:
        response.paused = player.paused

    def get_rate(_: Any, response: Any) -> None:
        response.rate = player.rate

    def set_rate(request: Any, response: Any) -> None:
        response.success = request.rate > 0
        if response.success:
            player.rate = request.rate

    def seek(request: Any, response: Any) -> None:
        stamp = request.time.sec * 10**9 + request.time.nanosec
        response.success = player.begin <= stamp <= player.end
        if response.success:
            player.seek(stamp)

    def play_next(_: Any, response: Any) -> None:
        response.success = player.paused
        if player.paused:
            player.step()

    offer("Pause", "pause", pause(True))
    offer("Resume", "resume", pause(False))
    offer("TogglePaused", "toggle_paused", pause(None))
    offer("IsPaused", "is_paused", is_paused)
    offer("GetRate", "get_rate", get_rate)
    offer("SetRate", "set_rate", set_rate)
    offer("Seek", "seek", seek)
    offer("PlayNext", "play_next", play_next)
