"""Guard conditions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rclpy.impl.callback_order import GUARD
from rclpy.impl.destroyable import Destroyable
from rclpy.impl.entity import Entity

if TYPE_CHECKING:
    from rclpy.callback_groups import CallbackGroup
    from rclpy.context import Context


class GuardCondition(Entity):
    """Calls back in an executor after it was triggered, at most once per wake."""

    KIND = GUARD

    def __init__(
        self, callback: Callable[[], object] | None, callback_group: CallbackGroup, context: Context | None = None
    ) -> None:
        super().__init__(callback_group)
        self.callback = callback
        self._triggered = False

    @property
    def handle(self) -> Destroyable:
        """The guard condition's handle, as upstream has one."""
        return Destroyable(self, self.use)

    def trigger(self) -> None:
        """Trigger the callback; thread-safe."""
        self.use()
        self._triggered = True
        self.notify()

    def pending(self) -> bool:
        """Whether it was triggered."""
        return self._triggered and not self.destroyed

    def run(self) -> object:
        """Run the callback."""
        self._triggered = False
        result = self._callback() if self._callback is not None else None
        return result if self._is_async else None

    def destroy(self) -> None:
        """Destroy the guard condition."""
        self.destroyed = True
        self.detach()
