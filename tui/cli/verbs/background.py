"""`bot-console up`, `down` and `status`: a robot system that outlives its terminal, and that `attach` shows."""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

from bot_console.runtime.process.session_end import end_session
from bot_console.runtime.rmw.zenoh.domain.discovery_range import RANGE_VARIABLE
from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
from bot_console.runtime.stop_file_path import stop_file
from bot_console.tui.child_command import child_command
from bot_console.tui.cli.arguments import add_background_options, parse
from bot_console.tui.cli.machine_limits import no_robot_here
from bot_console.tui.cli.verbs import stop
from bot_console.tui.cli.verbs.router import add_serving_options, exposure_warning, parse_serving
from bot_console.tui.cli.verbs.stop import holders
from bot_console.tui.files.folders import OVERRIDE, state_folder
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.files.store_file import read_store
from bot_console.tui.session.embedded.domain import (
    domain,
    frozen,
    is_in_range,
    others_take_part,
    report_of_other_start,
    robot_claim,
    running_robot_nodes,
    take_part,
    why_no_robot,
)
from bot_console.tui.session.embedded.named_launch import with_launch_file
from bot_console.tui.session.embedded.reaching import named_routers, reach_system, report_left_router
from bot_console.tui.session.embedded.start_lock import start_lock
from bot_console.tui.session.launch_host.address import ADDRESS_SUFFIX
from bot_console.tui.session.system_log import new_log
from bot_console.tui.text.sanitize import sanitize

SYSTEM_MODULE = "bot_console.tui.session.background_system"
"""The module that runs as the program of a background system."""
MAX_FILE_BYTES = 1_000_000
START_TIMEOUT_S = 60.0
"""Seconds that its nodes may take to become visible on a busy machine."""
END_TIMEOUT_S = 15.0
"""Seconds that the system may take to end after each signal; after the first, it is killed."""


@dataclass(frozen=True)
class Background:
    """A system in the background: its process id, its arguments, and the path of its log."""

    pid: int
    words: tuple[str, ...]
    log: str
    way_in: int = 0
    """The process id of the router for other machines; 0 if there is none."""

    def runs(self) -> bool:
        """Whether its process id still belongs to the program of a background system."""
        return _is_program(self.pid, SYSTEM_MODULE.encode())

    def close_way_in(self) -> None:
        """End the router for other machines."""
        if self.way_in and _is_program(self.way_in, b"router"):
            os.kill(self.way_in, signal.SIGTERM)

    def describe(self) -> str:
        """Describe the system on one line."""
        return f"process {self.pid} ({' '.join(self.words) or 'indoor'}), log {self.log}"


def up(words: Sequence[str]) -> int:
    """Start a system in the background and wait until its robot is ready."""
    if "-h" in words or "--help" in words:
        return _print_help()
    serving, words = _split_serving(words)
    options = parse(["--headless", *words])
    if options.fast:
        print("a system in the background runs in real time: omit --fast", file=sys.stderr)
        return 2
    if problem := no_robot_here():
        print(problem, file=sys.stderr)
        return 1
    os.getcwd()  # raises in a folder that was deleted
    report_left_router()
    alone = take_part() or _unreachable()
    options, problem = with_launch_file(options)
    if problem := problem or alone:
        print(problem, file=sys.stderr)
        return 1
    with contextlib.ExitStack() as until_started:
        claim = None if options.launch or _running_system() else robot_claim()
        if claim is not None:
            until_started.callback(claim.release)
            problem = why_no_robot(
                claim.wait_for_robot(_robot_or_system, report_of_other_start), options.launch_arguments
            )
        got = until_started.enter_context(start_lock(_file().with_name("background.lock"), START_TIMEOUT_S))
        if there := _running_system():
            problem = why_no_robot([there.describe()], {})
        elif not got:
            problem = why_no_robot(["another one that is being started"], {})
        if problem:
            print(f"{problem}; bot-console attach shows it", file=sys.stderr)
            return 1
        try:
            log = new_log(os.getpid())
        except OSError as error:
            why = f"the log cannot be kept in {state_folder()}: {error.strerror}"
            print(f"not started: {why}; {OVERRIDE} names another folder", file=sys.stderr)
            return 1
        line = [*child_command(SYSTEM_MODULE), str(log), *words]
        with log.open("ab") as output:
            process = subprocess.Popen(
                line, stdin=subprocess.DEVNULL, stdout=output, stderr=output, start_new_session=True, close_fds=True,
                pass_fds=claim.descriptors if claim else (),
            )  # fmt: skip
        if claim is not None:
            claim.hand_over()
        # A separate file, kept and deleted with the log: the system's log rotates, after which the router would still
        # write to the old file.
        router_log = log.with_name(f"{log.name}.router")
        started = Background(process.pid, tuple(words), str(log), _open_way_in(serving, router_log) if serving else 0)
        if problem := _save(started):
            end_session(process.pid)
            started.close_way_in()
            print(f"not started: {problem}", file=sys.stderr)
            return 1
    return _wait_until_up(process, started, launched=bool(options.launch), router_log=router_log if serving else None)


def _robot_or_system() -> list[str]:
    """The robot in the domain, or the background system that is starting one; for `RobotClaim.wait_for_robot`."""
    there = _running_system()
    return [there.describe()] if there else running_robot_nodes()


def _wait_until_up(
    process: subprocess.Popen[bytes], started: Background, *, launched: bool, router_log: Path | None
) -> int:
    """Wait until the robot of a started system, or what it launches, is visible; print how to continue."""
    deadline = time.monotonic() + START_TIMEOUT_S
    is_up = partial(_accepts_consoles, process.pid) if launched else running_robot_nodes
    seen: object = False
    try:
        while process.poll() is None and not (seen := is_up()) and time.monotonic() < deadline:
            time.sleep(0.1)
    except KeyboardInterrupt:
        print(f"it is still starting: {started.describe()}; bot-console down ends it", file=sys.stderr)
        raise
    if process.poll() is not None:
        _forget()
        started.close_way_in()
        print(f"it ended with exit code {process.returncode}; its log is {started.log}", file=sys.stderr)
        return 1
    if not seen:
        what = "none of the programs that it launches is running" if launched else "no robot was found"
        print(
            f"{what} after {START_TIMEOUT_S:g} s: the log of {started.describe()} says why; bot-console down ends it",
            file=sys.stderr,
        )
        return 1
    print(f"running in ROS domain {domain()}: {started.describe()}")
    print("bot-console attach shows it, bot-console down ends it")
    if not launched and stop_file().exists():
        _print_holders()  # of stops that nobody has released since an earlier start
    if router_log and not _is_program(started.way_in, b"router"):
        print(f"the router for other machines did not start; the reason is at the end of {router_log}", file=sys.stderr)
        return 1
    return 0


def _unreachable() -> str:
    """Why other programs could neither see nor stop a background system, on one line; empty if they can."""
    return "" if is_in_range() else f"{RANGE_VARIABLE} is OFF: a system in the background could not be seen or stopped"


def _split_serving(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """Split off the arguments for `bot-console router` (empty if other machines may not connect) from the others."""
    parser = argparse.ArgumentParser("bot-console up", add_help=False)
    _add_serving(parser)
    given, rest = parser.parse_known_args(words)
    if not given.serve:
        return [], list(words)
    warning = exposure_warning(parse_serving(parser, given.serve, given))
    if warning:
        print(warning, file=sys.stderr)
    routed = [word for each in given.serve for word in ("--listen", each)]
    for option in ("tls_ca", "tls_certificate", "tls_key"):
        if value := getattr(given, option):
            routed += [f"--{option.replace('_', '-')}", value]
    return routed, rest


def _add_serving(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--serve",
        action="append",
        metavar="ENDPOINT",
        default=[],
        help="also let other machines connect at this endpoint, such as tcp/0.0.0.0:7447; may be repeated",
    )
    add_serving_options(parser)


def _print_help() -> int:
    parser = argparse.ArgumentParser(
        "bot-console up",
        usage="bot-console up [OPTION ...] [PROFILE | NAME:=VALUE ...]",
        description="Start a robot, or a launch file, in the background, and wait until it is ready.",
        epilog="`bot-console attach` shows it, `bot-console status` describes it, `bot-console down` ends it.",
    )
    add_background_options(parser)
    _add_serving(parser)
    parser.print_help()
    return 0


def _open_way_in(words: Sequence[str], log: Path) -> int:
    """Start the router for other machines; returns its process id."""
    line = [*child_command("bot_console.tui"), "router", "--mesh", *words]
    with log.open("ab") as output:
        return subprocess.Popen(
            line, stdin=subprocess.DEVNULL, stdout=output, stderr=output, start_new_session=True, close_fds=True
        ).pid


def _is_program(pid: int, word: bytes) -> bool:
    """Whether a process has that word in its command line, so that its id was not reused."""
    try:
        return word in Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        with contextlib.suppress(OSError, OverflowError):
            os.kill(pid, 0)
            return not Path("/proc/self").exists()
        return False


def down(words: Sequence[str]) -> int:
    """Stop the robot and end the system in the background."""
    _no_words("down", "End the system in the background.", words)
    alone = take_part()
    if alone:
        print(alone, file=sys.stderr)
        return 1
    there = _running_system()
    if there is None:
        print(f"no system is running in the background of ROS domain {domain()}", file=sys.stderr)
        return 1
    if running_robot_nodes():
        _stop_robot()
    for number in (signal.SIGTERM, getattr(signal, "SIGKILL", signal.SIGTERM)):
        with contextlib.suppress(ProcessLookupError):
            # SIGCONT first: a frozen process does not handle SIGTERM, and would later deliver it to any of its threads.
            os.kill(there.pid, getattr(signal, "SIGCONT", number))
            os.kill(there.pid, number)
        deadline = time.monotonic() + END_TIMEOUT_S
        while there.runs() and time.monotonic() < deadline:
            time.sleep(0.05)
        if not there.runs():
            break
    end_session(there.pid)  # for launched programs, which have outlived it only if it was killed
    there.close_way_in()
    _forget()
    print(f"ended: {there.describe()}")
    return 0


def _stop_robot() -> None:
    """Hold the robot until its system has ended; one without an emergency stop ends with its nodes."""
    stop.ask("stop", "its system is being ended", kept=False, answers_s=stop.HOLDER_TIMEOUT_S)


def status(words: Sequence[str]) -> int:
    """Print the system in the background and the robot in the domain, or behind the router that the environment names.

    Returns 1 if there is neither.
    """
    _no_words("status", "Show what is running.", words)
    if problem := reach_system():
        print(problem, file=sys.stderr)
        return 1
    routers = named_routers()
    where = f"ROS domain {domain()}" + (f" at {', '.join(routers)}" if routers else "")
    there, robot = None if routers else _running_system(), running_robot_nodes()
    if there:
        print(f"running in {where}: {there.describe()}")
    if robot:
        print(f"robot in {where}: {', '.join(robot)}")
    # Robots in namespaces are not among those found above.
    is_held = (bool(robot or routers) or others_take_part()) and _print_holders()
    stopped = [] if routers else frozen()  # process ids of another machine mean nothing here
    for pid in stopped:
        print(f"process {pid} is stopped: its nodes do not respond; kill -CONT {pid} lets it continue")
    if not (there or robot or is_held or stopped):
        print(f"nothing is running in {where}{_machine_hint() if not routers else ''}", file=sys.stderr)
        return 1
    return 0


def _machine_hint() -> str:
    """How to see what runs on the ROS 2 of this machine, which this program does not reach; empty if there is none."""
    from bot_console.tui.session.machine.machine_ros import find_machine_ros

    return "" if find_machine_ros() is None else "; `bot-console attach --ros` shows what runs on this machine's ROS 2"


def _print_holders() -> bool:
    """Print who holds the robots of the domain, or that this is unknown; returns whether anything was printed."""
    found = holders()
    if found is None:
        print("it is unknown whether somebody holds it: its emergency stop did not answer")
        return True
    for each in found:
        print(f"held by {sanitize(each)}; bot-console release --all releases it")
    return bool(found)


def _no_words(command: str, what: str, words: Sequence[str]) -> None:
    argparse.ArgumentParser(f"bot-console {command}", description=what).parse_args(words)


def _file() -> Path:
    """The file that describes the system in the background, next to the sockets of its domain."""
    return Path(domain_folder(domain())) / "background.json"


def _accepts_consoles(pid: int) -> bool:
    """Whether a system accepts consoles, which it does once its first launched process runs."""
    return (_file().parent / f"{pid}{ADDRESS_SUFFIX}").exists()


def _files() -> tuple[Path, Path]:
    """The two records of the system: one that does not depend on the user folder, and one that no cleaner of temporary
    files deletes.
    """
    return _file(), state_folder() / "systems" / f"domain-{domain()}.json"


def _save(started: Background) -> str:
    """Record a system, so that `down` can end it; returns why that failed, or an empty text."""
    problems: list[str] = []
    for each in _files():
        try:
            save_file(each, json.dumps(asdict(started)))
        except NotSaved as error:
            problems.append(str(error))
    return problems[0] if len(problems) == len(_files()) else ""


def _forget() -> None:
    for each in _files():
        with contextlib.suppress(OSError):
            each.unlink(missing_ok=True)


def _running_system() -> Background | None:
    """The system in the background, if it is still running."""
    return next((known for each in _files() if (known := _read(each)) is not None and known.runs()), None)


def _read(file: Path) -> Background | None:
    try:
        found = json.loads(read_store(file, MAX_FILE_BYTES))
        words = tuple(str(each) for each in found["words"])
        return Background(int(found["pid"]), words, str(found["log"]), int(found.get("way_in", 0)))
    except (OSError, ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError):
        return None
