"""The order of callbacks that are ready together, by itself; `test_executors.py` has it with nodes."""

from types import SimpleNamespace

from rclpy.impl.callback_order import CLIENT, SERVICE, SUBSCRIPTION, TIMER, WAITABLE, order_key, sort_entities


def test_waitables_of_all_nodes_precede_the_timers_of_the_first() -> None:
    keys = [
        order_key(WAITABLE, 1, 8),
        order_key(TIMER, 0, 2),
        order_key(SUBSCRIPTION, 0, 1),
        order_key(SUBSCRIPTION, 0, 7),
        order_key(TIMER, 1, 0),
        order_key(CLIENT, 1, 4),
        order_key(SERVICE, 1, 3),
    ]
    entities = [SimpleNamespace(key=each) for each in reversed(keys)]
    sort_entities(entities)
    assert [each.key for each in entities] == keys
