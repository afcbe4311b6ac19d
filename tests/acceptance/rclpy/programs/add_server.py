import rclpy
from example_interfaces.srv import AddTwoInts


def add_two_ints_callback(request, response):
    response.sum = request.a + request.b
    node.get_logger().info(f"Incoming request a: {request.a} b: {request.b}")
    return response


rclpy.init()
node = rclpy.create_node("minimal_service")
srv = node.create_service(AddTwoInts, "add_two_ints", add_two_ints_callback)
while rclpy.ok():
    rclpy.spin_once(node)
