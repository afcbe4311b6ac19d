"""Records in a separate node and thread of the console, so that a slow disk delays nothing else."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from typing import Any

import rclpy
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.missing_packages import MissingPackageError
from bot_console.tui.console.bags.port import GenericTypes, RecordingInfo, SnapshotKeeper
from bot_console.tui.console.bags.recorder import CLOCK, PACE_S, Recorder, remarks
from bot_console.tui.console.bags.recording_sinks import BagSink
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.own_context import WITHOUT_LOG_FILE
from bot_console.tui.files.save_file import NotSaved, typed_path
from rclpy.context import Context
from rosidl_runtime_py.utilities import get_message

NAME = "_bot_console_recorder"
DEFINITION_TIMEOUT_S = 3.0
"""Seconds that a topic waits for the definition of its type, which the Topics pane requests from the nodes; then it is
recorded without one.
"""
NOT_KEPT = (
    "only the console that started the system keeps the last minutes (setting keep_minutes); R records from now on"
)
CLOSE_TIMEOUT_S = 3.0
"""Seconds that finishing a bag may take when the console ends."""


class Recordings:
    """Records all topics; its methods may be called from any thread."""

    def __init__(self, buffer: SnapshotKeeper | None = None, generic: GenericTypes | None = None) -> None:
        """`buffer` keeps the last minutes, if they are kept; `generic` gives classes for types without a definition.

        The node is created when recording first starts.
        """
        self._buffer = buffer
        self._generic = generic
        self._sink = BagSink()
        self._recorder: Recorder | None = None
        """The recorder's thread creates it for each bag that is recorded."""
        self._info = RecordingInfo(kept_s=buffer.kept_s if buffer else 0.0)
        self._orders: queue.SimpleQueue[tuple[Callable[[], Answer], Future[Answer]]] = queue.SimpleQueue()
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None
        self._lock = threading.Lock()

    @property
    def info(self) -> RecordingInfo:
        """The state of recording."""
        writer = self._sink.writer
        missing = tuple(sorted(self._missing)) if writer else ()
        now = RecordingInfo(str(writer.folder) if writer else "", self._info.kept_s, self._sink.problem, missing)
        if now != self._info:
            self._info = now
        return self._info

    @property
    def _missing(self) -> Mapping[str, str]:
        recorder = self._recorder
        return recorder.unknown.copy() if recorder else {}

    def start(self, folder: str) -> Future[Answer]:
        """Record all topics into a new bag."""

        def begin() -> Answer:
            if self._sink.writer is not None:
                return Answer(False, f"{self._sink.writer.folder} is already being recorded")
            try:
                self._sink.begin(BagWriter(typed_path(folder)), time.time_ns())
            except (MissingPackageError, NotSaved, OSError) as error:
                return Answer(False, f"not recorded: {error}")
            return Answer(True, f"recording all topics into {folder}")

        return self._order(begin)

    def stop(self) -> Future[Answer]:
        """Close the bag."""
        if self._thread is None:
            return done(Answer(False, self._sink.problem or "nothing is being recorded"))

        def end() -> Answer:
            if self._recorder is not None:
                self._recorder.take()  # the messages that came after the last turn
            try:
                writer = self._sink.end()
            except (NotSaved, OSError) as error:
                return Answer(False, f"the bag was not finished properly; `bag info` repairs it: {error}")
            if writer is None:
                return Answer(False, self._sink.problem or "nothing is being recorded")
            about = writer.metadata
            recorded = f"{about.amount} in {writer.folder}"
            recorder = self._recorder
            lacking = remarks(recorder.unknown, recorder.generic) if recorder else ""
            return Answer(True, f"{recorded}; {lacking}" if lacking else recorded)

        return self._order(end)

    def keep(self, folder: str) -> Future[Answer]:
        """Save the last minutes from memory as a bag."""
        if self._buffer is None:
            return done(Answer(False, NOT_KEPT))
        return self._buffer.keep(str(typed_path(folder).absolute()))

    def close(self) -> None:
        """Finish the bag being recorded, and leave the graph."""
        self._closing.set()
        if self._thread is not None:
            self._thread.join(CLOSE_TIMEOUT_S)

    def _order(self, work: Callable[[], Answer]) -> Future[Answer]:
        """Run a function in the recorder's thread, between two turns of the recorder."""
        future: Future[Answer] = Future()
        self._orders.put((work, future))
        if self._closing.is_set():
            self._run_orders()
        else:
            self._start_thread()
        return future

    def _start_thread(self) -> None:
        with self._lock:
            if self._thread is None:
                self._thread = threading.Thread(target=self._serve, name="bot-console-recorder", daemon=True)
                self._thread.start()

    def _serve(self) -> None:
        context = Context()
        rclpy.init(args=WITHOUT_LOG_FILE, context=context)
        node: Any = rclpy.create_node(
            NAME, context=context, use_global_arguments=False, enable_rosout=False, start_parameter_services=False
        )
        try:
            while not self._closing.wait(PACE_S):
                wanted = self._sink.writer is not None
                if self._recorder is not None:
                    self._recorder.turn() if wanted else self._recorder.close()
                    self._recorder = self._recorder if wanted else None
                elif wanted:
                    self._recorder = Recorder(
                        *(node, self._sink, _is_recorded, get_message),
                        generic=self._generic,
                        definition_timeout_s=DEFINITION_TIMEOUT_S,
                    )
                self._run_orders()
            if self._recorder is not None:
                self._recorder.close()
            self._sink.end()
        except Exception as error:  # the thread's outermost frame: this bag ends here, the next one gets a new thread
            self._sink.fail(f"recording ended because of an error: {type(error).__name__}: {error}")
        finally:
            self._recorder = None
            node.destroy_node()
            context.try_shutdown()
            self._thread_ended()

    def _thread_ended(self) -> None:
        with self._lock:
            self._thread = None
        if self._closing.is_set():
            self._run_orders()
        elif not self._orders.empty():
            self._start_thread()

    def _run_orders(self) -> None:
        while True:
            try:
                work, future = self._orders.get_nowait()
            except queue.Empty:
                return
            try:
                future.set_result(Answer(False, "the console has closed") if self._closing.is_set() else work())
            except Exception as error:  # the thread's outermost frame: report it to the requester
                future.set_result(Answer(False, f"{type(error).__name__}: {error}"))


def _is_recorded(topic: str, types: Sequence[str]) -> bool:
    return topic != CLOCK
