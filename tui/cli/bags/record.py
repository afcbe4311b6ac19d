"""`bag record`: records topics until Ctrl-C, or keeps them in memory until a snapshot is requested."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bot_console.tui.cli.bags.common import make_node, new_folder, report_unused, service_types, spin
from bot_console.tui.cli.bags.keyboard import read_keys
from bot_console.tui.cli.bags.record_arguments import NOT_NEEDED, record_problem, wanted_topics
from bot_console.tui.console.bags.definitions import class_of
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize

if TYPE_CHECKING:
    from bot_console.tui.console.bags.recorder import Recorder
    from bot_console.tui.console.bags.snapshot_ring import Ring
    from bot_console.tui.console.bags.writer import BagWriter
    from rclpy.node import Node

RECORDER = "rosbag2_recorder"
SNAPSHOT = f"/{RECORDER}/_snapshot"
"""A service that writes a snapshot and, unlike rosbag2's own service, answers where it is."""
MAX_SNAPSHOT_BYTES = 512 * 1024 * 1024
"""Maximum size of a snapshot."""
REPORT_S = 0.5
"""Seconds between two reports of newly found topics."""


def record(given: argparse.Namespace) -> int:
    """Record; 0 done, 1 failed, 2 wrong options."""
    if wrong := record_problem(given):
        print(wrong, file=sys.stderr)
        return 2
    unused = dict(NOT_NEEDED)
    if given.snapshot_mode:
        unused.pop("max_cache_size")
    report_unused(given, unused)
    folder = given.output or new_folder()
    node = make_node(given.node_name)
    if node is None:
        return 1
    from bot_console.tui.console.bags.recorder import remarks
    from bot_console.tui.console.bags.snapshot_ring import Ring
    from bot_console.tui.console.bags.writer import BagWriter
    from rclpy.logging import LoggingSeverity

    node.get_logger().set_level(LoggingSeverity[given.log_level.upper()])
    bag = None if given.snapshot_mode else BagWriter(folder, _writing(given))
    ring = Ring(given.snapshot_duration, given.max_cache_size or MAX_SNAPSHOT_BYTES)
    recorder = _recorder(given, node, bag or ring)
    try:
        _serve(given, node, recorder, bag, ring)
    finally:  # even if Ctrl-C came before there was anything to spin
        recorder.close()
        if bag is not None:
            bag.close()
    if bag is not None:
        print(f"{bag.metadata.amount} in {folder}", file=sys.stderr)
    named = (f"/{each.lstrip('/')}" for each in (*given.topics, *given.topics_positional))
    absent = {each: "nobody has published it" for each in named if each not in recorder.subscribed}
    if lacking := remarks({**absent, **recorder.unknown}, recorder.generic):
        print(sanitize(lacking), file=sys.stderr)
    return 0


def _writing(given: argparse.Namespace) -> Any:
    from bot_console.tui.console.bags.writer import WritingOptions

    custom = dict(each.split("=", 1) for each in given.custom_data)
    return WritingOptions(
        given.storage, given.storage_preset_profile, given.compression_mode, given.max_bag_size,
        given.max_bag_duration, custom,
    )  # fmt: skip


def _recorder(given: argparse.Namespace, node: Node, sink: Any) -> Recorder:
    from bot_console.tui.console.bags.recorder import Recorder
    from bot_console.tui.session.embedded.hooks import DomainTypes

    wanted = wanted_topics(
        given, lambda topic: node.count_publishers(topic) > 0, lambda topic: node.count_subscribers(topic) > 0
    )
    poll_s = float("inf") if given.no_discovery else given.polling_interval / 1000
    made = Recorder(
        node, sink, wanted, _TypeFinder(), poll_s=poll_s, sim_time=given.use_sim_time, generic=DomainTypes()
    )
    made.paused = given.start_paused
    return made


class _TypeFinder:
    """Finds the class of a message type; the definition of an unknown one is requested once from nodes that use it.

    Calling it raises `ImportError`, `AttributeError` or `ValueError` if there is no class.
    """

    def __init__(self) -> None:
        import rclpy

        self._asked: set[str] = set()
        self._node = rclpy.create_node(f"_{RECORDER}_types", start_parameter_services=False)

    def __call__(self, type_name: str) -> Any:
        try:
            return class_of(type_name)
        except (ImportError, AttributeError, ValueError):
            if type_name in self._asked:
                raise
        from ros2cli.type_discovery import learn_type

        self._asked.add(type_name)
        if why := learn_type(type_name, self._node):
            raise ImportError(why)
        return class_of(type_name)


def _serve(given: argparse.Namespace, node: Node, recorder: Recorder, bag: BagWriter | None, ring: Ring) -> None:
    """Record until the time is up or Ctrl-C, and answer keys and services meanwhile."""
    import rclpy
    from bot_console.tui.console.bags.recorder import PACE_S

    logger = node.get_logger()
    reported: set[str] = set()

    def report() -> None:
        for name in recorder.subscribed.keys() - reported:
            logger.info(f"Subscribed to topic '{name}'")
            if name in recorder.generic:
                logger.warning(f"Topic '{name}' is recorded without a definition: {recorder.generic[name]}")
        for name in recorder.unknown.keys() - reported:
            logger.warning(f"Topic '{name}' is not recorded: {recorder.unknown[name]}")
        reported.update(recorder.subscribed, recorder.unknown)

    def toggle(key: str = "space") -> None:
        if key == "space":
            recorder.paused = not recorder.paused
            logger.info("Pausing recording." if recorder.paused else "Resuming recording.")

    control = rclpy.create_node(f"_{RECORDER}_control", start_parameter_services=False)
    control.create_timer(PACE_S, recorder.turn)
    control.create_timer(REPORT_S, report)
    _offer_services(control, f"/{given.node_name}", recorder, bag)
    if bag is None:
        _offer_snapshots(control, f"/{given.node_name}", ring, given.output)
        logger.info(f"Keeping the last {given.snapshot_duration:g} s; `bot-console bag snapshot` writes them")
    else:
        logger.info(f"Recording to {bag.folder}")
    if recorder.paused:
        logger.info("Waiting for recording: space or the service resume begins it")
    with read_keys(lambda key: None if given.disable_keyboard_controls else toggle(key)):
        spin(control, given.duration)


def _offer_services(control: Node, prefix: str, recorder: Recorder, bag: BagWriter | None) -> None:
    """Offer the services of rosbag2's recorder, if their types are available."""
    kinds = service_types()
    if kinds is None:
        return

    def pause(paused: bool | None) -> Any:
        def answer(_: Any, response: Any) -> Any:
            recorder.paused = not recorder.paused if paused is None else paused
            return response

        return answer

    def is_paused(_: Any, response: Any) -> Any:
        response.paused = recorder.paused
        return response

    def split(_: Any, response: Any) -> Any:
        if bag is not None:
            bag.split()
        return response

    control.create_service(kinds.Pause, f"{prefix}/pause", pause(True))
    control.create_service(kinds.Resume, f"{prefix}/resume", pause(False))
    control.create_service(kinds.TogglePaused, f"{prefix}/toggle_paused", pause(None))
    control.create_service(kinds.IsPaused, f"{prefix}/is_paused", is_paused)
    control.create_service(kinds.SplitBagfile, f"{prefix}/split_bagfile", split)


def _offer_snapshots(control: Node, prefix: str, ring: Ring, output: Path | None) -> None:
    from std_srvs.srv import Trigger

    def write(_: Any, answer: Any) -> Any:
        answer.success, answer.message = _write_snapshot(ring, new_folder(output))
        return answer

    def write_only(_: Any, answer: Any) -> Any:
        answer.success, _message = _write_snapshot(ring, new_folder(output))
        return answer

    control.create_service(Trigger, SNAPSHOT, write)
    kinds = service_types()
    if kinds is not None:
        control.create_service(kinds.Snapshot, f"{prefix}/snapshot", write_only)


def _write_snapshot(ring: Ring, folder: Path) -> tuple[bool, str]:
    from bot_console.tui.console.bags.writer import BagWriter

    try:
        writer = BagWriter(folder)
        count = ring.pour(writer)
        writer.close()
    except (NotSaved, OSError) as error:
        return False, str(error)
    return True, f"{counted(count, 'message')} in {folder.resolve()}"


def snapshot(given: argparse.Namespace) -> int:
    """`bag snapshot`: make a recorder in snapshot mode write the messages it keeps; 0 done, 1 failed."""
    import rclpy
    from std_srvs.srv import Trigger

    node = make_node("_snapshot")
    if node is None:
        return 1
    client = node.create_client(Trigger, SNAPSHOT)
    if not client.wait_for_service(timeout_sec=1.0):
        print("No recorder in snapshot mode runs: `bot-console bag record --all --snapshot-mode`", file=sys.stderr)
        return 1
    future = client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future, timeout_sec=30.0)
    answer = future.result()
    if answer is None:
        print("The recorder did not answer within 30 s", file=sys.stderr)
        return 1
    print(sanitize(answer.message), file=sys.stdout if answer.success else sys.stderr)
    return 0 if answer.success else 1
