"""Arrays and bytes, and the types inferred from them."""

import rclpy
from rclpy.parameter import Parameter

rclpy.init()
node = rclpy.create_node("arrays")
for name, value in (
    ("ints", [1, 2]),
    ("floats", [1.0, 2.5]),
    ("words", ["a"]),
    ("flags", [True, False]),
    ("raw", [b"\x01", b"\x02"]),
):
    p = node.declare_parameter(name, value)
    print(name, p.type_, list(p.value))
for value in ([1, 2.0], {"a": 1}, object, [1, "a"], []):
    try:
        print(Parameter("x", value=value).type_)
    except Exception as error:
        print(type(error).__name__)
rclpy.shutdown()
