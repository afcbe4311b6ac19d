"""The embedded rclpy: the public API of rclpy for ROS 2 Jazzy, in one process and without ROS 2.

Modules, names and behaviour are those of rclpy 7.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from bot_console.runtime.distribution import distribution
from bot_console.runtime.process import ProcessLocal, explain_with
from rclpy.context import Context as Context
from rclpy.impl.reexports import submodule
from rclpy.impl.unused_overrides import report_unused_overrides
from rclpy.parameter import Parameter as Parameter
from rclpy.signals import SignalHandlerOptions as SignalHandlerOptions
from rclpy.signals import install_signal_handlers as install_signal_handlers
from rclpy.signals import uninstall_signal_handlers as uninstall_signal_handlers
from rclpy.task import Future as Future
from rclpy.utilities import get_default_context as get_default_context
from rclpy.utilities import get_rmw_implementation_identifier as get_rmw_implementation_identifier
from rclpy.utilities import ok as ok
from rclpy.utilities import shutdown as _shutdown
from rclpy.utilities import try_shutdown as _try_shutdown

if TYPE_CHECKING:
    from rclpy.executors import Executor
    from rclpy.node import Node

_global_executor: ProcessLocal[list[Any]] = ProcessLocal(list)


def _explain(exception: BaseException) -> str | None:
    from rclpy.impl.explanations import explain

    return explain(exception)


explain_with(_explain)


def init(
    *,
    args: Sequence[str] | None = None,
    context: Context | None = None,
    domain_id: int | None = None,
    signal_handler_options: SignalHandlerOptions | None = None,
) -> Any:
    """Initialise; `args` None means `sys.argv`. Raises `RuntimeError` the second time, `RCLError` for bad arguments.

    As in the chosen distribution, it returns either nothing or a context manager that shuts down.
    """
    default = get_default_context()
    chosen: Context = default if context is None else context
    if signal_handler_options is None:
        signal_handler_options = SignalHandlerOptions.ALL if chosen is default else SignalHandlerOptions.NO
    if signal_handler_options:
        install_signal_handlers(signal_handler_options)
    chosen.init(args, domain_id=domain_id)
    return InitContextManager(chosen, bool(signal_handler_options)) if distribution().init_is_context_manager else None


class InitContextManager:
    """The result of `init` in some distributions: shuts down at the end of a `with` block."""

    def __init__(self, context: Context, installed_signal_handlers: bool) -> None:
        self.context = context
        self.installed_signal_handlers = installed_signal_handlers

    def __enter__(self) -> InitContextManager:
        return self

    def __exit__(self, *_: object) -> None:
        default = self.context is get_default_context()
        try_shutdown(context=None if default else self.context, uninstall_handlers=self.installed_signal_handlers)


def get_global_executor() -> Executor:
    """Return the executor used by `spin`, `spin_once` and `spin_until_future_complete` when none is given."""
    from rclpy.executors import SingleThreadedExecutor

    holder = _global_executor.get()
    if not holder or holder[0].context is not get_default_context():
        executor = SingleThreadedExecutor()
        executor.is_global = True
        holder[:] = [executor]

        def forget() -> None:
            holder.clear()
            executor.shutdown()

        executor.context.on_shutdown(forget)
    return holder[0]


def shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Shut down; raises `RuntimeError` before `init`, and `RCLError` if ROS is already shut down."""
    _shutdown(context=context)
    if uninstall_handlers or (uninstall_handlers is None and context is None):
        uninstall_signal_handlers()


def try_shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Shut down, unless ROS is already shut down."""
    _try_shutdown(context=context)
    if uninstall_handlers or (uninstall_handlers is None and context is None):
        uninstall_signal_handlers()


def create_node(
    node_name: str,
    *,
    context: Context | None = None,
    cli_args: Sequence[str] | None = None,
    namespace: str | None = None,
    use_global_arguments: bool = True,
    enable_rosout: bool = True,
    start_parameter_services: bool = True,
    parameter_overrides: Sequence[Parameter] | None = None,
    allow_undeclared_parameters: bool = False,
    automatically_declare_parameters_from_overrides: bool = False,
    enable_logger_service: bool = False,
) -> Node:
    """Create a node; see `rclpy.node.Node`."""
    from rclpy.node import Node

    return Node(
        node_name,
        context=context,
        cli_args=cli_args,
        namespace=namespace,
        use_global_arguments=use_global_arguments,
        enable_rosout=enable_rosout,
        start_parameter_services=start_parameter_services,
        parameter_overrides=parameter_overrides,
        allow_undeclared_parameters=allow_undeclared_parameters,
        automatically_declare_parameters_from_overrides=automatically_declare_parameters_from_overrides,
        enable_logger_service=enable_logger_service,
    )


def spin_once(node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None) -> None:
    """Run one callback of a node; a time-out (s) of None or below zero waits for ever."""
    executor = get_global_executor() if executor is None else executor
    was_added = False
    try:
        was_added = executor.add_node(node)
        executor.spin_once(timeout_sec=timeout_sec)
    finally:
        if was_added:  # otherwise the executor that already spins the node, further up the call stack, keeps it
            executor.remove_node(node)


def spin(node: Node, executor: Executor | None = None) -> None:
    """Run a node's callbacks until its context is shut down."""
    executor = get_global_executor() if executor is None else executor
    was_added = False
    try:
        was_added = executor.add_node(node)
        report_unused_overrides(executor.context)
        with executor._count_spinning():  # pyright: ignore[reportPrivateUsage] -- one library
            while executor.context.ok():
                executor.spin_once()
    finally:
        if was_added:
            executor.remove_node(node)


def spin_until_future_complete(
    node: Node, future: Future[Any], executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Run a node's callbacks until a future is done or the time-out (s) expires."""
    executor = get_global_executor() if executor is None else executor
    was_added = False
    try:
        was_added = executor.add_node(node)
        executor.spin_until_future_complete(future, timeout_sec)
    finally:
        if was_added:
            executor.remove_node(node)


def __getattr__(name: str) -> Any:
    return submodule(name)
