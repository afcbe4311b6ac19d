"""automatically_declare_parameters_from_overrides."""

import rclpy

rclpy.init(args=["--ros-args", "-p", "arm.joint1.max:=1.5", "-p", "arm.joint2.max:=2.5", "-p", "name:=x"])
node = rclpy.create_node("n", automatically_declare_parameters_from_overrides=True)
print({name: p.value for name, p in sorted(node.get_parameters_by_prefix("arm").items())})
print(node.get_parameter("name").value, node.has_parameter("use_sim_time"))
rclpy.shutdown()
