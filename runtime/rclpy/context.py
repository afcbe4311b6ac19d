"""Contexts: what `rclpy.init` creates and `rclpy.shutdown` ends."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import sys
import threading
import weakref
from collections.abc import Callable, Sequence
from types import MethodType, TracebackType
from typing import TYPE_CHECKING, Protocol

from bot_console.runtime.distribution import distribution
from bot_console.runtime.domain_id import DEFAULT_DOMAIN
from bot_console.runtime.domain_id import domain_id as environments_domain
from bot_console.runtime.process import current
from bot_console.runtime.rmw.bus import Bus, Thing
from bot_console.runtime.rmw.middleware import bus_of
from bot_console.runtime.rmw.zenoh.domain.discovery_range import why_range_is_ignored
from rclpy._rclpy_pybind11 import RCLError
from rclpy.impl.destroyable import Destroyable
from rclpy.impl.reexports import reexporting
from rclpy.impl.unused_overrides import OverriddenNode
from rclpy.signals import remember_context

if TYPE_CHECKING:
    from bot_console.runtime.rmw.arguments import Arguments
    from rclpy.impl.log_file import LogFile

NOT_INITIALIZED = "this context has not been initialised: call rclpy.init() first"


class NodeOfContext(OverriddenNode, Protocol):
    """What a context needs of its nodes."""

    def _ros_leave_graph(self) -> None: ...


class Context:
    """The lifetime of a set of nodes: arguments, domain, and whether it is still valid."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._callbacks: list[Callable[[], Callable[[], object] | None]] = []
        self._wakes: list[Callable[[], Callable[[], object] | None]] = []
        self._nodes: weakref.WeakSet[NodeOfContext] = weakref.WeakSet()
        self._initialized = False
        self.ended = False
        """Whether it was shut down."""
        self.ended_by_signal = False
        self._abandoned = False
        self.arguments: Arguments
        self._domain = 0
        self._bus: Bus | None = None
        self._log_file: LogFile | None = None
        self.lingering: set[Thing] = set()
        """Endpoints that stay in the graph although their node was destroyed."""

    def init(
        self, args: Sequence[str] | None = None, *, initialize_logging: bool = True, domain_id: int | None = None
    ) -> None:
        """Initialise; raises `RuntimeError` the second time and `RCLError` for arguments that cannot be parsed.

        `initialize_logging` affects only the log file, as all contexts of a process share its logging.
        """
        from rclpy.impl.command_line import begin_log_file, parse_global
        from rclpy.impl.rcutils_logger import RcutilsLogger

        with self._lock:
            if self._initialized:
                raise RuntimeError("Context.init() must only be called once")
            if args is not None and not isinstance(args, list):
                raise TypeError(f"args must be a list of strings, not {type(args).__name__}")
            self.arguments = parse_global(sys.argv if args is None else args)
            if domain_id is None or domain_id == DEFAULT_DOMAIN:
                domain_id = _domain_of_environment()
            elif domain_id < 0:
                raise RuntimeError(f"Domain id ({domain_id}) should not be lower than zero.")
            elif not hasattr(domain_id, "__index__"):  # integers of NumPy have it, floats do not
                raise TypeError(f"domain_id must be an int, not {type(domain_id).__name__}")
            elif domain_id > DEFAULT_DOMAIN:
                raise TypeError(f"domain_id must be less than 2^64, not {domain_id}")
            self._domain = domain_id = int(domain_id)
            if ignored := why_range_is_ignored():
                RcutilsLogger("rcl").warning(ignored)
            self._bus = bus_of(domain_id)
            if initialize_logging:
                self._log_file = begin_log_file(self.arguments)
            self._process = current()
            self._forget_abandon = self._process.on_abandon(self._abandon)
            self._initialized = True  # from now on a signal may shut the context down
        remember_context(self)

    def ok(self) -> bool:
        """Whether it has been initialised and not shut down."""
        if self.ended:
            current().deliver_signals()
        return self._initialized and not self.ended

    def _require_init(self) -> None:
        if not self._initialized:
            raise distribution().error_before_init(NOT_INITIALIZED)

    def require_running(self, what: str) -> None:
        """Raise `TypeError` before `init`, and `RCLError` after the shutdown, as `what` cannot be created then."""
        self._require_init()
        if self.ended:
            current().deliver_signals()
            raise RCLError(
                f"failed to create {what}: the given context is not valid, "
                "either rcl_init() was not called or rcl_shutdown() was called."
            )

    @property
    def handle(self) -> Destroyable:
        """The context's handle, as upstream has one."""
        return Destroyable(self, lambda: None)

    @property
    def bus(self) -> Bus:
        """The middleware of its domain; raises `TypeError` before `init`."""
        if self._bus is None:
            raise TypeError(NOT_INITIALIZED)
        return self._bus

    def get_domain_id(self) -> int:
        """Return the ROS domain."""
        if not self._initialized:
            raise RuntimeError("Context must be initialized before it can have a domain id")
        return self._domain

    def shutdown(self) -> None:
        """Shut down; raises `RuntimeError` before `init`, and `RCLError` the second time."""
        if not self._initialized:
            raise RuntimeError("Context must be initialized before it can be shutdown")
        if self.ended:
            kind, text = distribution().second_shutdown
            raise RCLError(text) if kind == RCLError.__name__ else RuntimeError(text)
        self._end()

    def try_shutdown(self) -> None:
        """Shut down, unless the context is already shut down."""
        if self._initialized and not self.ended:
            self._end()

    def shut_down_by_signal(self) -> None:
        """Shut down on a signal; as upstream, without the callbacks of `on_shutdown`."""
        if self._initialized and not self.ended:
            self.ended_by_signal = True
            self._end()

    def _end(self) -> None:
        with self._lock:
            if self.ended:
                return
            self.ended = True
            callbacks, self._callbacks = self._callbacks, []
            wakes, self._wakes = self._wakes, []
        for endpoint in list(self.lingering):
            self.bus.remove(endpoint)
        self._end_log_file()
        self._release_to_nodes()
        for held in wakes if self.ended_by_signal else callbacks + wakes:
            callback = held()
            if callback is not None:
                callback()

    def on_shutdown(self, callback: Callable[[], object]) -> None:
        """Register a callback for the shutdown, or call it at once if the context is already shut down."""
        if not callable(callback):
            raise TypeError("callback should be a callable, got {}", type(callback))  # given as a pair, as upstream
        self._add(callback, "_callbacks")

    def on_end(self, wake: Callable[[], object]) -> Callable[[], None]:
        """Register `wake` to be called when the context ends for any reason; returns a function that removes it."""
        return self._add(wake, "_wakes")

    def _add(self, callback: Callable[[], object], name: str) -> Callable[[], None]:
        held = self._callback_reference(callback)
        with self._lock:
            if not self.ended:
                getattr(self, name).append(held)
                return lambda: self._forget(held)
        callback()
        return lambda: None

    def _callback_reference(self, callback: Callable[[], object]) -> Callable[[], Callable[[], object] | None]:
        """Return a reference to the callback: weak for methods, so that the context keeps no object alive."""
        if isinstance(callback, MethodType):
            try:
                return weakref.WeakMethod(callback, self._forget)
            except TypeError:  # the object does not support weak references
                pass
        return lambda: callback

    def _forget(self, held: object) -> None:
        with self._lock:
            self._callbacks = [each for each in self._callbacks if each is not held]
            self._wakes = [each for each in self._wakes if each is not held]

    def track_node(self, node: NodeOfContext) -> None:
        """Register a node created in this context."""
        self._nodes.add(node)
        if self._abandoned:
            node._ros_leave_graph()

    def tracked_nodes(self) -> list[NodeOfContext]:
        """Return the nodes in this context."""
        return list(self._nodes)

    def untrack_node(self, node: NodeOfContext) -> None:
        """Unregister a destroyed node."""
        self._nodes.discard(node)

    def _abandon(self) -> None:
        """Remove the nodes from the graph and silence them, as the process was killed but its code may still run."""
        self.ended = self._abandoned = True
        self._end_log_file()
        for endpoint in list(self.lingering):
            self.bus.remove(endpoint)
        for node in list(self._nodes):
            node._ros_leave_graph()

    def _release_to_nodes(self) -> None:
        """Keep the context alive only through its nodes from now on, as a program may create many contexts."""
        weak_abandon = weakref.WeakMethod(self._abandon)

        def abandon() -> None:
            still_there = weak_abandon()
            if still_there is not None:
                still_there()

        weakref.finalize(self, self._process.on_abandon(abandon)).atexit = False
        self._forget_abandon()

    def _end_log_file(self) -> None:
        log_file, self._log_file = self._log_file, None
        if log_file is not None:
            log_file.end()

    def destroy(self) -> None:
        """Release the context's resources."""
        self.try_shutdown()

    def __enter__(self) -> Context:
        if not self._initialized:
            self.init()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.try_shutdown()


def _domain_of_environment() -> int:
    try:
        return environments_domain()
    except ValueError:
        raise RCLError("failed to initialize rcl: ROS_DOMAIN_ID is not an integral number") from None


__getattr__ = reexporting(__name__, "")
