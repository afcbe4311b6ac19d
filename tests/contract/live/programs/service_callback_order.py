"""Several requests in flight, answered in order, with done callbacks."""

import rclpy
from std_srvs.srv import SetBool

rclpy.init()
node = rclpy.create_node("order")
log = []


def serve(request, response):
    log.append(f"serve {request.data}")
    response.success = request.data
    return response


node.create_service(SetBool, "s", serve)
client = node.create_client(SetBool, "s")
client.wait_for_service()
futures = []
for flag in (True, False, True):
    future = client.call_async(SetBool.Request(data=flag))
    future.add_done_callback(lambda f: log.append(f"done {f.result().success}"))
    futures.append(future)
while sum(each.startswith("done") for each in log) < 3:
    rclpy.spin_once(node, timeout_sec=0.1)
print([each for each in log if each.startswith("serve")])
print([each for each in log if each.startswith("done")])
rclpy.shutdown()
