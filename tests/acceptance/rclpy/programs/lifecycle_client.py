"""Takes the talker through its states by its services, as a launch script or supervisor would."""

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState


def main():
    rclpy.init()
    node = rclpy.create_node("lc_client")
    change = node.create_client(ChangeState, "lc_talker/change_state")
    state = node.create_client(GetState, "lc_talker/get_state")
    change.wait_for_service()

    def call(client, request):
        future = client.call_async(request)
        rclpy.spin_until_future_complete(node, future)
        return future.result()

    for transition in (
        Transition.TRANSITION_CONFIGURE,
        Transition.TRANSITION_ACTIVATE,
        Transition.TRANSITION_DEACTIVATE,
        Transition.TRANSITION_CLEANUP,
        Transition.TRANSITION_UNCONFIGURED_SHUTDOWN,
    ):
        success = call(change, ChangeState.Request(transition=Transition(id=transition))).success
        print(success, call(state, GetState.Request()).current_state.label)
        node.get_clock().sleep_for(rclpy.duration.Duration(seconds=2.6))
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
