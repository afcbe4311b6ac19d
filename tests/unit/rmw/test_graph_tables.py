"""The tables of the graph always agree with a list of all entities."""

import gc
import threading
from collections.abc import Iterator

import pytest
from bot_console.runtime.rmw.endpoints import ClientEndpoint, NodeId
from bot_console.runtime.rmw.graph_tables import GraphTables, collect
from hypothesis import given
from hypothesis import strategies as st

NODES = [NodeId("a", "/"), NodeId("a", "/", number=1), NodeId("b", "/x")]
CLIENTS = [
    ClientEndpoint(node, name, kind, lambda: None) for node in NODES for name in ("/s", "/t") for kind in ("K", "L")
]


@given(st.lists(st.tuples(st.booleans(), st.sampled_from(CLIENTS))))
def test_tables_agree_with_a_plain_list_of_endpoints(changes):
    tables, there = GraphTables(threading.RLock()), {}
    for comes, each in changes:
        if comes:
            tables.clients.add(each)
            there.setdefault(each)
        else:
            tables.clients.remove(each)
            there.pop(each, None)
    clients = tables.clients
    assert set(clients.all()) == set(there)
    assert list(clients.on("/s")) == [each for each in there if each.name == "/s"]
    assert collect(clients.pairs()) == collect((each.name, each.type_name) for each in there)
    for owner in {each.owner for each in NODES}:
        owned = collect((each.name, each.type_name) for each in there if each.node.owner == owner)
        assert collect(clients.of(owner)) == owned


@given(st.lists(st.tuples(st.booleans(), st.sampled_from(NODES))))
def test_name_exists_while_one_node_has_it(changes):
    tables, there = GraphTables(threading.RLock()), {}
    for comes, each in changes:
        if comes:
            tables.add_node(each)
            there.setdefault(each)
        else:
            tables.remove_node(each)
            there.pop(each, None)
    assert list(tables.nodes()) == list(there)
    assert {owner for owner in (each.owner for each in NODES) if tables.has(owner)} == {each.owner for each in there}


@pytest.fixture
def eager_collector() -> Iterator[None]:
    """Make the garbage collector run as often as possible."""
    before = gc.get_threshold()
    gc.set_threshold(1)
    yield
    gc.set_threshold(*before)


def test_garbage_collection_during_a_change_does_not_deadlock(eager_collector):
    tables = GraphTables(threading.RLock())
    old = [ClientEndpoint(NODES[0], "/s", f"K{number}", lambda: None) for number in range(200)]
    new = [ClientEndpoint(NODES[0], "/s", f"L{number}", lambda: None) for number in range(200)]
    for each in old:
        tables.clients.add(each)
    left = list(old)

    def end_one(phase, info):
        if phase == "stop" and left:
            tables.clients.remove(left.pop())

    gc.callbacks.append(end_one)
    try:
        for each in new:
            tables.clients.add(each)
            tables.clients.on("/s")
            tables.clients.pairs()
    finally:
        gc.callbacks.remove(end_one)
    assert len(left) < 200, "the collector never ran"
    for each in left:
        tables.clients.remove(each)
    assert list(tables.clients.on("/s")) == new
    assert {kind for _, kind in tables.clients.pairs()} == {each.type_name for each in new}
