"""Where the output of processes goes: `screen`, `log`, `both`, `own_log`, `full`, or a dict of them."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterable, Mapping
from typing import Any, cast

from launch.logging.config import launch_config
from launch.logging.launch_logger import LaunchLogger, get_logger

OVERRIDE = "OVERRIDE_LAUNCH_PROCESS_OUTPUT"
SOURCES = ("stdout", "stderr", "both")
PLACES = ("screen", "log", "own_log")
WORDS: Mapping[str, Mapping[str, frozenset[str]]] = {
    "screen": {"both": frozenset({"screen"})},
    "log": {"both": frozenset({"log"}), "stderr": frozenset({"screen"})},
    "both": {"both": frozenset({"log", "screen"})},
    "own_log": {"both": frozenset({"own_log"}), "stdout": frozenset({"own_log"}), "stderr": frozenset({"own_log"})},
    "full": {
        "both": frozenset({"screen", "log", "own_log"}),
        "stdout": frozenset({"own_log"}),
        "stderr": frozenset({"own_log"}),
    },
}


def get_output_loggers(
    process_name: str, output_config: object, main_log_file_name: str = "launch.log"
) -> tuple[Any, Any]:
    """Return the loggers for a process's stdout and stderr; raises `ValueError` for invalid settings."""
    places = _normalize(os.environ.get(OVERRIDE) or output_config)
    loggers: list[_OutputLogger] = []
    for source in ("stdout", "stderr"):
        logger = get_logger(f"{process_name}-{source}")
        logger.propagate = False
        logger.handlers = list(_handlers(process_name, source, places, main_log_file_name))
        loggers.append(_OutputLogger(logger))
    return loggers[0], loggers[1]


class _OutputLogger:
    """Logs the lines that a process prints, unchanged."""

    def __init__(self, logger: LaunchLogger) -> None:
        self._logger = logger
        self.name = logger.name
        self.handlers = logger.handlers

    def info(self, line: str) -> None:
        logger = self._logger
        if logger.handlers:
            record = logging.LogRecord(logger.name, logging.INFO, "", 0, line, (), None)
            record.is_process_output = True
            logger.handle(record)


def _handlers(
    process_name: str, source: str, places: Mapping[str, frozenset[str]], main_log_file_name: str
) -> Iterable[logging.Handler]:
    anywhere = places.get(source, frozenset()) | places.get("both", frozenset())
    if "screen" in anywhere:
        yield launch_config.get_screen_handler()
    if "log" in anywhere:
        yield launch_config.get_log_file_handler(main_log_file_name)
    if "own_log" in places.get(source, ()):
        yield _own_log_handler(f"{process_name}-{source}.log")
    if "own_log" in places.get("both", ()):
        yield _own_log_handler(f"{process_name}.log")


def _own_log_handler(file_name: str) -> logging.Handler:
    """Return the handler of a file for one process's lines, which lack the timestamps of the main log."""
    handler = launch_config.get_log_file_handler(file_name)
    handler.setFormatter(logging.Formatter())
    return handler


def _normalize(config: object) -> Mapping[str, frozenset[str]]:
    if isinstance(config, str):
        if config not in WORDS:
            raise ValueError(f'{config} is not a valid standard output config i.e. "screen", "log" or "both"')
        return WORDS[config]
    if not isinstance(config, Mapping):
        raise ValueError(f'{config} is not a valid output config, give "screen", "log", "both" or a dict')
    given = cast("Mapping[str, Any]", config)
    return {source: _places(source, places) for source, places in given.items()}


def _places(source: str, places: Any) -> frozenset[str]:
    if source not in SOURCES:
        raise ValueError(f"{source} is not a valid output source, i.e. {', '.join(SOURCES)}")
    found = frozenset((places,) if isinstance(places, str) else places)
    unknown = found - frozenset(PLACES)
    if unknown:
        raise ValueError(f"{', '.join(sorted(unknown))} is not a valid output log, i.e. {', '.join(PLACES)}")
    return found
