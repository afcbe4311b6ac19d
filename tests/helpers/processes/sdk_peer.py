"""Another implementation of rmw_zenoh's format, zenoh-ros2-sdk, as a process that publishes, subscribes, serves and
calls.
"""

import itertools
import queue
import time
from types import SimpleNamespace

from zenoh_ros2_sdk.publisher import ROS2Publisher
from zenoh_ros2_sdk.service_client import ROS2ServiceClient
from zenoh_ros2_sdk.service_server import ROS2ServiceServer
from zenoh_ros2_sdk.subscriber import ROS2Subscriber

TEXT = ("std_msgs/msg/String", "string data\n")
ADD = "example_interfaces/srv/AddTwoInts"
PARTS = {"request_definition": "int64 a\nint64 b\n", "response_definition": "int64 sum\n"}


def add(request: SimpleNamespace) -> object:
    """The response of the server."""
    return server.response_msg_class(sum=request.a + request.b)


received_texts: queue.Queue[str] = queue.Queue()
chatter = ROS2Publisher("/chatter", TEXT[0], msg_definition=TEXT[1], node_name="sdk")
heard = ROS2Publisher("/heard", TEXT[0], msg_definition=TEXT[1], node_name="sdk")
ROS2Subscriber(
    "/said", TEXT[0], lambda message: received_texts.put(message.data), msg_definition=TEXT[1], node_name="sdk"
)
server = ROS2ServiceServer("/add", ADD, add, node_name="sdk", **PARTS)
asking = ROS2ServiceClient("/add_here", ADD, node_name="sdk", **PARTS)

for number in itertools.count():
    chatter.publish(data=f"hello {number}")
    if not received_texts.empty():
        answer = asking.call(a=20, b=22)
        heard.publish(data=f"{received_texts.get()} {getattr(answer, 'sum', None)}")
    time.sleep(0.05)
