"""Reading the parameters of many nodes: a few at a time, independently, and only of nodes that are still there."""

import asyncio
from collections import Counter
from dataclasses import replace

import pytest
from bot_console.tui.console.calls import NoAnswer
from bot_console.tui.console.model import ChangeSource, Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.parameters.mirror import MAX_CONCURRENT_QUERIES, ParameterMirror
from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterEvent, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters

MANY = 4 * MAX_CONCURRENT_QUERIES


class StubNode:
    """Accepts everything that a mirror creates."""

    def create_subscription(self, kind, topic, callback, qos):
        self.event = callback

    def create_timer(self, period, callback):
        self.poll_again = callback


class FakeCalls:
    """Responds for all nodes; those in `silent` never do, the others once `open` is set."""

    def __init__(self):
        self.tasks, self.pending, self.maximum = [], Counter(), 0
        self.times, self.silent, self.open = Counter(), set(), asyncio.Event()
        self.value, self.description = 1.5, ""

    def run(self, work):
        self.tasks.append(asyncio.ensure_future(work()))

    def forget(self, prefix):
        pass

    async def ask(self, kind, service, request):
        node = service.rpartition("/")[0]
        self.times[node] += 1
        self.pending[node] += 1
        self.maximum = max(self.maximum, len(+self.pending))
        await self.open.wait()
        self.pending[node] -= 1
        if node in self.silent:
            raise NoAnswer(f"{service} did not answer")
        return self._answer(kind)

    def _answer(self, kind):
        answer = kind.Response()
        if kind is ListParameters:
            answer.result.names = ["speed"]
        elif kind is DescribeParameters:
            answer.descriptors = [ParameterDescriptor(name="speed", type=3, description=self.description)]
        elif kind is GetParameters:
            answer.values = [ParameterValue(type=3, double_value=self.value)]
        return answer


def graph_of(names):
    return GraphInfo(tuple(NodeInfo(name, services=(Endpoint(f"{name}/list_parameters", ()),)) for name in names))


def speed(value):
    return Parameter(name="speed", value=ParameterValue(type=3, double_value=value))


@pytest.fixture
def names():
    return [f"/n{number:03}" for number in range(MANY)]


async def finished(asked):
    while not all(task.done() for task in asked.tasks):
        await asyncio.wait(asked.tasks)


def test_all_nodes_are_read_a_few_at_a_time(names):
    async def scenario():
        asked = FakeCalls()
        mirror = ParameterMirror(StubNode(), asked, lambda *change: None)
        mirror.follow(graph_of(names))
        await asyncio.sleep(0)
        assert len(+asked.pending) == MAX_CONCURRENT_QUERIES
        asked.open.set()
        await finished(asked)
        assert asked.maximum == MAX_CONCURRENT_QUERIES
        assert sorted(mirror.trees) == names
        assert {mirror.get(name, "speed").value for name in names} == {1.5}

    asyncio.run(scenario())


def test_nodes_are_listed_in_natural_order():
    async def scenario():
        asked = FakeCalls()
        asked.open.set()
        mirror = ParameterMirror(StubNode(), asked, lambda *change: None)
        mirror.follow(graph_of(["/robot10", "/robot2", "/robot1"]))
        await finished(asked)
        assert list(mirror.trees) == ["/robot1", "/robot2", "/robot10"]

    asyncio.run(scenario())


def test_a_silent_node_does_not_affect_values_of_others(names):
    async def scenario():
        asked = FakeCalls()
        asked.silent = set(names[::5])
        node = StubNode()
        mirror = ParameterMirror(node, asked, lambda *change: None)
        asked.open.set()
        mirror.follow(graph_of(names))
        await finished(asked)
        assert {name for name, tree in mirror.trees.items() if tree.problem} == asked.silent
        asked.silent = set()
        asked.times.clear()
        node.poll_again()
        await finished(asked)
        assert not any(tree.problem for tree in mirror.trees.values())
        # The others are asked only whether names and values are still the same.
        assert {asked.times[name] for name in names[1::5]} == {2}

    asyncio.run(scenario())


def test_nodes_are_not_relisted_while_others_wait_to_be_read(names):
    async def scenario():
        asked, node = FakeCalls(), StubNode()
        mirror = ParameterMirror(node, asked, lambda *change: None)
        mirror.follow(graph_of(names))
        node.poll_again()
        asked.open.set()
        await finished(asked)
        assert set(asked.times.values()) == {3}

    asyncio.run(scenario())


def test_a_node_that_leaves_while_waiting_is_not_queried(names):
    async def scenario():
        asked = FakeCalls()
        mirror = ParameterMirror(StubNode(), asked, lambda *change: None)
        mirror.follow(graph_of(names))
        mirror.follow(graph_of(names[: 2 * MAX_CONCURRENT_QUERIES]))
        asked.open.set()
        await finished(asked)
        assert sorted(mirror.trees) == sorted(asked.times) == names[: 2 * MAX_CONCURRENT_QUERIES]

    asyncio.run(scenario())


@pytest.mark.parametrize("seen", ["gone", "by its event", "by its value alone"])
def test_the_value_after_a_restart_is_the_start_value_set_by_nobody(seen):
    async def scenario():
        asked, node, changed, on_restart = FakeCalls(), StubNode(), [], []
        asked.open.set()

        def set_by(*change):
            changed.append(change)
            return ChangeSource.EDIT

        mirror = ParameterMirror(node, asked, set_by, None, lambda *change: on_restart.append(change))
        mirror.follow(graph_of(["/n"]))
        await finished(asked)
        node.event(ParameterEvent(node="/n", changed_parameters=[speed(4.0)]))
        assert mirror.get("/n", "speed").origin.startswith("set here")
        asked.value, asked.description = 2.5, "in m/s"
        if seen == "gone":
            mirror.follow(graph_of([]))
            mirror.follow(graph_of(["/n"]))
        elif seen == "by its value alone":
            node.poll_again()
        else:
            node.event(ParameterEvent(node="/n", new_parameters=[speed(2.5)]))
        await finished(asked)
        now = mirror.get("/n", "speed")
        assert (now.value, now.default, now.origin, now.description) == (2.5, 2.5, "start value", "in m/s")
        assert changed == [("/n", "speed", 1.5, 4.0)] and on_restart == [("/n", "speed", 4.0, 2.5)]

    asyncio.run(scenario())


def test_a_value_that_is_read_before_its_event_arrives_was_changed_by_the_event():
    async def scenario():
        asked, node, changed = FakeCalls(), StubNode(), []
        asked.open.set()
        mirror = ParameterMirror(node, asked, lambda *change: changed.append(change) or ChangeSource.OTHER)
        mirror.follow(graph_of(["/n"]))
        await finished(asked)
        asked.value = 2.5
        node.event(ParameterEvent(node="/n", new_parameters=[Parameter(name="other")]))  # the node is read again
        await finished(asked)
        assert mirror.get("/n", "speed").value == 2.5 and changed == []
        for value in (2.5, 2.5):
            node.event(ParameterEvent(node="/n", changed_parameters=[speed(value)]))
        assert changed == [("/n", "speed", 1.5, 2.5), ("/n", "speed", 2.5, 2.5)]
        assert "set by another program" in mirror.get("/n", "speed").origin

    asyncio.run(scenario())


def test_a_node_that_returns_unchanged_has_not_restarted():
    async def scenario():
        asked, on_restart = FakeCalls(), []
        asked.open.set()
        mirror = ParameterMirror(
            StubNode(), asked, lambda *change: None, None, lambda *change: on_restart.append(change)
        )
        for names in (["/n"], [], ["/n"]):
            mirror.follow(graph_of(names))
            await finished(asked)
        assert mirror.get("/n", "speed").value == 1.5 and on_restart == []

    asyncio.run(scenario())


def test_when_one_of_two_nodes_with_the_same_name_leaves_the_other_is_read():
    async def scenario():
        asked, node, on_restart = FakeCalls(), StubNode(), []
        asked.open.set()
        mirror = ParameterMirror(node, asked, lambda *change: None, None, lambda *change: on_restart.append(change))
        one = graph_of(["/n"])
        two = GraphInfo((replace(one.nodes[0], copies=2),))
        mirror.follow(two)
        await finished(asked)
        asked.value = 2.5
        mirror.follow(two)
        await finished(asked)
        assert mirror.get("/n", "speed").value == 1.5, "nothing has changed in the graph"
        mirror.follow(one)
        await finished(asked)
        assert mirror.get("/n", "speed").value == 2.5
        assert on_restart == [("/n", "speed", 1.5, 2.5)]

    asyncio.run(scenario())
