"""`bag convert`, `reindex` and `list`."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar, cast

import yaml
from bot_console.tui.cli.bags.play import report_repaired
from bot_console.tui.cli.bags.play_arguments import input_problem
from bot_console.tui.cli.bags.record_arguments import PRESETS, wanted_topics
from bot_console.tui.console.bags.definitions import class_of, definition
from bot_console.tui.console.bags.merged_bags import MergedBags
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.writer import BagWriter, WritingOptions
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.yaml_faults import UNREADABLE

PLUGINS: Mapping[str, tuple[str, ...]] = {
    "storage": ("mcap", "sqlite3"),
    "converter": (),
    "compression": ("rosbag2_compression_zstd::ZstdCompressor",),
    "decompression": ("rosbag2_compression_zstd::ZstdDecompressor",),
}
"""The plug-ins of rosbag2, by type, whose work can be done here too."""
SUPPORTED_KEYS = frozenset(
    ["uri", "storage_id", "max_bagfile_size", "max_bagfile_duration", "storage_preset_profile", "topics", "services",
     "topic_types", "all", "all_topics", "all_services", "regex", "exclude_regex", "exclude_topics",
     "exclude_topic_types", "exclude_services", "exclude", "compression_mode", "compression_format", "custom_data",
     "include_hidden_topics", "include_unpublished_topics"]
)  # fmt: skip
"""Keys of an output that have an effect; others are ignored with a warning."""
CHOICES: Mapping[str, tuple[str, ...]] = {
    "storage_id": PLUGINS["storage"],
    "storage_preset_profile": PRESETS,
    "compression_mode": ("none", "file", "message"),
    "compression_format": ("zstd",),
}
"""The values of keys that take one of a few words."""
_V = TypeVar("_V")


def add_convert_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `convert`."""
    parser.add_argument("-i", "--input", nargs="+", action="append", required=True, metavar=("BAG", "STORAGE"))
    parser.add_argument("-o", "--output-options", type=Path, required=True, metavar="FILE", help="YAML: output_bags")


def convert(given: argparse.Namespace) -> int:
    """Rewrite bags with other settings; 0 done, 1 failed, 2 wrong options."""
    if wrong := input_problem(given.input):
        print(sanitize(wrong), file=sys.stderr)
        return 2
    try:
        outputs = _outputs(given.output_options)
        for each in outputs:
            _check(each)
        bags = [Bag(Path(each[0])) for each in given.input]
        for each in bags:
            report_repaired(each)
        for each in outputs:
            _write(bags, each)
    except (OSError, ValueError) as error:
        print(sanitize(str(error)), file=sys.stderr)
        return 1
    return 0


def _outputs(path: Path) -> list[dict[str, Any]]:
    try:
        data: Any = yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ValueError(f"{path}: {error.strerror or error}") from None
    except UNREADABLE as error:
        raise ValueError(f"{path} is not YAML: {' '.join(str(error).split())}") from None
    listed: Any = cast("dict[str, Any]", data).get("output_bags") if isinstance(data, dict) else None
    found = cast("list[Any]", listed) if isinstance(listed, list) else []
    if not found or not all(isinstance(each, dict) and "uri" in each for each in found):
        raise ValueError(f"{path} has to list 'output_bags', each with a 'uri'")
    return found


def _check(output: Mapping[str, Any]) -> None:
    """Raise `ValueError` if a key that takes one of a few words has another value."""
    for key, allowed in CHOICES.items():
        value = str(output.get(key) or allowed[0])
        if value.lower() not in allowed:
            raise ValueError(f"{output['uri']}: {key} must be {' or '.join(allowed)}, not {value[:40]!r}")


def _write(bags: list[Any], output: Mapping[str, Any]) -> None:
    unknown = sorted(map(str, output.keys() - SUPPORTED_KEYS))
    if unknown:
        print(
            sanitize(f"{output['uri']}: ignored, since nothing here depends on it: {', '.join(unknown)}"),
            file=sys.stderr,
        )
    bag = MergedBags(bags)
    wanted = wanted_topics(_filters(output), lambda _: True, lambda _: True)
    storage, preset, compression = (
        str(output.get(key) or CHOICES[key][0]).lower()
        for key in ("storage_id", "storage_preset_profile", "compression_mode")
    )
    writer = BagWriter(
        Path(str(output["uri"])),
        WritingOptions(
            storage, preset, compression, _value(output, "max_bagfile_size", int, 0),
            _value(output, "max_bagfile_duration", float, 0.0), _value(output, "custom_data", dict, {}),
        ),
    )  # fmt: skip
    for name, topic in bag.topics.items():
        if not wanted(name, [topic.type]):
            continue
        try:
            text = definition(class_of(topic.type))
        except (ImportError, AttributeError, ValueError) as error:
            text = ""
            print(sanitize(f"{name}: written without the definition of {topic.type} ({error})"), file=sys.stderr)
        writer.add(type(topic)(topic.name, topic.type, topic.qos, topic.type_hash, 0, topic.encoding), text)
    for entry in bag.messages(list(writer.metadata.topics)):
        writer.write(entry.topic, entry.data, entry.received, 0)
    writer.close()
    print(sanitize(f"{writer.metadata.amount} in {writer.folder}"))


def _as_list(value: Any) -> list[Any]:
    if not isinstance(value, list):
        raise TypeError
    return cast("list[Any]", value)


def _value(output: Mapping[str, Any], name: str, kind: Callable[[Any], _V], default: _V) -> _V:
    """The value of a key, or `default` if it is missing; raises `ValueError` if it cannot be converted by `kind`."""
    value = output.get(name)
    try:
        return kind(value) if value else default
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{output['uri']}: {name} cannot be {str(value)[:40]!r}") from None


def _filters(output: Mapping[str, Any]) -> argparse.Namespace:
    def several(name: str) -> list[str]:
        return [str(each) for each in _value(output, name, _as_list, [])]

    def compiled(name: str) -> re.Pattern[str] | None:
        text = str(output.get(name) or "")
        try:
            return re.compile(text) if text else None
        except re.error as error:
            raise ValueError(f"{output['uri']}: {name} {text!r} is not a regular expression: {error}") from None

    patterns = {name: compiled(name) for name in ("regex", "exclude_regex")}
    lists = ("topics", "services", "topic_types", "exclude_topics", "exclude_topic_types", "exclude_services")
    flags = ("all", "all_topics", "all_services")
    chosen = {name: several(name) for name in lists} | {name: bool(output.get(name)) for name in flags} | patterns
    if output.get("exclude") and not patterns["exclude_regex"]:  # the name of earlier releases
        chosen["exclude_regex"] = compiled("exclude")
    anything = any(chosen[name] for name in ("topics", "services", "topic_types", "regex", *flags))
    chosen["all"] = chosen["all"] or not anything
    return argparse.Namespace(
        **chosen, topics_positional=[], include_hidden_topics=True, include_unpublished_topics=True,
        ignore_leaf_topics=False,
    )  # fmt: skip


def reindex(given: argparse.Namespace) -> int:
    """Rebuild the metadata of a bag folder; 0 done, 1 failed."""
    if not given.bag.is_dir():
        print(f"{given.bag}: not the folder of a bag", file=sys.stderr)
        return 1
    bag = Bag(given.bag, listed=False)
    report_repaired(bag)
    bag.metadata.save(given.bag)
    print(sanitize(f"{bag.metadata.amount} in {given.bag}"))
    return 0


def list_plugins(given: argparse.Namespace) -> int:
    """Print the names of the plug-ins; returns 0."""
    if given.verbose:
        print(f"available {given.plugin_type} plugins are:")
    for each in PLUGINS[given.plugin_type]:
        print(f"name: {each}" if given.verbose else each)
    return 0
