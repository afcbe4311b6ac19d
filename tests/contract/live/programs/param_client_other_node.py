"""Setting parameters of another node over its services."""

import rclpy
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, ListParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor

rclpy.init()
server = rclpy.create_node("server")
server.declare_parameter("gain", 1.0)
server.declare_parameter("group.a", 1)
asker = rclpy.create_node("asker")
executor = SingleThreadedExecutor()
executor.add_node(server)
executor.add_node(asker)


def ask(kind, name, request):
    client = asker.create_client(kind, name)
    client.wait_for_service()
    future = client.call_async(request)
    executor.spin_until_future_complete(future)
    return future.result()


value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=4.5)
results = ask(
    SetParameters, "/server/set_parameters", SetParameters.Request(parameters=[ParameterMsg(name="gain", value=value)])
)
print(results.results[0].successful, server.get_parameter("gain").value)
values = ask(GetParameters, "/server/get_parameters", GetParameters.Request(names=["gain", "nope"]))
print([each.type for each in values.values])
listed = ask(ListParameters, "/server/list_parameters", ListParameters.Request(prefixes=["group"], depth=10))
print(listed.result.names, listed.result.prefixes)
rclpy.shutdown()
