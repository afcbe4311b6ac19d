"""Running a process."""

from __future__ import annotations

import asyncio
import contextlib
import os
import traceback
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import launch.logging
from bot_console.runtime.importer import is_installed
from bot_console.runtime.programs.exit_messages import limit_fault
from launch.action import Action
from launch.child import CAN_FORK, Child, PythonProgram, start_child
from launch.conditions import evaluate_condition_expression
from launch.descriptions import Executable
from launch.escalation import SIGKILL_TIMEOUT_S, SIGTERM_TIMEOUT_S, Escalation
from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.event_handlers.on_shutdown import OnShutdown
from launch.event_handlers.on_targeted_process import OnTargetedProcess
from launch.events.process import (
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    ProcessStderr,
    ProcessStdout,
    ShutdownProcess,
    SignalProcess,
)
from launch.isolation import has_own_process
from launch.output_lines import OutputLines
from launch.respawn import Respawn
from launch.substitution import Substitution
from launch.substitutions.launch_configuration import LaunchConfiguration
from launch.utilities import create_future, normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import normalize_typed_substitution

if TYPE_CHECKING:
    from launch.event import Event
    from launch.event_handler import BaseEventHandler
    from launch.events import Shutdown
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_entities_type import SomeEntitiesType
    from launch.some_substitutions_type import SomeSubstitutionsType


class ExecuteLocal(Action):
    """Runs an executable, logs its output, ends it when the launch ends, and respawns it if requested."""

    def __init__(
        self,
        *,
        process_description: Executable,
        shell: bool = False,
        sigterm_timeout: SomeSubstitutionsType | None = None,
        sigkill_timeout: SomeSubstitutionsType | None = None,
        emulate_tty: bool = False,
        output: SomeSubstitutionsType = "log",
        output_format: str = "[{this.process_description.final_name}] {line}",
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: SomeEntitiesType | Callable[..., SomeEntitiesType | None] | None = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | None = None,
        respawn_max_retries: int = -1,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__process_description = process_description
        self.__shell = shell
        if sigterm_timeout is None:
            sigterm_timeout = LaunchConfiguration("sigterm_timeout", default=SIGTERM_TIMEOUT_S)
        if sigkill_timeout is None:
            sigkill_timeout = LaunchConfiguration("sigkill_timeout", default=SIGKILL_TIMEOUT_S)
        self.__sigterm_timeout = normalize_to_list_of_substitutions(sigterm_timeout)
        self.__sigkill_timeout = normalize_to_list_of_substitutions(sigkill_timeout)
        self.__emulate_tty = emulate_tty
        self.__output: Any = output
        if not isinstance(output, dict):
            self.__output = normalize_to_list_of_substitutions(os.environ.get("OVERRIDE_LAUNCH_PROCESS_OUTPUT", output))
        self.__output_format = output_format
        self.__cached_output = cached_output
        self.__log_cmd = log_cmd
        self.__on_exit = on_exit
        self.__respawn = Respawn(normalize_typed_substitution(respawn, bool), respawn_delay, respawn_max_retries)
        self.__cache: dict[int, list[bytes]] = {1: [], 2: []}
        self.__lines: dict[int, OutputLines] = {}
        self.__executed = False
        self.__registered: list[BaseEventHandler] = []
        self.__exits_to_report = 0
        self.__completed: asyncio.Future[None] | None = None
        self.__shutdown: asyncio.Future[None] | None = None
        self.__child: Child | None = None
        self.__details: dict[str, Any] | None = None
        self.__return_code: int | None = None
        self.__escalation: Escalation | None = None

    @property
    def process_description(self) -> Executable:
        """The executable's description."""
        return self.__process_description

    @property
    def shell(self) -> bool:
        """Whether the command is run by a shell."""
        return self.__shell

    @property
    def emulate_tty(self) -> bool:
        """Whether the process prints to a pseudo terminal of its own."""
        return self.__emulate_tty

    @property
    def sigterm_timeout(self) -> list[Substitution]:
        """Seconds between SIGINT and SIGTERM."""
        return self.__sigterm_timeout

    @property
    def sigkill_timeout(self) -> list[Substitution]:
        """Seconds between SIGTERM and SIGKILL."""
        return self.__sigkill_timeout

    @property
    def output(self) -> Any:
        """The output setting: where the process's output is logged."""
        return self.__output

    @property
    def process_details(self) -> dict[str, Any] | None:
        """Name, command, directory and environment, available once prepared, and the pid, available once started."""
        return self.__details

    @property
    def return_code(self) -> int | None:
        """The exit code of the last run; None before the first one has ended."""
        return self.__return_code

    @property
    def on_exit(self) -> SomeEntitiesType | Callable[..., SomeEntitiesType | None] | None:
        """The actions or callable for the process's exit."""
        return self.__on_exit

    @property
    def respawn(self) -> bool:
        """Whether the process is respawned after an exit; known once executed (not upstream)."""
        return self.__respawn.is_wanted

    @property
    def respawn_delay(self) -> float | None:
        """Delay before a respawn, in seconds (not upstream)."""
        return self.__respawn.delay

    def get_stdout(self) -> str:
        """Return its standard output; raises `RuntimeError` unless `cached_output` was set."""
        return self.__cached(1)

    def get_stderr(self) -> str:
        """Return its standard error; raises `RuntimeError` unless `cached_output` was set."""
        return self.__cached(2)

    def __cached(self, stream: int) -> str:
        if not self.__cached_output:
            what = "stdout, proc" if stream == 1 else "stderr, proc"
            raise RuntimeError(
                f"cached output must be true to be able to get {what} '{self.__process_description.name}'"
            )
        return b"".join(self.__cache[stream]).decode("utf-8", "replace")

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the actions for the process's exit."""
        on_exit: SomeEntitiesType | Callable[..., SomeEntitiesType | None] | None = self.__on_exit
        if isinstance(on_exit, (list, tuple)):
            return [*on_exit]
        return [self.__on_exit] if isinstance(self.__on_exit, Action) else []

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Return a future that is done when the process has ended and is not respawned."""
        return self.__completed

    def prepare(self, context: LaunchContext) -> None:
        """Evaluate the description."""
        self.__process_description.prepare(context, self)
        if not self.__executed:  # a second execution is refused, so the process of the first keeps its details
            self.__details = self.__new_details()

    def __new_details(self) -> dict[str, Any]:
        description = self.__process_description
        return {
            "name": description.final_name,
            "cmd": description.final_cmd or [],
            "cwd": description.final_cwd,
            "env": description.final_env,
        }

    def python_program(self, command: list[str]) -> PythonProgram | None:
        """Return the command as a Python program of this runtime; None if it runs as an ordinary system process."""
        from launch.ros2_commands import ros2_program

        return ros2_program(command, self.__shell)

    def words_for(self, program: PythonProgram | None, command: list[str]) -> list[str]:
        """Return the argument list for the program, or if there is none, for the operating system."""
        return command

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Schedule the start of the process in the event loop."""
        self.prepare(context)
        name = self.__process_description.final_name
        if self.__executed:
            raise RuntimeError(f"ExecuteLocal action '{name}': executed more than once: {self.describe()}")
        self.__executed = True
        if context.is_shutdown or context.resolving:
            return None
        self.__logger = launch.logging.get_logger(name)
        if not _is_per_stream(self.__output):
            self.__output = perform_substitutions(context, self.__output)
        loggers = launch.logging.get_output_loggers(name or "", self.__output)
        self.__lines = {
            fd: OutputLines(self, logger, self.__output_format) for fd, logger in zip((1, 2), loggers, strict=True)
        }
        self.__respawn.evaluate(context)
        self.__completed = create_future(context.asyncio_loop)
        self.__shutdown = create_future(context.asyncio_loop)
        self.__registered = self.__handlers()
        for handler in self.__registered:
            context.register_event_handler(handler)
        context.asyncio_loop.create_task(self.__run(context))
        return None

    def __handlers(self) -> list[BaseEventHandler]:
        return [
            self.__when(ProcessExited, self.__on_data),  # handlers are called newest first, so this one is called last
            OnTargetedProcess(ShutdownProcess, self, lambda event, context: self._shutdown_process(context, True)),
            OnTargetedProcess(SignalProcess, self, self.__on_signal),
            self.__when(ProcessIO, self.__on_io),
            OnShutdown(on_shutdown=self.__on_shutdown),
            *([self.__when(ProcessExited, self.__on_exit)] if self.__on_exit else []),
            self.__when(ProcessExited, self.__flush),
        ]

    def __when(
        self, kind: type[Event], what: SomeEntitiesType | Callable[..., SomeEntitiesType | None]
    ) -> OnActionEventBase:
        """Return a handler like `OnProcessExit`, which cannot be imported here as it depends on this class."""
        return OnActionEventBase(action_matcher=self, on_event=what, target_event_cls=kind, target_action_cls=Action)

    def __on_io(self, event: ProcessIO, context: LaunchContext) -> None:
        if event.from_stdin:
            self.__on_stdin(event)
        else:
            self.__on_text(event)

    def __on_text(self, event: ProcessIO) -> None:
        fd = 1 if event.from_stdout else 2
        if self.__cached_output:
            self.__cache[fd].append(event.text)
        self.__lines[fd].feed(event.text)

    def __on_stdin(self, event: ProcessIO) -> None:
        if self.__child is not None:
            self.__child.write(event.text)

    def __flush(self, event: object, context: LaunchContext) -> None:
        for lines in self.__lines.values():
            lines.flush()

    def __on_data(self, event: object, context: LaunchContext) -> None:
        self.__exits_to_report -= 1
        self.__retire(context)

    def __retire(self, context: LaunchContext) -> None:
        """Unregister the handlers after the last exit was handled; otherwise a long launch would keep every process."""
        if self.__exits_to_report or self.__completed is None or not self.__completed.done():
            return
        for handler in self.__registered:
            context.unregister_event_handler(handler)
        self.__registered = []

    def __on_signal(self, event: SignalProcess, context: LaunchContext) -> None:
        name = self.__process_description.final_name
        if self.__child is None:
            raise RuntimeError("Signal event received before execution.")
        if self.__child.exited.done():
            self.__logger.debug(f"signal '{event.signal_name}' not sent to '{name}' because it has already ended")
            return
        self.__logger.info(f"sending signal '{event.signal_name}' to process[{name}]")
        try:
            self.__child.send_signal(_kill_by_name(event.signal))
        except ProcessLookupError:
            self.__logger.debug(f"signal '{event.signal_name}' not sent to '{name}' because it has already ended")

    def __on_shutdown(self, event: Shutdown, context: LaunchContext) -> None:
        self._shutdown_process(context, not event.due_to_sigint or context.noninteractive)

    def _shutdown_process(self, context: LaunchContext, send_sigint: bool) -> None:
        """Begin to shut the process down, but only once; without SIGINT if the terminal has already sent one."""
        if self.__shutdown is None or self.__shutdown.done():
            return
        self.__shutdown.set_result(None)
        child = self.__child
        if child is None or child.exited.done():
            return
        self.__escalation = Escalation(self, context, self.__logger)
        if send_sigint:
            self.__escalation.interrupt()
        elif not child.gets_signals_of_terminal:
            with contextlib.suppress(ProcessLookupError):  # it has just ended, and its last output is still being read
                child.send_signal(2)

    async def __run(self, context: LaunchContext) -> None:
        """Run the process, and respawn it as long as that is wanted."""
        while not self.__over:
            try:
                code = await self.__run_once(context)
            except Exception as error:  # the command cannot be started
                text = limit_fault(error) or f"\n{traceback.format_exc()}"
                self.__logger.error(f"exception occurred while executing process: {text}".replace(": \n", ":\n", 1))
                break
            if code is None or not await self.__respawn.wanted(context, self.__shutdown):
                break
        if self.__completed is not None and not self.__completed.done():
            self.__completed.set_result(None)
        self.__retire(context)

    @property
    def __over(self) -> bool:
        return self.__shutdown is None or self.__shutdown.done()

    async def __run_once(self, context: LaunchContext) -> int | None:
        description = self.__process_description
        command = description.final_cmd or []
        details = self.__new_details()
        if self.__log_cmd:
            words = " ".join(each for each in command if each.strip())
            custom = description.final_env is not None
            self.__logger.info(f"process details: cmd='{words}', cwd='{description.final_cwd}', custom_env?={custom}")
        child = await self.__start(context, command, details)
        code = await child.exited
        self.__return_code = code
        if self.__escalation is not None:
            self.__escalation.cancel()
        child.close()
        if code == 0:
            self.__logger.info(f"process has finished cleanly [pid {child.pid}]")
        else:
            words = " ".join(each for each in command if each.strip())
            self.__logger.error(f"process has died [pid {child.pid}, exit code {code}, cmd '{words}'].")
        self.__exits_to_report += 1
        context.emit_event_sync(ProcessExited(returncode=code, action=self, **(self.__details or {})))
        return code

    async def __start(self, context: LaunchContext, command: list[str], details: dict[str, Any]) -> Child:
        self.__details = details
        early: list[tuple[int, bytes]] = []

        def output(fd: int, data: bytes) -> None:
            if "pid" not in details:
                early.append((fd, data))
                return
            kind = ProcessStdout if fd == 1 else ProcessStderr
            context.emit_event_sync(kind(text=data, action=self, **details))

        program = None
        if is_installed():  # otherwise this package serves another rclpy, with which programs are ordinary processes
            program = self.python_program(command)
            if program is not None and not (program.is_ours or CAN_FORK):
                program = None  # it runs in an interpreter of its own
            command = self.words_for(program, command)
        child = await start_child(
            command,
            program=program,
            own_process=program is not None and has_own_process(context, program),
            name=details["name"],
            shell=self.__shell,
            emulate_tty=self.__wants_tty(context),
            env=details["env"],
            cwd=details["cwd"],
            output=output,
        )
        self.__child = child
        details["pid"] = child.pid
        self.__logger.info(f"process started with pid [{child.pid}]")
        context.emit_event_sync(ProcessStarted(action=self, **details))
        for fd, data in early:
            output(fd, data)
        if self.__over:
            self.__escalation = Escalation(self, context, self.__logger)
            self.__escalation.interrupt()
        return child

    def __wants_tty(self, context: LaunchContext) -> bool:
        if "emulate_tty" not in context.launch_configurations:
            return self.__emulate_tty
        expression = normalize_to_list_of_substitutions(context.launch_configurations["emulate_tty"])
        return evaluate_condition_expression(context, expression)


def _kill_by_name(signal_number: object) -> Any:
    """Convert SIGKILL given by name; other names fail in the system call, as upstream."""
    return 9 if signal_number == "SIGKILL" else signal_number


def _is_per_stream(output: object) -> bool:
    """Whether the output setting is per stream (a dict) and not a text."""
    return isinstance(output, dict)
