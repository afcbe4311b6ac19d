"""A program's membership of its ROS domain, whose graph spans all programs of the user on this machine.

Only the composition root calls this: the nodes that a verb, `run` or `launch` starts are then visible to the other
programs, and vice versa.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NoReturn

from bot_console.runtime.domain_id import domain_id
from bot_console.runtime.stop_file_path import STOP_FILE_VARIABLE, stop_file

if TYPE_CHECKING:
    from bot_console.tui.cli.robot_claim import RobotClaim

_taking_part = False
_connected = False

CONNECT_VARIABLE = "BOT_CONSOLE_CONNECT"
"""Names the router as `--connect` would, for verbs, and for shells in which a person works with one robot."""


def unusable_domain() -> str:
    """Why the environment does not name a valid domain, in one line; empty if it does."""
    try:
        domain_id()
    except ValueError as error:
        return f"{error}: unset it, or set 0 to 101"
    return ""


def why_alone() -> str:
    """Why this program cannot find others in its domain, in one line; empty if it can."""
    from bot_console.runtime.rmw.zenoh.domain.folder import FolderRefusedError, domain_folder

    if problem := unusable_domain():
        return problem
    try:
        domain_folder(domain())
    except FolderRefusedError as refused:
        return str(refused)
    return ""


def join_domain() -> str:
    """Make contexts initialised from now on share the graph of their domain; never in a stepped run.

    Returns why that fails, in one line, or an empty text.
    """
    global _taking_part
    if alone := why_alone():
        return alone
    from bot_console.runtime.children.child_discovery import let_children_meet
    from bot_console.runtime.rmw.zenoh.domain.domain_bus import share_domains

    share_domains()
    let_children_meet(True)
    _taking_part = True
    return ""


def take_part() -> str:
    """Join the domain as `join_domain` does, and tell the nodes that this program starts where stops are kept."""
    alone = join_domain()
    if not alone:
        os.environ[STOP_FILE_VARIABLE] = str(stop_file())
    return alone


def note_connection() -> None:
    """Record that this program is a client of a robot's router, instead of a member of this machine's domain."""
    global _connected
    _connected = True


def isolate_from_domain() -> None:
    """Isolate this program and those that it launches from all others, in a socket folder of their own."""
    import atexit
    import shutil
    import tempfile

    from bot_console.runtime.rmw.zenoh.domain.domain_bus import close_shared_buses
    from bot_console.runtime.rmw.zenoh.domain.folder import BASE_VARIABLE

    close_shared_buses()
    place = "/tmp" if os.path.isdir("/tmp") else None  # the path of a socket has to be short, whatever TMPDIR is
    folder = os.environ[BASE_VARIABLE] = tempfile.mkdtemp(prefix="bot-console-", dir=place)
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    join_domain()
    os.environ.pop(STOP_FILE_VARIABLE, None)  # the robot of an isolated system is another one, with its own stops


def is_in_range() -> bool:
    """Whether the environment lets the programs of this machine find each other, as it does by default."""
    from bot_console.runtime.rmw.zenoh.domain.discovery_range import is_in_range

    return is_in_range()


def others_take_part() -> bool:
    """Whether another process of this user is in the domain, according to its socket folder."""
    from bot_console.runtime.rmw.zenoh.domain.folder import FolderRefusedError, domain_folder
    from bot_console.runtime.rmw.zenoh.domain.sockets import process_exists, sockets

    try:
        found = sockets(domain_folder(domain()))
    except FolderRefusedError:
        return False
    return any(each.pid != os.getpid() and process_exists(each.pid) for each in found)


def frozen() -> list[int]:
    """The pids of this user's processes in the domain that are stopped (SIGSTOP, Ctrl-Z, a debugger)."""
    from bot_console.runtime.rmw.zenoh.domain.folder import FolderRefusedError, domain_folder
    from bot_console.runtime.rmw.zenoh.domain.sockets import sockets

    try:
        found = sockets(domain_folder(domain()))
    except FolderRefusedError:
        return []
    return sorted({each.pid for each in found if each.is_stopped()})


def line_in_debugger(pid: int) -> str | None:
    """The line at which a process in the domain is stopped in a debugger; None if it is not."""
    from bot_console.runtime.rmw.zenoh.domain.debugger_note import debugger_line
    from bot_console.runtime.rmw.zenoh.domain.folder import base_folder

    return debugger_line(os.path.join(base_folder(), str(domain())), pid)


def running_robot_nodes() -> list[str]:
    """The nodes of other processes that form a robot: they obey velocities, or publish scans or odometry.

    Tools and consoles, whose names begin with an underscore, only watch the commands to a robot and do not count. Call
    this after `take_part` and before anything runs in this process.
    """
    from bot_console.runtime.rmw.middleware import bus_of
    from bot_console.tui.console.robot.robot_needed import SOURCES, VELOCITY

    if not (_connected or others_take_part()):
        return []
    tables = bus_of(domain()).tables()
    found = [end for each in tables for topic in SOURCES for end in each.publishers.on(topic)]
    found += [end for each in tables for end in each.subscriptions.on(VELOCITY)]
    robots = (each.node for each in found if not each.node.name.startswith("_"))
    return sorted({each.full_name for each in robots})


def nodes_there() -> list[str]:
    """The full names of all nodes in the domain, without tools and consoles. Call this after `take_part`."""
    from bot_console.runtime.rmw.middleware import bus_of

    nodes = [each for table in bus_of(domain()).tables() for each in table.nodes()]
    return sorted(each.full_name for each in nodes if not each.name.startswith("_"))


def robot_claim() -> RobotClaim:
    """The claim to the robot of this domain, for programs that start one; only if `why_alone` returns an empty text."""
    from pathlib import Path

    from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
    from bot_console.tui.cli.robot_claim import RobotClaim

    return RobotClaim(Path(domain_folder(domain())))


def same_names_there(arguments: Mapping[str, str]) -> list[str]:
    """The nodes of other processes that have the names of nodes in our system, launched with these arguments.

    The parameters, logs and commands of two nodes with the same name cannot be told apart. As for
    `running_robot_nodes`, call this after `take_part` and before anything runs in this process.
    """
    from bot_console.tui.session.embedded.workspaces import NAVIGATOR, SYSTEM_NODES

    ours = SYSTEM_NODES - {NAVIGATOR} if "navigator" in arguments else SYSTEM_NODES
    return sorted(ours.intersection(nodes_there())) if others_take_part() else []


def why_no_robot(robot: Sequence[str], arguments: Mapping[str, str]) -> str:
    """Why our system, launched with these arguments, must not join this domain, in one line; empty if it may.

    `robot` contains the nodes of a running robot. Call this when `running_robot_nodes` may be called.
    """
    if robot:
        return f"a robot is already running in ROS domain {domain()}: {', '.join(robot)}"
    if there := same_names_there(arguments):
        return f"nodes with our robot's node names are running already in ROS domain {domain()}: {', '.join(there)}"
    return ""


def report_of_other_start() -> None:
    """Print on standard error that this program waits for another one that is starting a robot."""
    print(f"Another bot-console is starting a robot in ROS domain {domain()}: waiting for it ...", file=sys.stderr)


def socket_folder() -> str:
    """The folder that contains the sockets of the domain's programs; raises `FolderRefusedError`."""
    from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder

    return domain_folder(domain())


def domain() -> int:
    """The domain id from the environment; 0 if it is invalid, which is reported when a context is created."""
    try:
        return domain_id()
    except ValueError:
        return 0


def begin_program() -> None:
    """Prepare this process and its environment, before it starts threads and other processes."""
    from bot_console.runtime.children.ros_wheels import clear_wheel_environment
    from bot_console.runtime.process.machine_limits import reserve_little_address_space

    clear_wheel_environment()
    reserve_little_address_space()


def end_program(code: int) -> NoReturn:
    """End this process; at once if it has joined a domain or a router.

    Closing would wait up to 0.5 s for a frozen process, and a thread that is in Zenoh while the interpreter is
    finalized would abort the process.
    """
    if _taking_part or "zenoh" in sys.modules:
        try:
            from bot_console.runtime.process.ending import run_exit_functions
        except (MemoryError, ImportError):  # too little memory even to end; the cause has already been reported
            os._exit(code)
        # Exit functions remove sockets and temporary folders, as at any other end.
        os._exit(run_exit_functions(code))
    sys.exit(code)
