"""Makes simulator runs in parallel, each in a process forked from a preloaded server."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from queue import SimpleQueue
from typing import Any

from bot_console.runtime.process.fork_server import ForkServer, Job, Report
from bot_console.tui.console.parameters.file.patch import patched
from bot_console.tui.files.folders import expanded_path
from bot_console.tui.tuning.specification import Trial, TuningSpecification

CAN_FORK = hasattr(os, "fork")
PARAMETERS_ASKED_AFTER_S = 1.0
"""Simulated seconds after which all nodes are asked for their parameters."""
_WARM_UP = "bot_console.tui.cli.tune.worker:warm_up"
_JOB = "bot_console.tui.cli.tune.worker:job"
_FAULTS = ("[FATAL]", "[ERROR]")


def processors() -> list[int]:
    """The CPUs that this process may use."""
    offered = getattr(os, "sched_getaffinity", None)
    return sorted(offered(0)) if offered else list(range(os.cpu_count() or 1))


class Pool:
    """Makes as many concurrent runs as there are CPUs; `close` ends them.

    Raises `OSError` if processes cannot be forked.
    """

    def __init__(self, maximum: int = 0) -> None:
        """Make at most `maximum` runs at a time; 0 means one per CPU."""
        if not CAN_FORK:
            raise OSError("this system cannot fork processes, which concurrent runs need")
        places = processors()
        self._places: SimpleQueue[int] = SimpleQueue()
        count = maximum or len(places)
        for index in range(count):
            self._places.put(places[index % len(places)])
        self._server = ForkServer(_WARM_UP)
        self._threads = ThreadPoolExecutor(count, thread_name_prefix="tune")
        self._closed = False

    @property
    def server_pid(self) -> int:
        """The id of the process that forks the runs."""
        return self._server.pid

    def begin(self, specification: TuningSpecification, trial: Trial) -> Future[Mapping[str, Any]]:
        """Start a run as soon as a CPU is free; if it fails, its report has a key `problem`."""
        run = _Run(
            "run",
            specification.profile,
            patched(profile_yaml(specification.profile), specification.values(trial.setting)),
            trial.world,
            trial.seed,
            specification.duration,
            [f"{name}:={value}" for name, value in specification.arguments.items()],
            specification.score.paths,
        )
        return self._threads.submit(self._run, run)

    def probe(self, profile: str, arguments: Mapping[str, str], world: str = "") -> Future[Mapping[str, Any]]:
        """The parameters, by node and name, of the system that a profile starts, in `world` or the profile's own."""
        words = [f"{name}:={value}" for name, value in arguments.items()]
        run = _Run("probe", profile, profile_yaml(profile), world, 1, PARAMETERS_ASKED_AFTER_S, words)
        return self._threads.submit(self._run, run)

    def close(self) -> None:
        """End all runs and the server."""
        self._closed = True
        self._threads.shutdown(wait=False, cancel_futures=True)
        self._server.close()
        self._threads.shutdown(wait=True)

    def _run(self, run: _Run) -> Mapping[str, Any]:
        place = self._places.get()
        try:
            return run.report(self._server, place)
        finally:
            self._places.put(place)


@dataclass(frozen=True)
class _Run:
    """A run, with the arguments of its worker."""

    kind: str
    profile: str
    parameters: str
    world: str
    seed: int
    duration: float
    words: Sequence[str]
    paths: Sequence[str] = field(default=())

    def report(self, server: ForkServer, processor: int) -> Mapping[str, Any]:
        """Run it in a separate process, and wait for its report."""
        profile = self.profile if not is_file(self.profile) else "indoor"
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "tuned.yaml")
            file.write_text(self.parameters, encoding="utf-8")
            arguments = [self.kind, profile, str(file), self.world, self.seed, self.duration, list(self.words)]
            return self._reported(server, [*arguments, list(self.paths), processor])

    @staticmethod
    def _reported(server: ForkServer, arguments: Sequence[Any]) -> Mapping[str, Any]:
        job = Job("tune", _JOB, arguments, ["bot-console"], dict(os.environ), os.getcwd())
        reading, writing = os.pipe()
        with tempfile.TemporaryFile() as message, open(os.devnull, "r+b") as nothing:
            try:
                descriptor = server.start(
                    job, stdin=nothing.fileno(), stdout=writing, stderr=message.fileno(), data=nothing.fileno()
                )
            except OSError:
                os.close(reading)
                raise
            finally:
                os.close(writing)
            printed = _drain(reading)
            ended = Report()
            ended.feed(_drain(descriptor))
            return _report(printed, ended, message)


def _report(printed: bytes, ended: Report, message: Any) -> Mapping[str, Any]:
    try:
        report: dict[str, Any] = json.loads(printed)
    except ValueError:
        report = {"problem": ended.problem or f"the run ended with exit code {ended.exit_code}"}
    if problem := report.get("problem"):
        message.seek(0)
        lines = message.read().decode("utf-8", "replace").splitlines()
        why = next((each for fault in _FAULTS for each in lines if fault in each), "")
        report["problem"] = f"{problem}: {why.partition(']: ')[2] or why}" if why else problem
    return report


def _drain(descriptor: int) -> bytes:
    with os.fdopen(descriptor, "rb") as file:
        return file.read()


def is_file(profile: str) -> bool:
    """Whether a profile is given as a file rather than by name."""
    return profile.endswith((".yaml", ".yml"))


def profile_yaml(profile: str) -> str:
    """The text of a profile's parameter file; raises `OSError` if it does not exist."""
    folder = Path(__file__).resolve().parents[3] / "profiles"
    path = expanded_path(profile) if is_file(profile) else folder / f"{profile}.yaml"
    return path.read_text(encoding="utf-8-sig")
