"""Watches the ROS graph: polls it twice a second or after an event; makes a new object only if it has changed."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from time import monotonic, thread_time
from typing import Any

from bot_console.tui.console.calls import LinkDelay, no_delay
from bot_console.tui.console.graph.full_name import full_node_name
from bot_console.tui.console.graph.observer import Observer
from bot_console.tui.console.graph.pairs import UnheardPairs
from bot_console.tui.console.graph.unresponsive_nodes import UnresponsiveNodes
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.text.natural import NaturalKey, natural_key
from rclpy.node import Node

ACTION_SERVER_TOPIC = "/_action/status"
GRAPH_POLL_S = 0.5
"""Seconds between two polls while something may have changed."""
LONG_POLL_S, MAX_POLL_SHARE = 0.1, 0.2
"""After a poll that took more processor time (s) than the first value, the next one is delayed, so that polling takes
at most the second value as a share of the time.

While hundreds of nodes appear, keys and stops need the interpreter too.
"""

Owner = tuple[str, str]
"""Name and namespace of a node."""

Pairs = Sequence[tuple[str, Sequence[str]]]
"""Names of topics or services with their types."""

Answer = tuple[Pairs, Pairs, Pairs, Pairs]
"""The topics that a node publishes and subscribes to, and the services that it offers and calls."""

NOTHING: Answer = ([], [], [], [])

GraphEvents = Callable[[int, Callable[[Owner], None]], Callable[[], None]]
"""Subscribes to changes of a ROS domain's graph: takes the domain and a callback, and returns a function that
unsubscribes.

The callback receives the node that has changed, in any thread. rclpy has no such events; without them the whole graph
is queried again and again.
"""

HaltedNodes = Callable[[int], tuple[Mapping[int, Sequence[str]], Mapping[str, str]]]
"""Returns the frozen processes of a ROS domain (their nodes, by pid), and the nodes stopped in a debugger, with the
line. rclpy does not know them.
"""


class GraphWatch:
    """Keeps `info` up to date while the node spins, and calls `changed` with each new graph.

    Unchanged nodes stay the same objects. If events report changes, only changed nodes are queried.
    """

    def __init__(
        self,
        node: Node,
        changed: Callable[[GraphInfo], None],
        events: GraphEvents | None = None,
        halted: HaltedNodes | None = None,
        *,
        foreign: bool = False,
        link_delay: LinkDelay = no_delay,
    ) -> None:
        """In a `foreign` system, events report which nodes come and go, but not which of them hang."""
        self.info = GraphInfo()
        self._halted = halted
        self._node = node
        self._observer = Observer(node)
        self._changed = changed
        self._nodes: dict[Owner, tuple[Answer, NodeInfo]] = {}
        self._topics: Pairs = []
        self._services: Pairs = []
        self._news: deque[Owner] = deque()
        self._polled = False
        self._rests_until = 0.0
        self._reported = events is not None
        self._asks_nodes = foreign or events is None
        self._unheard = UnheardPairs(self._observer)
        self._silence = UnresponsiveNodes(node, self._set_silent_nodes, link_delay)
        self._end = events(node.context.get_domain_id(), self._news.append) if events else _do_nothing
        node.create_timer(GRAPH_POLL_S, self._tick)

    def _tick(self) -> None:
        if (self._news or not (self._reported and self._polled)) and monotonic() >= self._rests_until:
            began = thread_time()
            if not self._reported:
                self._observer.poll()
            self.poll()
            took = thread_time() - began
            if took > LONG_POLL_S:
                self._rests_until = monotonic() + took * (1 / MAX_POLL_SHARE - 1)
        self._check_for_halted()

    def _check_for_halted(self) -> None:
        """Look for nodes in a debugger, and for frozen processes, whose nodes stay in the graph and seem alive."""
        if self._halted is None:
            return
        stopped, lines = self._halted(self._node.context.get_domain_id())
        frozen = tuple(sorted((node, pid) for pid, nodes in stopped.items() for node in nodes))
        debugged = tuple(sorted(lines.items()))
        if (frozen, debugged) != (self.info.frozen, self.info.debugged):
            self.info = replace(self.info, frozen=frozen, debugged=debugged)
            self._changed(self.info)

    def close(self) -> None:
        """Stop receiving events."""
        self._end()
        self._observer.close()

    def poll(self) -> None:
        """Query the graph now."""
        known = self._unchanged()  # before the queries, so that changes made meanwhile are queried again
        self._polled = True
        node = self._observer.node
        profiles = Profiles(node)
        owners = Counter(node.get_node_names_and_namespaces())
        nodes = {
            owner: _with_copies(known.get(owner) or self._inspect(owner, profiles), count)
            for owner, count in owners.items()
        }
        different = [each for each in nodes.keys() | self._nodes.keys() if nodes.get(each) is not self._nodes.get(each)]
        if self._reported and not different:
            return
        topics, services = self._names(nodes, different)
        if not different and topics is self._topics and services is self._services:
            return
        old = self.info
        self.info = GraphInfo(
            tuple(sorted((each for _, each in nodes.values()), key=_name)) if different else old.nodes,
            old.topics if topics is self._topics else _endpoints(topics, old.topics),
            old.services if services is self._services else _endpoints(services, old.services),
            frozen=old.frozen,
            debugged=old.debugged,
            silent=old.silent,
            lifecycle=old.lifecycle,
        )
        self._unheard.follow(self.info)
        self.info = replace(self.info, unheard=self._unheard.found, incompatible=self._unheard.incompatible)
        self._nodes, self._topics, self._services = nodes, topics, services
        self._changed(self.info)
        self._silence.follow(self.info)

    def watch_nodes(self, on: bool) -> None:
        """Start or stop checking which nodes do not respond, unless this machine's events report that."""
        if self._asks_nodes:
            self._silence.poll(on, self.info)

    def set_lifecycle_states(self, states: Mapping[str, str]) -> None:
        """Set the states of lifecycle nodes."""
        self.info = replace(self.info, lifecycle=states)
        self._changed(self.info)

    def _set_silent_nodes(self, nodes: tuple[str, ...]) -> None:
        self.info = replace(self.info, silent=nodes)
        self._changed(self.info)

    def _unchanged(self) -> dict[Owner, tuple[Answer, NodeInfo]]:
        """The nodes that need not be queried again."""
        if not (self._reported and self._polled):
            self._news.clear()
            return {}
        known = dict(self._nodes)
        while self._news:
            known.pop(self._news.popleft(), None)
        return known

    def _names(self, nodes: Mapping[Owner, tuple[Answer, NodeInfo]], different: Sequence[Owner]) -> tuple[Pairs, Pairs]:
        """Topics and services; the same objects as before if they are unchanged."""
        changed = [(_answer(nodes, each), _answer(self._nodes, each)) for each in different]
        topics, services = self._topics, self._services
        if not self._reported or any(now[:2] != before[:2] for now, before in changed):
            topics = _keep_if_equal(self._observer.node.get_topic_names_and_types(), topics)
        if not self._reported or any(now[2:] != before[2:] for now, before in changed):
            services = _keep_if_equal(self._observer.node.get_service_names_and_types(), services)
        return topics, services

    def _inspect(self, owner: Owner, profiles: Profiles) -> tuple[Answer, NodeInfo]:
        """Query a node; returns its answer and description, the same object as before if nothing has changed."""
        answer, known = self._ask(*owner), self._nodes.get(owner)
        if known is None:
            return answer, _describe(owner, answer, NodeInfo(""), profiles)
        if known[0] != answer:
            return answer, _describe(owner, answer, known[1], profiles)
        if not self._reported:
            return known
        # An event about a node with the same names may mean an endpoint, or a node, that was replaced with another QoS.
        again = replace(_describe(owner, answer, NodeInfo(""), profiles), copies=known[1].copies)
        return known if again == known[1] else (answer, again)

    def _ask(self, name: str, space: str) -> Answer:
        node = self._observer.node
        asked = (
            node.get_publisher_names_and_types_by_node,
            node.get_subscriber_names_and_types_by_node,
            node.get_service_names_and_types_by_node,
            node.get_client_names_and_types_by_node,
        )
        try:
            publishers, subscriptions, services, clients = (ask(name, space) for ask in asked)
        except RuntimeError:  # the node left between two queries
            return NOTHING
        return publishers, subscriptions, services, clients


def _with_copies(described: tuple[Answer, NodeInfo], copies: int) -> tuple[Answer, NodeInfo]:
    """A node with the number of nodes that share its name; the same object if that number is unchanged."""
    answer, info = described
    return described if info.copies == copies else (answer, replace(info, copies=copies))


def _answer(nodes: Mapping[Owner, tuple[Answer, NodeInfo]], owner: Owner) -> Answer:
    return nodes[owner][0] if owner in nodes else NOTHING


def _keep_if_equal(pairs: Pairs, before: Pairs) -> Pairs:
    return before if pairs == before else pairs


class Profiles:
    """The QoS profiles of one poll: each topic is queried once, however many nodes use it."""

    def __init__(self, node: Node) -> None:
        self._ask = {True: node.get_publishers_info_by_topic, False: node.get_subscriptions_info_by_topic}
        self._found: dict[tuple[str, bool], dict[Owner, str]] = {}

    def of(self, owner: Owner, topic: str, *, publisher: bool) -> str:
        """The profile with which a node publishes or subscribes to a topic; empty if the node has left."""
        key = topic, publisher
        if key not in self._found:
            infos = self._ask[publisher](topic)
            # If a node has several endpoints, the first one counts.
            self._found[key] = {
                (each.node_name, each.node_namespace): qos_text(each.qos_profile) for each in infos[::-1]
            }
        return self._found[key].get(owner, "")


def _describe(owner: Owner, answer: Answer, before: NodeInfo, profiles: Profiles) -> NodeInfo:
    """The description of a node from its answer; endpoints that it already had keep their profiles."""
    publishers, subscriptions, services, clients = answer
    name, space = owner
    return NodeInfo(
        full_node_name(space, name),
        _with_qos(owner, publishers, before.publishers, profiles, publisher=True),
        _with_qos(owner, subscriptions, before.subscriptions, profiles, publisher=False),
        _endpoints(services),
        _endpoints(clients),
        _actions(publishers),
        _actions(subscriptions),
    )


def _with_qos(
    owner: Owner, pairs: Pairs, before: Sequence[Endpoint], profiles: Profiles, *, publisher: bool
) -> tuple[Endpoint, ...]:
    known = {(each.name, each.types): each for each in before if each.qos}
    return tuple(
        known.get((each.name, each.types))
        or Endpoint(each.name, each.types, profiles.of(owner, each.name, publisher=publisher))
        for each in _endpoints(pairs)
    )


def qos_text(profile: Any) -> str:
    """A QoS profile as a short text, such as `reliable volatile 10`."""
    words = [profile.reliability.name, profile.durability.name]
    depth = "all" if profile.history.name == "KEEP_ALL" else str(profile.depth or "")
    return " ".join([*(word.lower().replace("_", " ") for word in words), depth]).strip()


def _name(named: NodeInfo | Endpoint) -> NaturalKey:
    return natural_key(named.name)


def _do_nothing() -> None:
    """Stand-in for unsubscribing when there are no events."""


def _endpoints(pairs: Pairs, before: Sequence[Endpoint] = ()) -> tuple[Endpoint, ...]:
    """The endpoints by name; unchanged ones are the previous objects."""
    known = {each.name: each for each in before}
    found: list[Endpoint] = []
    for name, kinds in pairs:
        types, old = tuple(kinds), known.get(name)
        found.append(old if old is not None and old.types == types else Endpoint(name, types))
    return tuple(sorted(found, key=_name))


def _actions(topics: Pairs) -> tuple[Endpoint, ...]:
    """The actions, recognised by their status topics: servers publish them, clients subscribe."""
    found: list[Endpoint] = []
    for name, _ in topics:
        if name.endswith(ACTION_SERVER_TOPIC):
            action = name[: -len(ACTION_SERVER_TOPIC)]
            feedback = dict(topics).get(action + "/_action/feedback", ())
            found.append(Endpoint(action, tuple(each.removesuffix("_FeedbackMessage") for each in feedback)))
    return tuple(found)
