"""The services that read and set log levels remotely."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rcl_interfaces.msg import LoggerLevel, SetLoggerLevelsResult
from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.logging import get_logger_level, set_logger_level
from rclpy.qos import qos_profile_services_default

if TYPE_CHECKING:
    from rclpy.node_parts.entities import NodeEntities


class LoggingService:
    """Serves `~/get_logger_levels` and `~/set_logger_levels` of a node."""

    def __init__(self, node: NodeEntities) -> None:
        name = node.get_name()
        qos = qos_profile_services_default
        node.create_service(GetLoggerLevels, f"{name}/get_logger_levels", self._get, qos_profile=qos)
        node.create_service(SetLoggerLevels, f"{name}/set_logger_levels", self._set, qos_profile=qos)

    def _get(self, request: GetLoggerLevels.Request, response: GetLoggerLevels.Response) -> GetLoggerLevels.Response:
        response.levels = [LoggerLevel(name=name, level=int(get_logger_level(name))) for name in request.names]
        return response

    def _set(self, request: SetLoggerLevels.Request, response: SetLoggerLevels.Response) -> SetLoggerLevels.Response:
        results: list[SetLoggerLevelsResult] = []
        for each in request.levels:
            try:
                level = LoggingSeverity(each.level)
            except ValueError:
                results.append(SetLoggerLevelsResult(successful=False, reason="Failed reason: Invalid logger level."))
                continue
            set_logger_level(each.name, level)
            results.append(SetLoggerLevelsResult(successful=True))
        response.results = results
        return response
