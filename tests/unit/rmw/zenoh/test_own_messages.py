"""Messages delivered within a process do not arrive a second time over the mesh."""

import time

from bot_console.runtime.rmw.zenoh.domain.domain_bus import share_domains
from domains import unused_domain
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

LATCHED = QoSProfile(depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def test_late_subscription_gets_latched_message_of_its_own_process_once():
    share_domains()
    context = Context()
    context.init([], domain_id=unused_domain())
    node = Node("both", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    heard = []
    publisher = node.create_publisher(String, "/kept", LATCHED)
    for text in ("one", "two"):
        publisher.publish(String(data=text))
    node.create_subscription(String, "/kept", lambda message: heard.append(message.data), LATCHED)
    publisher.publish(String(data="three"))
    until = time.monotonic() + 0.3  # the session's cache answers within 1 ms
    while time.monotonic() < until:
        executor.spin_once(timeout_sec=0.05)
    node.destroy_node()
    context.try_shutdown()
    assert heard == ["one", "two", "three"]
