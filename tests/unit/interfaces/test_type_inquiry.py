"""Asking a node for an action type that is unknown here: first the types shown in the graph, then the whole action."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any

import pytest
import rclpy
from bot_console.runtime.interfaces.type_inquiry import containing_action, inquiry
from bot_console.runtime.rosidl.type_hash import text
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from type_description_interfaces.srv import GetTypeDescription

NAME = "example_interfaces/action/Fibonacci"
HASHES = {
    f"{NAME}_SendGoal": text(Fibonacci.Impl.SendGoalService),
    f"{NAME}_GetResult": text(Fibonacci.Impl.GetResultService),
    f"{NAME}_FeedbackMessage": text(Fibonacci.Impl.FeedbackMessage),
}


@pytest.fixture
def node() -> Iterator[Any]:
    """A node that has the action."""
    context = rclpy.Context()
    rclpy.init(args=[], context=context)
    made = rclpy.create_node("n", context=context)
    client = ActionClient(made, Fibonacci, "fib")
    yield made
    client.destroy()
    made.destroy_node()
    rclpy.try_shutdown(context=context)


def node_response(node: Any, type_hash: str) -> Any:
    request = GetTypeDescription.Request(type_hash=type_hash, include_type_sources=True)
    return node._type_description_service._answer(request, GetTypeDescription.Response())


def outcome(asking: Generator[Any, Any, str], answer: Any) -> str:
    """Return the outcome of an inquiry if `answer(name, hash)` gives the responses."""
    question = next(asking)
    while True:
        try:
            question = asking.send(answer(*question))
        except StopIteration as over:
            return over.value


def test_action_hash_follows_from_the_hashes_of_its_parts(node: Any) -> None:
    asked: list[str] = []

    def answer(name: str, type_hash: str) -> Any:
        asked.append(name)
        return node_response(node, type_hash)

    assert outcome(inquiry(NAME, HASHES), answer) == ""
    assert asked == [*HASHES, NAME]


def test_part_with_another_hash_is_refused(node: Any) -> None:
    last = list(HASHES)[-1]

    def answer(name: str, type_hash: str) -> Any:
        response = node_response(node, type_hash)
        if name == last:
            response.type_description.type_description.fields[1].name = "backfeed"
        return response

    assert (
        outcome(inquiry(NAME, HASHES), answer)
        == f"describes it by a definition that does not have the hash {HASHES[last]}"
    )


def test_useless_answers_are_reported(node: Any) -> None:
    assert outcome(inquiry(NAME, HASHES), lambda name, type_hash: None) == "has not described it"
    refused = outcome(inquiry(NAME, HASHES), lambda name, type_hash: node_response(node, "RIHS01_" + "0" * 64))
    assert refused == "does not describe it: Type not currently in use by this node"
    # The hashes are correct, but belong to another action.
    other = {name.replace("Fibonacci", "Other"): hashed for name, hashed in HASHES.items()}
    elsewhere = outcome(
        inquiry(NAME.replace("Fibonacci", "Other"), other), lambda name, each: node_response(node, each)
    )
    assert elsewhere.startswith("sent a description of it that is invalid: the definition of example_interfaces/action")


@pytest.mark.parametrize(
    ("part", "type_name"),
    [
        ("a_b/action/Dig_FeedbackMessage", "a_b/action/Dig"),
        ("a_b/action/Dig_SendGoal", "a_b/action/Dig"),
        ("a_b/action/Dig", "a_b/action/Dig"),
        ("a_b/srv/Dig_Event", "a_b/srv/Dig_Event"),
    ],
)
def test_part_of_an_action_is_requested_as_the_whole_action(part: str, type_name: str) -> None:
    assert containing_action(part) == type_name
