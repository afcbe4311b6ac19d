"""The public API of rclpy and launch in Jazzy; any other attribute raises `AttributeError` when the console accesses
it.
"""

from __future__ import annotations

import sys
import threading
from importlib.machinery import ModuleSpec, PathFinder
from typing import Any

CONSOLE = "bot_console.tui."
"""Modules with this prefix may use only the listed names; nodes and the runtime itself are not restricted."""

PUBLIC: dict[str, dict[str, str]] = {
    "rclpy.node": {
        "Node": "publishers subscriptions clients services timers guards waitables executor context handle "
        "default_callback_group get_name get_namespace get_clock get_logger declare_parameter declare_parameters "
        "undeclare_parameter has_parameter get_parameter_type get_parameter_types get_parameter get_parameters "
        "get_parameter_or get_parameters_by_prefix set_parameters set_parameters_atomically describe_parameter "
        "describe_parameters set_descriptor list_parameters add_pre_set_parameters_callback "
        "add_on_set_parameters_callback add_post_set_parameters_callback create_publisher create_subscription "
        "create_client create_service create_timer create_guard_condition create_rate destroy_publisher "
        "destroy_subscription destroy_client destroy_service destroy_timer destroy_guard_condition destroy_rate "
        "destroy_node get_publisher_names_and_types_by_node get_subscriber_names_and_types_by_node "
        "get_service_names_and_types_by_node get_client_names_and_types_by_node get_topic_names_and_types "
        "get_service_names_and_types get_node_names get_node_names_and_namespaces get_fully_qualified_name "
        "count_publishers count_subscribers count_clients count_services get_publishers_info_by_topic "
        "get_subscriptions_info_by_topic wait_for_node resolve_topic_name resolve_service_name",
    },
    "rclpy.context": {"Context": "init ok shutdown try_shutdown get_domain_id handle on_shutdown"},
    "rclpy.publisher": {
        "Publisher": "publish get_subscription_count topic_name topic handle msg_type qos_profile destroy "
        "assert_liveliness wait_for_all_acked event_handlers logger_name"
    },
    "rclpy.subscription": {
        "Subscription": "topic_name topic handle callback msg_type qos_profile raw destroy callback_group "
        "event_handlers get_publisher_count logger_name"
    },
    "rclpy.client": {
        "Client": "call call_async remove_pending_request service_is_ready wait_for_service handle destroy srv_name "
        "srv_type qos_profile configure_introspection callback_group logger_name service_name context"
    },
    "rclpy.task": {
        "Future": "done cancelled cancel result exception set_result set_exception add_done_callback "
        "remove_done_callback"
    },
    "launch.launch_service": {
        "LaunchService": "emit_event include_launch_description run run_async shutdown context event_loop task"
    },
    "launch.launch_context": {
        "LaunchContext": "argv noninteractive asyncio_loop is_shutdown locals launch_configurations environment "
        "emit_event emit_event_sync register_event_handler unregister_event_handler extend_globals extend_locals "
        "get_locals_as_dict perform_substitution would_handle_event add_completion_future get_event_handlers "
    },
    "launch_ros.actions.node": {
        "Node": "cmd cwd env additional_env shell emulate_tty process_description process_details output prefix name "
        "sigterm_timeout sigkill_timeout return_code get_asyncio_future get_sub_entities on_exit respawn "
        "respawn_delay condition execute visit describe describe_sub_entities describe_conditional_sub_entities "
        "entities node_package node_executable node_name ros_arguments expanded_node_namespace "
        "expanded_remapping_rules is_node_name_fully_specified cached_output"
    },
}


class PublicOnly:
    """A finder that loads modules as usual and then restricts their classes to the listed attributes."""

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        """The spec of a listed module, with a loader that also restricts it."""
        if name not in PUBLIC:
            return None
        spec = PathFinder.find_spec(name, path, target)
        if spec is None or spec.loader is None:
            return None
        load = spec.loader.exec_module

        def exec_module(module: Any) -> None:
            load(module)
            for each, names in PUBLIC[name].items():
                guard(getattr(module, each), frozenset(names.split()))
            if name == "launch.launch_service":
                in_main_thread(module.LaunchService)

        spec.loader.exec_module = exec_module  # type: ignore[method-assign]
        return spec


def in_main_thread(service: Any) -> None:
    """Raise outside the main thread, since the real launch handles signals there."""
    run = service.run

    def guarded(self: Any, **options: Any) -> int:
        if threading.current_thread() is not threading.main_thread():
            raise ValueError("set_wakeup_fd only works in main thread of the main interpreter")
        return run(self, **options)

    service.run = guarded


def guard(cls: Any, public: frozenset[str]) -> None:
    """Hide all attributes of a class that are not public from the console."""
    plain = cls.__getattribute__

    def __getattribute__(self: Any, name: str) -> Any:
        if not name.startswith("__") and name not in public:
            caller = sys._getframe(1).f_globals.get("__name__", "")
            if caller.startswith(CONSOLE):
                raise AttributeError(f"{cls.__module__}.{cls.__name__}.{name} is not public in ROS 2")
        return plain(self, name)

    cls.__getattribute__ = __getattribute__
