"""Two contexts with a node each."""

import rclpy
from rclpy.context import Context
from rclpy.node import Node

first, second = Context(), Context()
rclpy.init(context=first)
second.init()
one, two = Node("one", context=first), Node("two", context=second)
print(first.ok(), second.ok(), one.context is first)
first.shutdown()
print(first.ok(), second.ok())
second.try_shutdown()
with Context() as third:
    third.init()
    print(third.ok(), third.get_domain_id() >= 0)
print(third.ok())
