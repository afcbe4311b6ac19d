"""Programs with managed nodes, in the style of the public tutorials."""

from __future__ import annotations

import re
from pathlib import Path

from systems import system

PROGRAMS = Path(__file__).parent / "programs"


def test_talker_is_led_through_its_states_by_a_program() -> None:
    with system() as running:
        talker = running.python(str(PROGRAMS / "lifecycle_talker.py"))
        listener = running.python(str(PROGRAMS / "lifecycle_listener.py"))
        client = running.finish(running.python(str(PROGRAMS / "lifecycle_client.py")))
    assert client.stdout.splitlines() == [
        "True inactive",
        "True active",
        "True inactive",
        "True unconfigured",
        "True finalized",
    ]
    assert listener.stdout.splitlines() == [
        "unconfigured -> configuring",
        "configuring -> inactive",
        "inactive -> activating",
        "activating -> active",
        "heard hello 3",
        "heard hello 4",
        "heard hello 5",
        "active -> deactivating",
        "deactivating -> inactive",
        "inactive -> cleaningup",
        "cleaningup -> unconfigured",
        "unconfigured -> shuttingdown",
        "shuttingdown -> finalized",
    ]
    assert re.findall(r"\[lc_talker\]: (.*)", talker.stderr) == [
        "on_configure from unconfigured",
        "inactive, not published",
        "inactive, not published",
        "on_activate",
        "on_deactivate",
        "inactive, not published",
        "inactive, not published",
        "on_cleanup",
        "on_shutdown from unconfigured",
    ]


def test_transition_id_out_of_range_ends_the_node() -> None:
    wrong = (
        "import rclpy; from lifecycle_msgs.srv import ChangeState; from lifecycle_msgs.msg import Transition; "
        "rclpy.init(); n = rclpy.create_node('n'); c = n.create_client(ChangeState, '/lc_talker/change_state'); "
        "c.wait_for_service(); f = c.call_async(ChangeState.Request(transition=Transition(id=3))); "
        "rclpy.spin_until_future_complete(n, f, timeout_sec=5.0); print(f.done())"
    )
    with system() as running:
        talker = running.python(str(PROGRAMS / "lifecycle_talker.py"))
        client = running.finish(running.python("-c", wrong))
    assert (client.stdout, talker.exit) == ("False\n", 1)
    assert "Failed to trigger lifecycle state machine transition: Transition is not registered." in talker.stderr
