"""Finds nodes that are in the graph but do not respond: DDS keeps a killed node for about ten seconds.

rclpy does not report whether a node is alive, so each node is asked for the types of an empty list of parameters, the
smallest possible request.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from bot_console.tui.console.calls import LINK_DELAYS, LinkDelay, no_delay
from bot_console.tui.console.model import GraphInfo
from rcl_interfaces.srv import GetParameterTypes
from rclpy.node import Node
from rclpy.task import Future

SERVICE = "get_parameter_types"
POLL_S = 0.5
"""Seconds between two polls."""
OVERDUE_POLLS = 2
"""Polls after which a response is overdue. Counting polls instead of time keeps nodes from seeming late when this
program itself got no processor time. On a slow link, `LINK_DELAYS` round trips are added.
"""
RETRY_POLLS = 4
"""Polls after which a request counts as lost and is sent again; on a slow link more."""
MAX_REQUESTS_PER_POLL = 25
"""Requests per poll; if there are more nodes, each is asked less often."""


class _PolledNode:
    """A node and the last request sent to it."""

    def __init__(self, client: Any) -> None:
        self.client = client
        self.answer: Future[Any] | None = None
        self.polls = OVERDUE_POLLS
        """Polls since the request, or since its response if there was one."""
        self.has_responded = False
        """Whether the node has ever responded."""

    @property
    def waiting(self) -> bool:
        """Whether the response to the request is pending."""
        return self.answer is not None and not self.answer.done()


class UnresponsiveNodes:
    """Asks the nodes of the graph, at most once a second and only while somebody is viewing them.

    `changed` receives the names of the nodes that do not respond. All methods are called by the executor's thread.
    """

    def __init__(
        self, node: Node, changed: Callable[[tuple[str, ...]], None], link_delay: LinkDelay = no_delay
    ) -> None:
        self._node = node
        self._link_delay = link_delay
        self._changed = changed
        self._timer: Any = None
        self._nodes: dict[str, _PolledNode] = {}
        self._silent: frozenset[str] = frozenset()

    def poll(self, on: bool, graph: GraphInfo) -> None:
        """Start or stop asking the nodes."""
        if on and self._timer is None:
            self._timer = self._node.create_timer(POLL_S, self.tick)
        elif not on and self._timer is not None:
            self._node.destroy_timer(self._timer)
            self._timer = None
        self.follow(graph)

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph. A node without parameter services cannot be asked, and never counts as silent."""
        nodes = graph.nodes if self._timer is not None else ()
        asked = {each.name for each in nodes if any(own.name == f"{each.name}/{SERVICE}" for own in each.services)}
        for name in self._nodes.keys() - asked:
            self._node.destroy_client(self._nodes.pop(name).client)
        for name in sorted(asked - self._nodes.keys()):
            self._nodes[name] = _PolledNode(self._node.create_client(GetParameterTypes, f"{name}/{SERVICE}"))
        self._report(self._silent & asked)

    def tick(self) -> None:
        """Find the nodes that have not responded, and ask those whose turn it is."""
        for each in self._nodes.values():
            each.polls += 1
        on_the_way = round(LINK_DELAYS * self._link_delay() / POLL_S)
        overdue, retry = OVERDUE_POLLS + on_the_way, RETRY_POLLS + 2 * on_the_way
        late = {name for name, each in self._nodes.items() if each.waiting and each.polls >= overdue}
        self._report(self._silent | late)
        due = [name for name, each in self._nodes.items() if each.polls >= (retry if each.waiting else OVERDUE_POLLS)]
        for name in due[:MAX_REQUESTS_PER_POLL]:
            self._ask(name)

    def _ask(self, name: str) -> None:
        asked = self._nodes.pop(name)
        self._nodes[name] = asked  # moves to the end, so that the others are asked first next time
        if not asked.client.service_is_ready():
            if asked.has_responded:
                self._report(self._silent | {name})
            return  # a new client first has to discover its server
        if asked.answer is not None and not asked.answer.done():
            asked.client.remove_pending_request(asked.answer)
        asked.polls = 0
        answer: Future[Any] = asked.client.call_async(GetParameterTypes.Request())
        asked.answer = answer
        answer.add_done_callback(partial(self._answered, name, asked))

    def _answered(self, name: str, asked: _PolledNode, answer: Future[Any]) -> None:
        if answer is asked.answer:
            asked.polls, asked.has_responded = 0, True
            self._report(self._silent - {name})

    def _report(self, silent: frozenset[str]) -> None:
        if silent != self._silent:
            self._silent = silent
            self._changed(tuple(sorted(silent)))
