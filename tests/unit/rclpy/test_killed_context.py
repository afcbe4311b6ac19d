"""A killed process may run a little longer: what it still creates never appears in the graph."""

import gc
import weakref

import pytest
from bot_console.runtime.process import NodeProcess
from bot_console.runtime.process.current import running_as
from bot_console.runtime.rmw.local import local_bus
from domains import unused_domain
from rclpy.context import Context
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


@pytest.fixture
def domain():
    return unused_domain()


@pytest.fixture
def process():
    made = NodeProcess("killed")
    with running_as(made):
        yield made


def graph_entities(domain):
    (graph,) = local_bus(domain).tables()
    ends = (graph.publishers, graph.subscriptions, graph.servers, graph.clients)
    return [*graph.nodes(), *(each for kind in ends for each in kind.all())]


def test_entities_created_after_the_kill_stay_out_of_the_graph(process, domain, monkeypatch):
    context = Context()
    context.init([], domain_id=domain)
    node = Node("n", context=context)
    process.finish(-9)
    monkeypatch.setattr(context, "ended", False)  # the state when each of these checked
    node.create_publisher(String, "t", 10)
    node.create_subscription(String, "t", lambda message: None, 10)
    node.create_service(Trigger, "s", lambda request, response: response)
    node.create_client(Trigger, "s")
    assert graph_entities(domain) == []
    node.destroy_node()
    assert graph_entities(domain) == []


def test_node_created_while_its_context_ends_stays_out_of_the_graph(process, domain, monkeypatch):
    context = Context()
    context.init([], domain_id=domain)
    process.finish(-9)
    monkeypatch.setattr(context, "ended", False)  # the state when the node checked
    Node("n", context=context)
    assert graph_entities(domain) == []


def test_context_initialized_after_the_end_is_not_ok(process, domain):
    process.finish(-9)
    context = Context()
    context.init([], domain_id=domain)
    assert not context.ok()


def test_nodes_of_a_shut_down_context_leave_with_the_process(process, domain):
    context = Context()
    context.init([], domain_id=domain)
    node = Node("n", context=context)
    context.shutdown()
    assert graph_entities(domain) != []
    process.finish(-9)
    assert graph_entities(domain) == []
    node.destroy_node()


def test_process_does_not_keep_shut_down_contexts(process, domain):
    context = Context()
    context.init([], domain_id=domain)
    Node("n", context=context).destroy_node()
    context.shutdown()
    there = weakref.ref(context)
    del context
    gc.collect()
    assert there() is None
    process.finish(-9)


def test_pending_interrupt_is_raised_before_the_error_it_causes(process, domain, monkeypatch):
    def deliver():
        raise KeyboardInterrupt

    context = Context()
    context.init([], domain_id=domain)
    publisher = Node("n", context=context).create_publisher(String, "t", 10)
    context.shut_down_by_signal()
    monkeypatch.setattr(process, "deliver_signals", deliver)
    for message in (String(), b""):
        with pytest.raises(KeyboardInterrupt):
            publisher.publish(message)
