import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import ReentrantCallbackGroup

rclpy.init()
node = rclpy.create_node("minimal_client")
group = ReentrantCallbackGroup()
client = node.create_client(AddTwoInts, "add_two_ints", callback_group=group)
calls = []


async def call_service():
    calls.append(len(calls))
    number = calls[-1]
    response = await client.call_async(AddTwoInts.Request(a=number, b=40))
    node.get_logger().info(f"{number} + 40 = {response.sum}")
    if number == 2:
        timer.cancel()
        rclpy.shutdown()


while not client.wait_for_service(timeout_sec=1.0):
    node.get_logger().info("waiting")
timer = node.create_timer(0.5, call_service, callback_group=group)
rclpy.spin(node)
