"""The tables of the graph say at any moment what a list of all that is there would."""

from bot_console.runtime.rmw.endpoints import ClientEndpoint, NodeId
from bot_console.runtime.rmw.graph_tables import GraphTables, collect
from hypothesis import given
from hypothesis import strategies as st

NODES = [NodeId("a", "/"), NodeId("a", "/", number=1), NodeId("b", "/x")]
CLIENTS = [
    ClientEndpoint(node, name, kind, lambda: None) for node in NODES for name in ("/s", "/t") for kind in ("K", "L")
]


@given(st.lists(st.tuples(st.booleans(), st.sampled_from(CLIENTS))))
def test_tables_are_those_of_all_that_is_there(changes):
    tables, there = GraphTables(), {}
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
def test_a_name_is_there_while_one_node_has_it(changes):
    tables, there = GraphTables(), {}
    for comes, each in changes:
        if comes:
            tables.add_node(each)
            there.setdefault(each)
        else:
            tables.remove_node(each)
            there.pop(each, None)
    assert list(tables.nodes()) == list(there)
    assert {owner for owner in (each.owner for each in NODES) if tables.has(owner)} == {each.owner for each in there}
