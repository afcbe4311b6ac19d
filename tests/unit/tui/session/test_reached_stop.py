"""What `bot-console stop` knows of the robots in its domain."""

from __future__ import annotations

import rclpy
from bot_console.tui.session.reached_stop import ReachedStop
from diagnostic_msgs.msg import DiagnosticStatus
from domains import unused_domain
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.context import Context


def test_robots_without_a_lock_in_their_namespace_are_found() -> None:
    context = Context()
    context.init(["test"], domain_id=unused_domain())
    node = rclpy.create_node("robots", context=context)
    node.create_publisher(DiagnosticStatus, "/emergency_stop/base", 1)
    node.create_publisher(DiagnosticStatus, "/left/emergency_stop/arbiter", 1)
    for topic in ("/cmd_vel", "/left/cmd_vel", "/cart/cmd_vel", "/cart/cmd_vel_nav"):
        node.create_subscription(Twist, topic, print, 1)
    node.create_subscription(TwistStamped, "/arm/cmd_vel", print, 1)
    node.create_publisher(Twist, "/nobody/cmd_vel", 1)
    reached = ReachedStop("stop")
    reached._node = node
    assert sorted(reached.unlocked()) == ["/arm/cmd_vel", "/cart/cmd_vel"]
    node.destroy_node()
    context.try_shutdown()
