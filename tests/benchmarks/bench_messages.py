"""The cost of messages: `python tests/benchmarks/bench_messages.py [RUNS]`, JSON out.

CPU time in microseconds, medians of several runs with spread; ratios are within one run. The floor for creating and
copying is a plain object with as many attributes and sequences; the floor for CDR is the codec of rosbags.
"""

from __future__ import annotations

import copy
import json
import statistics
import sys
import time
from array import array
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy
from bot_console.runtime.importer import install

install()

from bot_console.runtime.rosidl.cdr import deserialize, serialize
from bot_console.runtime.rosidl.definition import DTYPES, TYPECODES, parse_type
from geometry_msgs.msg import Twist, Vector3
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64, String

COUNT = 20_000
STORE = get_typestore(Stores.ROS2_JAZZY)
SAMPLES = (
    Float64(data=1.5),
    String(data="sixteen letters!"),
    Twist(linear=Vector3(x=1.0)),
    LaserScan(ranges=[1.0] * 360, intensities=[2.0] * 360),
)


def per_call(action: Callable[[], Any]) -> float:
    start = time.process_time()
    for _ in range(COUNT):
        action()
    return (time.process_time() - start) / COUNT * 1e6


def plain(value: Any) -> Any:
    """A message as an object without validation."""
    if hasattr(value, "get_fields_and_field_types"):
        return SimpleNamespace(**{name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()})
    return value


def plain_copy(value: Any) -> Any:
    if isinstance(value, SimpleNamespace):
        new = copy.copy(value)
        for name, each in vars(value).items():
            if isinstance(each, (SimpleNamespace, array)):
                setattr(new, name, plain_copy(each))
        return new
    return value[:]


def for_rosbags(message: Any) -> Any:
    found = SimpleNamespace()
    for name, text in message.get_fields_and_field_types().items():
        value, kind = getattr(message, name), parse_type(text)
        if not kind.primitive:
            value = for_rosbags(value)
        elif kind.item in TYPECODES and kind.sequence:
            value = numpy.array(value, DTYPES[kind.item])
        setattr(found, name, value)
    return found


def one_run() -> dict[str, float]:
    found: dict[str, float] = {}
    for message in SAMPLES:
        name, cls = type(message).__name__, type(message)
        full_name = f"{cls.__module__.split('.')[0]}/msg/{name}"
        bare, theirs, data = plain(message), for_rosbags(message), serialize(message)
        rows = {
            "copy": (message._copy_, lambda bare=bare: plain_copy(bare)),
            "serialize": (
                lambda message=message: serialize(message),
                lambda theirs=theirs, full_name=full_name: STORE.serialize_cdr(theirs, full_name),
            ),
            "deserialize": (
                lambda data=data, cls=cls: deserialize(data, cls),
                lambda data=data, full_name=full_name: STORE.deserialize_cdr(data, full_name),
            ),
        }
        found[f"{name} make us"] = per_call(cls)
        for what, (ours, floor) in rows.items():
            cost, least = per_call(ours), per_call(floor)
            found[f"{name} {what} us"] = cost
            found[f"{name} {what} ratio"] = cost / least
    return found


def main() -> None:
    runs = [one_run() for _ in range(int(sys.argv[1]) if len(sys.argv) > 1 else 5)]
    summary = {
        key: {
            "median": round(statistics.median(run[key] for run in runs), 3),
            "spread": round(max(run[key] for run in runs) - min(run[key] for run in runs), 3),
        }
        for key in runs[0]
    }
    print(json.dumps(summary, indent=1))


if __name__ == "__main__":
    main()
