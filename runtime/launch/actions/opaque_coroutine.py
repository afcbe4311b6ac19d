"""Running a coroutine."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Iterable, Mapping
from typing import TYPE_CHECKING

from launch.action import Action
from launch.event_handlers import OnShutdown

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.launch_context import LaunchContext


class OpaqueCoroutine(Action):
    """Runs a coroutine alongside the launch, which waits for it and cancels it when it shuts down."""

    def __init__(
        self,
        *,
        coroutine: Callable[..., Coroutine[object, None, None]],
        args: Iterable[object] | None = None,
        kwargs: Mapping[str, object] | None = None,
        ignore_context: bool = False,
        **left_over_kwargs: Condition | None,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not asyncio.iscoroutinefunction(coroutine):
            raise TypeError(f"OpaqueCoroutine expected a coroutine function for 'coroutine', got '{type(coroutine)}'")
        self.__coroutine = coroutine
        self.__args = list(args or ())
        self.__kwargs = kwargs or {}
        self.__ignore_context = ignore_context
        self.__future: asyncio.Future[None] | None = None

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Return a future that is done when the coroutine is."""
        return self.__future

    def execute(self, context: LaunchContext) -> None:
        """Start the coroutine."""
        args = self.__args if self.__ignore_context else [context, *self.__args]
        self.__future = context.asyncio_loop.create_task(self.__coroutine(*args, **self.__kwargs))
        context.register_event_handler(OnShutdown(on_shutdown=self.__cancel))

    def __cancel(self, event: object, context: LaunchContext) -> None:
        if self.__future is not None:
            self.__future.cancel()
