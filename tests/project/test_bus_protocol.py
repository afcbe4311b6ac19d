"""The type checker requires every middleware to implement all of `Bus`, and every user to use only `Bus`."""

import importlib.util
import json
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

pytestmark = [
    pytest.mark.skipif(importlib.util.find_spec("pyright") is None, reason="pyright is not installed"),
    pytest.mark.slow,
]

HEAD = """
from collections.abc import Callable, Mapping, Sequence
from bot_console.runtime.rmw.bus import Bus, PublisherEndpoint, Thing
from bot_console.runtime.rmw.endpoints import ClientEndpoint, Endpoint, Payload, NodeId, Notify, OnEvent
from bot_console.runtime.rmw.endpoints import GraphChanged, MessageObserver, ServiceEndpoint, SubscriptionEndpoint
from bot_console.runtime.rmw.graph_tables import GraphTables
from bot_console.runtime.rmw.middleware import choose_middleware
"""
BODY = (ROOT / "runtime/rmw/bus.py").read_text().partition("class Bus(Protocol):")[2]
SECOND = f"{HEAD}\nclass Second:{BODY}\nchoose_middleware(lambda domain: Second())\n"

PLANTED = {
    "complete": SECOND,
    "lacking": SECOND.replace("def has_server(", "def has_servant("),
    "other_result": SECOND.replace("def published(self) -> int", "def published(self) -> str"),
    "user_of_a_bus": f"{HEAD}\ndef use(bus: Bus) -> None:\n    bus.has_servant()\n",
    "user_of_a_context": "from rclpy.context import Context\n\nContext().bus.has_servant()\n",
}


@pytest.fixture(scope="module")
def errors(tmp_path_factory):
    """The checker's messages about the planted files, by name."""
    place = tmp_path_factory.mktemp("planted")
    for name, text in PLANTED.items():
        (place / f"{name}.py").write_text(text)
    paths = ("build/editable", "runtime", "runtime/rosidl/generated")
    config = {"extraPaths": [str(ROOT / each) for each in paths], "reportReturnType": "none"}  # Their bodies are empty.
    (place / "pyrightconfig.json").write_text(json.dumps(config))
    words = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable, "-p", str(place), "--outputjson"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    found = defaultdict(list)
    for each in json.loads(done.stdout)["generalDiagnostics"]:
        found[Path(each["file"]).stem].append(each["message"])
    return found


def test_complete_implementation_is_accepted(errors):
    assert errors["complete"] == []


def test_implementation_without_a_method_is_rejected(errors):
    (message,) = errors["lacking"]
    assert '"has_server" is not present' in message


def test_implementation_with_another_return_type_is_rejected(errors):
    (message,) = errors["other_result"]
    assert '"published" is an incompatible type' in message


@pytest.mark.parametrize("user", ["user_of_a_bus", "user_of_a_context"])
def test_user_is_limited_to_the_protocol(errors, user):
    (message,) = errors[user]
    assert "has_servant" in message
