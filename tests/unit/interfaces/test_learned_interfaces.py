"""Interfaces learned from a node's type description: accepted if the hash matches, refused otherwise."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.runtime.interfaces import learned_interfaces
from bot_console.runtime.interfaces.learned_interfaces import learn
from bot_console.runtime.rosidl.received_descriptions import describe_texts
from bot_console.runtime.rosidl.type_hash import text_of_description

SPOT = "float64 x\nfloat64 y\nint32 A=1\n"


@pytest.fixture(autouse=True)
def learned_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Path]:
    """A separate folder for what a test learns, which is forgotten afterwards."""
    folder = tmp_path / "kept"
    monkeypatch.setattr(learned_interfaces, "_folders", {})
    monkeypatch.setattr(learned_interfaces, "_directory", lambda: folder)
    yield folder
    for name in [each for each in sys.modules if each.partition(".")[0].startswith("learned_")]:
        del sys.modules[name]


def node_response(texts: dict[str, str], **fields: Any) -> Any:
    """A node's answer."""
    sources = [
        SimpleNamespace(type_name=name, encoding="srv" if "/srv/" in name else "msg", raw_file_contents=text)
        for name, text in texts.items()
    ]
    return SimpleNamespace(**{"successful": True, "failure_reason": "", "type_sources": sources, **fields})


def hash_of(name: str, texts: dict[str, str]) -> str:
    return text_of_description(describe_texts(name, texts))


def test_learned_message_has_constants_and_package_can_grow() -> None:
    spots = {"learned_a/msg/Spot": SPOT}
    assert learn("learned_a/msg/Spot", hash_of("learned_a/msg/Spot", spots), node_response(spots)) == ""
    module = importlib.import_module("learned_a.msg")
    spot = module.Spot
    assert (spot(x=1.0).x, spot.A) == (1.0, 1)

    paths = {"learned_a/msg/Path": "Spot[] spots\n", **spots}
    assert learn("learned_a/msg/Path", hash_of("learned_a/msg/Path", paths), node_response(paths)) == ""
    assert module.Path(spots=[spot()]).spots == [spot()] and module.Spot is spot
    paint = {"learned_a/srv/Paint": "Spot at\n---\nbool done\n", **spots}
    # The parts of a service's event are reported as well.
    event = {
        "service_msgs/msg/ServiceEventInfo": "uint8 event_type\nbuiltin_interfaces/Time stamp\n"
        "char[16] client_gid\nint64 sequence_number\n",
        "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec\n",
    }
    name = "learned_a/srv/Paint"
    assert learn(name, hash_of(name, {**paint, **event}), node_response({**paint, **event})) == ""
    assert importlib.import_module("learned_a.srv").Paint.Request(at=spot(y=2.0)).at.y == 2.0


def test_another_hash_is_refused_and_leaves_nothing(learned_folder: Path) -> None:
    spots = {"learned_b/msg/Spot": SPOT}
    wanted = hash_of("learned_b/msg/Spot", {"learned_b/msg/Spot": "float64 x\n"})
    assert (
        learn("learned_b/msg/Spot", wanted, node_response(spots))
        == f"describes it by a definition that does not have the hash {wanted}"
    )
    assert importlib.util.find_spec("learned_b") is None and not learned_folder.exists()


@pytest.mark.parametrize("name", ["../msg/Spot", "learned_c/../Spot", "learned_c/msg/Spot.py", "a/b", "Os/msg/Spot"])
def test_invalid_type_names_are_not_used_as_paths(name: str, learned_folder: Path) -> None:
    texts = {"learned_c/msg/Spot": SPOT}
    answer = learn("learned_c/msg/Spot", hash_of("learned_c/msg/Spot", texts), node_response({**texts, name: SPOT}))
    assert answer == "sent a description of it that is invalid: an invalid type name"
    assert not learned_folder.exists()


@pytest.mark.parametrize(
    ("answer", "why"),
    [
        (None, "has not described it"),
        (node_response({}, successful=False, failure_reason="not in use"), "does not describe it: not in use"),
        (
            node_response({}),
            "sent a description of it that is invalid: the definition of learned_d/msg/Spot is missing",
        ),
        (
            node_response({"learned_d/msg/Spot": "float64\n"}),
            "sent a description of it that is invalid: learned_d/msg/Spot:1",
        ),
        (
            node_response({"learned_d/msg/Spot": "Spot spot\n"}),
            "describes it by a definition that does not have the hash",
        ),
    ],
    ids=["nothing", "failed", "missing", "unreadable", "within itself"],
)
def test_useless_answers_are_reported(answer: Any, why: str) -> None:
    assert learn("learned_d/msg/Spot", "RIHS01_" + "0" * 64, answer).startswith(why)


def test_existing_package_stays_as_it_is(learned_folder: Path) -> None:
    texts = {"std_msgs/msg/String": "float64 data\n"}
    problem = learn("std_msgs/msg/String", hash_of("std_msgs/msg/String", texts), node_response(texts))
    assert problem == "has definitions of its nested types that differ from those here"
    assert not learned_folder.exists()
