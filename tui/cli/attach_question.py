"""The question at start-up if a robot is already running: whether to attach to it, or to start nothing."""

from __future__ import annotations

from bot_console.tui.session.embedded.domain import domain


def wants_to_attach(there: list[str], *, robot: bool) -> bool:
    """Ask whether to attach to a running robot, or to nodes that have the names of our robot's nodes.

    Two robots in one domain would obey each other's commands, and two nodes of one name share their parameters and log.
    """
    from bot_console.runtime.workspace.builtin_package import NAME
    from bot_console.tui.session.embedded.workspaces import NAVIGATOR

    number = domain()
    if robot:
        print(f"A robot is already running in ROS domain {number}: {', '.join(there)}.")
        print(f"`ROS_DOMAIN_ID={number + 1} bot-console` starts another one in isolation.")
        question = "Attach the console to the running one? [Y/n] "
    else:
        print(f"Nodes with our robot's node names run in ROS domain {number}: {', '.join(there)}.")
        if there == [NAVIGATOR]:
            print("`bot-console navigator:=false` starts our robot without its navigator,")
        print(f"`bot-console --launch {NAME} simulator.launch.py` adds only a robot,")
        print(f"`ROS_DOMAIN_ID={number + 1} bot-console` starts ours in isolation from them.")
        question = "Attach the console to them, without a robot? [Y/n] "
    try:
        return input(question).strip().lower() in ("", "y", "yes")
    except (EOFError, KeyboardInterrupt):
        print()
        return False
