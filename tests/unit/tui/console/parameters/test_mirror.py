"""Reading the parameters of many nodes: a few at a time, each for itself, and only those that are still there."""

import asyncio
from collections import Counter

import pytest
from bot_console.tui.console.calls import NoAnswer
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.parameters.mirror import WINDOW, ParameterMirror
from rcl_interfaces.msg import ParameterDescriptor, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters

MANY = 4 * WINDOW


class StubNode:
    """Takes what a mirror creates."""

    def create_subscription(self, *args):
        return None

    def create_timer(self, period, callback):
        self.look_again = callback


class Asked:
    """Answers for all nodes; those in `silent` never do, the others when `open` is set."""

    def __init__(self):
        self.tasks, self.pending, self.most = [], Counter(), 0
        self.times, self.silent, self.open = Counter(), set(), asyncio.Event()

    def run(self, work):
        self.tasks.append(asyncio.ensure_future(work))

    def forget(self, prefix):
        pass

    async def ask(self, kind, service, request):
        node = service.rpartition("/")[0]
        self.times[node] += 1
        self.pending[node] += 1
        self.most = max(self.most, len(+self.pending))
        await self.open.wait()
        self.pending[node] -= 1
        if node in self.silent:
            raise NoAnswer(f"{service} did not answer")
        return self._answer(kind)

    @staticmethod
    def _answer(kind):
        answer = kind.Response()
        if kind is ListParameters:
            answer.result.names = ["speed"]
        elif kind is DescribeParameters:
            answer.descriptors = [ParameterDescriptor(name="speed", type=3)]
        elif kind is GetParameters:
            answer.values = [ParameterValue(type=3, double_value=1.5)]
        return answer


def graph_of(names):
    return GraphInfo(tuple(NodeInfo(name, services=(Endpoint(f"{name}/list_parameters", ()),)) for name in names))


@pytest.fixture
def names():
    return [f"/n{number:03}" for number in range(MANY)]


async def finished(asked):
    while not all(task.done() for task in asked.tasks):
        await asyncio.wait(asked.tasks)


def test_all_nodes_are_read_some_at_a_time(names):
    async def scenario():
        asked = Asked()
        mirror = ParameterMirror(StubNode(), asked, lambda *change: None)
        mirror.follow(graph_of(names))
        await asyncio.sleep(0)
        assert len(+asked.pending) == WINDOW
        asked.open.set()
        await finished(asked)
        assert asked.most == WINDOW
        assert sorted(mirror.trees) == names
        assert {mirror.get(name, "speed").value for name in names} == {1.5}

    asyncio.run(scenario())


def test_a_node_that_does_not_answer_costs_the_others_nothing_that_they_gave(names):
    async def scenario():
        asked = Asked()
        asked.silent = set(names[::5])
        node = StubNode()
        mirror = ParameterMirror(node, asked, lambda *change: None)
        asked.open.set()
        mirror.follow(graph_of(names))
        await finished(asked)
        assert {name for name, tree in mirror.trees.items() if tree.problem} == asked.silent
        asked.silent = set()
        asked.times.clear()
        node.look_again()
        await finished(asked)
        assert not any(tree.problem for tree in mirror.trees.values())
        assert {asked.times[name] for name in names[1::5]} == {1}  # only whether the names are still the same

    asyncio.run(scenario())


def test_nobody_looks_again_while_nodes_wait_to_be_read(names):
    async def scenario():
        asked, node = Asked(), StubNode()
        mirror = ParameterMirror(node, asked, lambda *change: None)
        mirror.follow(graph_of(names))
        node.look_again()
        asked.open.set()
        await finished(asked)
        assert set(asked.times.values()) == {3}

    asyncio.run(scenario())


def test_who_leaves_while_it_waits_is_not_asked(names):
    async def scenario():
        asked = Asked()
        mirror = ParameterMirror(StubNode(), asked, lambda *change: None)
        mirror.follow(graph_of(names))
        mirror.follow(graph_of(names[: 2 * WINDOW]))
        asked.open.set()
        await finished(asked)
        assert sorted(mirror.trees) == sorted(asked.times) == names[: 2 * WINDOW]

    asyncio.run(scenario())
